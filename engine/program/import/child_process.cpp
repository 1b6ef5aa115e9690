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
#include <utility>
#include <vector>

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
  enum Kind : std::uint64_t { result, error, no_memory, progress } kind;
  std::uint64_t value;  // payload size; for progress, the share that is done, of kAllDone
};
constexpr double kAllDone = 1 << 20;

constexpr std::size_t kBufferBytes = 1 << 16;  // pieces that are larger are not copied

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

void send_header(int to, Header::Kind kind, std::uint64_t value) {
  const Header header{kind, value};
  write_all(to, reinterpret_cast<const char*>(&header), sizeof header);
}

void send_text(int to, Header::Kind kind, std::string_view text) {
  send_header(to, kind, text.size());
  write_all(to, text.data(), text.size());
}

[[noreturn]] void run_child(int to, pid_t parent, const ChildLimits& limits,
                            const std::function<void(ChildOutput&)>& work) {
  // Silences libraries that print.
  if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // the parent ended before prctl()
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(limits.memory_bytes);
  try {
    ChildOutput output(to);
    work(output);
    output.flush();
  } catch (const std::bad_alloc&) {
    send_text(to, Header::no_memory, {});
  } catch (const std::exception& error) {
    send_text(to, Header::error, error.what());
  } catch (...) {
    send_text(to, Header::error, "an exception of unknown type");
  }
  ::_exit(0);
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

using Clock = std::chrono::steady_clock;

/// The parent's side of the pipe. Each received byte restarts the limit of time.
class Connection {
 public:
  Connection(const std::string& what, const ChildLimits& limits, pid_t id, int from)
      : what_(what), limits_(limits), child_(id, from), from_(from) {}

  void read(char* to, std::size_t count) {
    while (count > 0) {
      if (begin_ == end_ && count >= kBufferBytes) {
        const std::size_t taken = receive(to, std::min(count, kMaxRead));
        to += taken;
        count -= taken;
        continue;
      }
      if (begin_ == end_) begin_ = 0, end_ = receive(buffer_.data(), buffer_.size());
      const std::size_t copied = std::min(count, end_ - begin_);
      std::copy_n(&buffer_[begin_], copied, to);
      begin_ += copied;
      to += copied;
      count -= copied;
    }
  }

  Header read_header() {
    Header header{};
    do {
      read(reinterpret_cast<char*>(&header), sizeof header);
      if (header.kind == Header::progress && limits_.progress)
        limits_.progress(static_cast<double>(header.value) / kAllDone);
    } while (header.kind == Header::progress);
    return header;
  }

 private:
  static constexpr std::size_t kMaxRead = std::size_t{1} << 24;  // so that should_continue is asked

  /// Waits until the pipe has bytes. Returns how many it gave, at least 1.
  std::size_t receive(char* to, std::size_t max_count) {
    const Clock::time_point end = Clock::now() + limits_.time;
    for (;;) {
      if (limits_.should_continue && !limits_.should_continue()) throw Cancelled(what_ + " was interrupted");
      if (!wait_for_bytes(end)) continue;
      const ssize_t taken = ::read(from_, to, max_count);
      if (taken > 0) return static_cast<std::size_t>(taken);
      if (taken == 0 || errno != EINTR) report_end();
    }
  }

  /// Waits for at most 100 ms. Returns whether a read would not block.
  bool wait_for_bytes(Clock::time_point end) {
    constexpr std::chrono::milliseconds kPause(100);
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0)
      throw Error(what_ + " made no progress for " + std::to_string(limits_.time.count() / 1000) +
                  " seconds; given up");
    pollfd waiting{from_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min(left, kPause).count()));
    if (ready < 0 && errno != EINTR) report_end();
    return ready > 0;
  }

  [[noreturn]] void report_end() {
    const int status = child_.wait();
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGINT) throw Cancelled(what_ + " was interrupted");
    if (signal == SIGKILL) throw Error(what_ + " took too much memory; given up");
    throw Error(what_ + " crashed: the file is damaged, or its reader does not support it");
  }

  const std::string& what_;
  const ChildLimits& limits_;
  Child child_;
  int from_;
  std::vector<char> buffer_ = std::vector<char>(kBufferBytes);
  std::size_t begin_ = 0, end_ = 0;  // range of the buffer that is not yet read
};

/// Starts the child. Returns its process and the pipe from it.
std::pair<pid_t, int> fork_child(const std::string& what, const ChildLimits& limits,
                                 const std::function<void(ChildOutput&)>& work) {
  int ends[2];
  if (!make_pipe(ends))
    throw Error(what + ": cannot create a pipe to a child process: " + std::strerror(errno));
  ::fcntl(ends[1], F_SETPIPE_SZ, 1 << 20);  // fewer switches between the processes; may be refused
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(ends[0]);
    run_child(ends[1], parent, limits, work);
  }
  const int reason = errno;
  ::close(ends[1]);
  if (id < 0) {
    ::close(ends[0]);
    throw Error(what + ": cannot start a child process: " + std::strerror(reason));
  }
  return {id, ends[0]};
}

}  // namespace

void ChildOutput::report(double done) {
  constexpr std::chrono::milliseconds kInterval(50);
  const auto now = Clock::now();
  if (!(done > reported_) || now - last_report_ < kInterval) return;
  reported_ = done;
  last_report_ = now;
  send_header(pipe_, Header::progress, static_cast<std::uint64_t>(std::min(done, 1.0) * kAllDone));
}

void ChildOutput::begin_result(std::uint64_t bytes) { send_header(pipe_, Header::result, bytes); }

void ChildOutput::write(const char* bytes, std::size_t count) {
  if (buffer_.size() + count > kBufferBytes) flush();
  if (count > kBufferBytes) write_all(pipe_, bytes, count);
  else buffer_.append(bytes, count);
}

void ChildOutput::flush() {
  write_all(pipe_, buffer_.data(), buffer_.size());
  buffer_.clear();
}

void run_in_child(const std::string& what, const ChildLimits& limits,
                  const std::function<void(ChildOutput&)>& work,
                  const std::function<void(const ByteReader&, std::uint64_t bytes)>& receive) {
  const auto [id, pipe] = fork_child(what, limits, work);
  Connection connection(what, limits, id, pipe);
  const Header header = connection.read_header();
  if (header.kind == Header::no_memory)
    throw Error(what + " takes more than " + mebibytes(limits.memory_bytes) + " of memory; given up");
  if (header.value > limits.result_bytes)
    throw Error(what + " gives " + mebibytes(header.value) + ", must be at most " +
                mebibytes(limits.result_bytes));
  const auto read = [&connection](char* to, std::size_t count) { connection.read(to, count); };
  if (header.kind == Header::result) return receive(read, header.value);
  std::string message(header.value, '\0');
  read(message.data(), message.size());
  throw Error(message);
}

std::string run_in_child(const std::string& what, const ChildLimits& limits,
                         const std::function<std::string()>& work) {
  std::string result;
  const auto send = [&](ChildOutput& output) {
    const std::string bytes = work();
    output.begin_result(bytes.size());
    output.write(bytes.data(), bytes.size());
  };
  run_in_child(what, limits, send, [&](const ByteReader& read, std::uint64_t bytes) {
    result.resize(bytes);
    read(result.data(), result.size());
  });
  return result;
}

}  // namespace tessera::program
