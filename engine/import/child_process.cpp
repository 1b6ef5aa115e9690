#include "engine/import/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera {
namespace {

// The first byte that a child sends.
constexpr char kResult = 'r', kError = 'e', kNoMemory = 'm';

void write_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

[[noreturn]] void be_child(int to, const ChildLimits& limits, const std::function<std::string()>& work) {
  // Libraries may print; nobody asked them to.
  if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto seconds = static_cast<rlim_t>(limits.time.count() / 1000 + 1);
  const rlimit time{seconds, seconds + 1}, no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve terabytes
  const rlimit memory{limits.memory_bytes, limits.memory_bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  try {
    const std::string result = work();
    write_all(to, &kResult, 1);
    write_all(to, result.data(), result.size());
  } catch (const std::bad_alloc&) {
    write_all(to, &kNoMemory, 1);
  } catch (const std::exception& error) {
    write_all(to, &kError, 1);
    write_all(to, error.what(), std::strlen(error.what()));
  } catch (...) {
    write_all(to, &kError, 1);
  }
  ::_exit(0);
}

// Until the child closes its end; false: it took too long.
bool read_all(int from, std::chrono::milliseconds time, std::string& bytes) {
  const auto end = std::chrono::steady_clock::now() + time;
  char block[1 << 16];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{from, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t count = ::read(from, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    bytes.append(block, static_cast<std::size_t>(count));
  }
}

std::string mebibytes(std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

}  // namespace

std::string run_in_child(const std::string& what, const ChildLimits& limits, const std::function<std::string()>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(what + ": cannot make a pipe to a process of its own: " + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) {
    const int reason = errno;
    ::close(ends[0]), ::close(ends[1]);
    throw Error(what + ": cannot start a process of its own: " + std::strerror(reason));
  }
  if (child == 0) {
    ::close(ends[0]);
    be_child(ends[1], limits, work);
  }
  ::close(ends[1]);
  std::string bytes;
  bool in_time = false;
  std::exception_ptr failure;
  try {
    in_time = read_all(ends[0], limits.time, bytes);
  } catch (...) {
    failure = std::current_exception();
  }
  ::close(ends[0]);
  if (!in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (failure) std::rethrow_exception(failure);
  if (!in_time) throw Error(what + " took more than " + std::to_string(limits.time.count() / 1000) + " seconds; given up");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) throw Cancelled(what + " was interrupted");
  const char kind = bytes.empty() ? '\0' : bytes.front();
  if (kind == kNoMemory) throw Error(what + " takes more than " + mebibytes(limits.memory_bytes) + " of memory; given up");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) throw Error(what + " took too much time; given up");
  if (!WIFEXITED(status) || kind == '\0') throw Error(what + " broke down: the file is damaged, or of a kind that its reader cannot stand");
  if (kind == kError) throw Error(bytes.size() > 1 ? bytes.substr(1) : what + " failed for no known reason");
  bytes.erase(0, 1);
  return bytes;
}

}  // namespace tessera
