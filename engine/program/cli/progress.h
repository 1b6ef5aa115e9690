// A progress bar on the terminal, and Ctrl-C.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace tessera::program::cli {

enum class ShowProgress { automatic, always, never };

/// A progress line on stderr with the remaining time. `automatic` shows it after one second, on a terminal
/// only.
class Progress {
 public:
  explicit Progress(ShowProgress show);
  ~Progress();
  /// Shows the fraction `done`, 0 .. 1. Call from one thread at a time.
  void show(double done, const std::string& label);
  /// Erases the line, so that other text can be printed.
  void clear();

 private:
  bool enabled_;
  bool shown_ = false;
  std::chrono::steady_clock::duration wait_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
};

/// Catches Ctrl-C, unless the parent process set it to be ignored. A second Ctrl-C ends the program at once.
class Interrupt {
 public:
  Interrupt();
  static bool pressed();
};

}  // namespace tessera::program::cli
