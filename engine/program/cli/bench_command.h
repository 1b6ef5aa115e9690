// `tessera bench`: a program of its own, so that who renders does not carry what measures.
#pragma once

#include <string>
#include <vector>

namespace tessera::program::cli {

/// Becomes that program. Returns only by throwing Error, where there is none beside this one or in
/// ../libexec/tessera.
[[noreturn]] void exec_bench(const std::vector<std::string>& arguments);

}  // namespace tessera::program::cli
