// Readers of other people's files run in a child process with limits of time and memory: what goes wrong
// there stays there.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace tessera::program {

struct ChildLimits {
  std::chrono::milliseconds time{10000};
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< that the child may take, besides what it starts with
  std::size_t result_bytes = std::size_t{1} << 28;  ///< that it may return
  std::function<bool()> should_continue{};          ///< asked a few times a second; false: the child is ended
};

/// Runs work() in a child and returns what it returned there. @throws Error with the message of the Error
/// that it threw there, or saying how the child ended: "<what> took more than 10 seconds; given up". @throws
/// Cancelled if Ctrl-C or should_continue ended it. The child runs on the one thread that called: where other
/// threads may hold locks of libraries that work() uses, call it before they start.
std::string run_in_child(const std::string& what, const ChildLimits& limits,
                         const std::function<std::string()>& work);

}  // namespace tessera::program
