// The name of the processor.
#pragma once

#include <string>

namespace tessera::program {

/// The model name that the system reports: "AMD EPYC 9R14". "unknown" if it reports none.
std::string processor_name();

}  // namespace tessera::program
