// `tessera bench`: runs the separate program tessera-bench, which keeps the benchmarks out of this one.
#pragma once

#include <string>
#include <vector>

namespace tessera::program::cli {

/// Replaces this process by tessera-bench, from the folder of this program or ../libexec/tessera.
/// @throws Error if it cannot be started
[[noreturn]] void exec_bench(const std::vector<std::string>& arguments);

}  // namespace tessera::program::cli
