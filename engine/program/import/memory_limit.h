// How much memory reading a model may take.
#pragma once

#include <cstddef>

namespace tessera::program {

/// A quarter of the machine's memory, or of what the control group of this process may have; at least 1 GiB.
std::size_t default_import_memory();

}  // namespace tessera::program
