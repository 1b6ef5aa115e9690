// Runs readers of foreign files in a child process with limits of time and memory, so that a crash or a
// runaway reader does not affect the caller.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace tessera::program {

struct ChildLimits {
  std::chrono::milliseconds time{10000};
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< in addition to the memory mapped at the start
  std::size_t result_bytes = std::size_t{1} << 28;
  std::function<bool()> should_continue{};  ///< polled about ten times a second; false ends the child
};

/// Runs work() in a forked child and returns its result.
/// - The child has one thread, the one that called. If other threads may hold locks of libraries that work()
///   uses, call this before they start.
/// @throws Error with the message of an Error thrown by work(), or describing how the child ended:
///   "<what> took more than 10 seconds; given up"
/// @throws Cancelled if Ctrl-C or should_continue ended the child
std::string run_in_child(const std::string& what, const ChildLimits& limits,
                         const std::function<std::string()>& work);

}  // namespace tessera::program
