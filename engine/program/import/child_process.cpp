#include "engine/program/import/child_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

// Precedes the bytes of the result or of the error message.
struct Header {
  enum Kind : std::uint64_t { result, error, no_memory } kind;
  std::uint64_t bytes;  // payload size
};

void write_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

// Sanitizers reserve terabytes of address space, so their builds have no limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Bytes mapped by this process: the first field of statm, in pages.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}
void limit_memory(std::size_t more_bytes) {
  const rlim_t bytes = address_space() + more_bytes;
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
}
#else
void limit_memory(std::size_t) {}
#endif

[[noreturn]] void run_child(int to, pid_t parent, const ChildLimits& limits,
                            const std::function<std::string()>& work) {
  // Silences libraries that print.
  if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // the parent ended before prctl()
  const auto seconds = static_cast<rlim_t>(limits.time.count() / 1000 + 1);
  const rlimit time{seconds, seconds + 1};
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(limits.memory_bytes);
  const auto send = [&](Header::Kind kind, std::string_view text) {
    const Header header{kind, text.size()};
    write_all(to, reinterpret_cast<const char*>(&header), sizeof header);
    write_all(to, text.data(), text.size());
  };
  try {
    send(Header::result, work());
  } catch (const std::bad_alloc&) {
    send(Header::no_memory, {});
  } catch (const std::exception& error) {
    send(Header::error, error.what());
  } catch (...) {
    send(Header::error, "an exception of unknown type");
  }
  ::_exit(0);
}

using Clock = std::chrono::steady_clock;
enum class ReadStatus { all, ended, timed_out, cancelled };

ReadStatus read_all(int from, Clock::time_point end, const std::function<bool()>& should_continue, char* to,
                    std::size_t count) {
  constexpr std::chrono::milliseconds kPause(100);
  while (count > 0) {
    if (should_continue && !should_continue()) return ReadStatus::cancelled;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return ReadStatus::timed_out;
    pollfd waiting{from, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min(left, kPause).count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    if (ready < 0) return ReadStatus::ended;
    const ssize_t taken = ::read(from, to, count);
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) return ReadStatus::ended;
    to += taken;
    count -= static_cast<std::size_t>(taken);
  }
  return ReadStatus::all;
}

std::string mebibytes(std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

// Opens a pipe whose ends are not file descriptors 0 to 2, even if those are closed.
bool make_pipe(int (&ends)[2]) {
  int low[2];
  if (::pipe2(low, O_CLOEXEC) != 0) return false;
  for (int k = 0; k < 2; ++k) ends[k] = ::fcntl(low[k], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int reason = errno;
  for (const int end : low) ::close(end);
  if (ends[0] >= 0 && ends[1] >= 0) return true;
  for (const int end : ends)
    if (end >= 0) ::close(end);
  errno = reason;
  return false;
}

// Kills and reaps the child process on destruction.
class Child {
 public:
  explicit Child(pid_t id, int from) : id_(id), from_(from) {}
  ~Child() {
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      wait();
    }
    ::close(from_);
  }
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
  int from_;
};

}  // namespace

std::string run_in_child(const std::string& what, const ChildLimits& limits,
                         const std::function<std::string()>& work) {
  int ends[2];
  if (!make_pipe(ends))
    throw Error(what + ": cannot create a pipe to a child process: " + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(ends[0]);
    run_child(ends[1], parent, limits, work);
  }
  const int reason = errno;
  ::close(ends[1]);
  Child child(id, ends[0]);
  if (id < 0) throw Error(what + ": cannot start a child process: " + std::strerror(reason));

  const Clock::time_point end = Clock::now() + limits.time;
  Header header{};
  std::string bytes;
  ReadStatus read =
      read_all(ends[0], end, limits.should_continue, reinterpret_cast<char*>(&header), sizeof header);
  if (read == ReadStatus::all) {
    if (header.bytes > limits.result_bytes)
      throw Error(what + " gives " + mebibytes(header.bytes) + ", must be at most " +
                  mebibytes(limits.result_bytes));
    bytes.resize(header.bytes);
    read = read_all(ends[0], end, limits.should_continue, bytes.data(), bytes.size());
  }
  if (read == ReadStatus::cancelled) throw Cancelled(what + " was interrupted");
  if (read == ReadStatus::timed_out)
    throw Error(what + " took more than " + std::to_string(limits.time.count() / 1000) +
                " seconds; given up");
  if (read == ReadStatus::ended) {
    const int status = child.wait();
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGINT) throw Cancelled(what + " was interrupted");
    if (signal == SIGXCPU || signal == SIGKILL) throw Error(what + " took too much time or memory; given up");
    throw Error(what + " crashed: the file is damaged, or its reader does not support it");
  }
  if (header.kind == Header::no_memory)
    throw Error(what + " takes more than " + mebibytes(limits.memory_bytes) + " of memory; given up");
  if (header.kind == Header::error) throw Error(bytes);
  return bytes;
}

}  // namespace tessera::program
