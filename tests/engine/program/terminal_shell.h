// An interactive shell in a pseudo-terminal, in which tests type.
#pragma once

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera {

/// Starts a shell; ends it when the object is destroyed.
class TerminalShell {
 public:
  using Words = std::vector<std::string>;
  static constexpr unsigned short kColumns = 200;

  /// @param words        the shell and its arguments
  /// @param environment  variables to set: "NAME=VALUE"
  TerminalShell(Words words, Words environment, const std::string& folder) {
    constexpr winsize kSize{.ws_row = 50, .ws_col = kColumns, .ws_xpixel = 0, .ws_ypixel = 0};
    child_ = ::forkpty(&terminal_, nullptr, nullptr, &kSize);
    if (child_ != 0) return;
    for (std::string& variable : environment) ::putenv(variable.data());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0) ::execvp(arguments.front(), arguments.data());
    ::_exit(127);
  }
  ~TerminalShell() {
    ::kill(child_, SIGHUP);
    ::kill(child_, SIGKILL);
    ::close(terminal_);
    ::waitpid(child_, nullptr, 0);
  }
  TerminalShell(const TerminalShell&) = delete;
  TerminalShell& operator=(const TerminalShell&) = delete;

  void type(const std::string& keys) const {
    for (std::size_t done = 0; done < keys.size();) {
      const ssize_t count = ::write(terminal_, keys.data() + done, keys.size() - done);
      if (count < 0 && errno != EINTR) return;
      if (count > 0) done += static_cast<std::size_t>(count);
    }
  }
  /// Reads until the shell prints `text`. Returns false after a minute without it.
  bool wait_for(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    std::size_t at = 0;
    while ((at = screen_.find(text, seen_)) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end) return false;
      read_some();
    }
    seen_ = at + text.size();
    return true;
  }
  /// All that the shell printed, with control characters.
  const std::string& screen() const { return screen_; }

 private:
  void read_some() {
    pollfd ready{.fd = terminal_, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, 100) <= 0) return;
    char block[4096];
    const ssize_t count = ::read(terminal_, block, sizeof block);
    if (count > 0) screen_.append(block, static_cast<std::size_t>(count));
  }

  int terminal_ = -1;
  pid_t child_ = -1;
  std::string screen_{};
  std::size_t seen_ = 0;
};

}  // namespace tessera
