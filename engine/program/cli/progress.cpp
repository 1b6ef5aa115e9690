#include "engine/program/cli/progress.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <unistd.h>

namespace tessera::program::cli {
namespace {

std::atomic<bool> interrupted = false;  // set by the signal handler, read by any thread
static_assert(std::atomic<bool>::is_always_lock_free);

// The second Ctrl-C has the default effect: it ends the process.
void interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  if (std::signal(SIGINT, interrupt) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}
bool Interrupt::pressed() { return interrupted; }

Progress::Progress(ShowProgress show)
    : enabled_(show == ShowProgress::always ||
               (show == ShowProgress::automatic && ::isatty(STDERR_FILENO) != 0)),
      wait_(show == ShowProgress::always ? std::chrono::steady_clock::duration::zero()
                                         : std::chrono::seconds(1)),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}
Progress::~Progress() { clear(); }

void Progress::show(double done, const std::string& label) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
  if (now - start_ < wait_ || (shown_ && now - last_ < kRedrawInterval)) return;
  last_ = now;
  shown_ = true;
  constexpr int kWidth = 30;
  const int filled = std::clamp(static_cast<int>(done * kWidth), 0, kWidth);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double left = done > 0 ? seconds / done - seconds : 0;
  const std::string bar(static_cast<std::size_t>(filled), '#');
  const std::string rest(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r[%s%s] %3d %%  %s  %.0f s left \x1b[K", bar.c_str(), rest.c_str(),
               static_cast<int>(100 * done), label.c_str(), left);
  std::fflush(stderr);
}

void Progress::clear() {
  if (shown_) std::fprintf(stderr, "\r\x1b[K");
  shown_ = false;
}

}  // namespace tessera::program::cli
