// Commands that run a separate program, which keeps measurements out of this one: `tessera bench` and
// `tessera price` run tessera-bench, `tessera accuracy` runs tessera-accuracy.
#pragma once

#include <string>
#include <vector>

namespace tessera::program::cli {

/// Replaces this process by a program from the folder of this one or ../libexec/tessera.
/// @param name  of its file, for example tessera-bench
/// @throws Error if it cannot be started
[[noreturn]] void exec_measurement(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace tessera::program::cli
