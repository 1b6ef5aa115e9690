// Runs readers of foreign files in a child process with limits of time and memory, so that a crash or a
// runaway reader does not affect the caller.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/program/import/byte_stream.h"

namespace tessera::program {

struct ChildLimits {
  std::chrono::milliseconds time{10000};            ///< without progress and without bytes of the result
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< in addition to the memory mapped at the start
  std::size_t result_bytes = std::size_t{1} << 28;
  std::function<bool()> should_continue{};  ///< polled about ten times a second; false ends the child
  ReportProgress progress{};                ///< called in the parent with what the child reports
};

/// The child's side of the pipe to its parent.
class ChildOutput {
 public:
  explicit ChildOutput(int pipe) : pipe_(pipe) {}

  /// Reports progress and restarts the limit of time. At most 20 reports a second are sent; a value that is
  /// not above the last one is not progress.
  void report(double done);
  /// Announces the size of the result; exactly this number of bytes must be written.
  void begin_result(std::uint64_t bytes);
  void write(const char* bytes, std::size_t count);
  /// Sends what is buffered; called after work().
  void flush();

 private:
  int pipe_;
  std::string buffer_;  // collects small pieces
  double reported_ = 0;
  std::chrono::steady_clock::time_point last_report_{};
};

/// Runs work() in a forked child, and receive() here while the child sends its result.
/// - The child has one thread, the one that called. If other threads may hold locks of libraries that work()
///   uses, call this before they start.
/// - Neither process holds a copy of the result, except what work() and receive() make.
/// @param receive  gets the number of bytes and a function that reads them in order
/// @throws Error with the message of an Error thrown by work(), or describing how the child ended:
///   "<what> made no progress for 10 seconds; given up"
/// @throws Cancelled if Ctrl-C or should_continue ended the child
void run_in_child(const std::string& what, const ChildLimits& limits,
                  const std::function<void(ChildOutput&)>& work,
                  const std::function<void(const ByteReader&, std::uint64_t bytes)>& receive);

/// run_in_child() for a result that is short enough to be copied.
std::string run_in_child(const std::string& what, const ChildLimits& limits,
                         const std::function<std::string()>& work);

}  // namespace tessera::program
