// Progress on the terminal for what takes longer than a second, and Ctrl-C.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace tessera::program::cli {

enum class ShowProgress { automatic, always, never };

/// A line on stderr that is redrawn, with the time left; gone at the end.
class Progress {
 public:
  explicit Progress(ShowProgress show);
  ~Progress();
  /// `done` of all frames, 0 .. 1. By one thread at a time.
  void show(double done, const std::string& what);
  /// Takes the line away, before something else is printed.
  void clear();

 private:
  bool enabled_, shown_ = false;
  std::chrono::steady_clock::duration wait_;
  std::chrono::steady_clock::time_point start_, last_;
};

/// Whether Ctrl-C was pressed since the program began, if nobody above chose to ignore it. A second one ends
/// the program at once.
class Interrupt {
 public:
  Interrupt();
  static bool pressed();
};

}  // namespace tessera::program::cli
