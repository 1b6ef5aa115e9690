#include "perf/accuracy/timing_processes.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/program/cli/progress.h"
#include "engine/program/threads/thread_limit.h"
#include "perf/accuracy/setting_frames.h"

namespace tessera::accuracy {
namespace {

void write_turn(std::FILE* out, const Turn& turn) {
  std::fprintf(out, " %.17g %.17g %.17g", turn.wall_ms, turn.cpu_ms, turn.million_cycles);
}

void write_round(std::FILE* out, std::size_t threads, std::size_t scene, const Round& round) {
  std::fprintf(out, "round %zu %zu", threads, scene);
  write_turn(out, round.opening);
  write_turn(out, round.closing);
  for (const Turn& turn : round.turns) write_turn(out, turn);
  std::fprintf(out, "\n");
  std::fflush(out);
}

/// The seed of a round's order differs between all rounds of a run, and is the same in every run.
std::uint32_t seed_of(std::size_t threads, std::size_t scene, int process, int round) {
  return static_cast<std::uint32_t>(((threads * 1000 + scene) * 10 + static_cast<std::size_t>(process)) *
                                    1000) +
         static_cast<std::uint32_t>(round) + 1;
}

Turn read_turn(const char*& text) {
  const auto number = [&text] {
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text) throw Error("a timing process wrote a line that ends early");
    text = end;
    return value;
  };
  Turn turn;
  turn.wall_ms = number();
  turn.cpu_ms = number();
  turn.million_cycles = number();
  return turn;
}

/// A line of text from a pipe.
class Lines {
 public:
  explicit Lines(int file) : file_(::fdopen(file, "r"), std::fclose) {}
  ~Lines() { std::free(line_); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
  const char* next() { return ::getline(&line_, &capacity_, file_.get()) < 0 ? nullptr : line_; }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  char* line_ = nullptr;
  std::size_t capacity_ = 0;
};

struct Child {
  pid_t id;
  int output;
};

Child start(const std::vector<std::string>& arguments) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(std::string("cannot create a pipe: ") + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  std::vector<std::string> words{"tessera-accuracy"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t id = 0;
  const int error = ::posix_spawn(&id, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    throw Error(std::string("cannot start a timing process: ") + std::strerror(error));
  }
  return {id, ends[0]};
}

void require_success(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {}
  if (program::cli::Interrupt::pressed()) throw Cancelled("interrupted");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error("a timing process ended with " +
                (WIFSIGNALED(status) ? std::string(::strsignal(WTERMSIG(status))) : "an error") +
                ", expected success");
}

}  // namespace

int rounds_of_process(int rounds, int process) {
  return rounds / kProcesses + (process < rounds % kProcesses ? 1 : 0);
}

bool time_in_this_process(std::vector<TimedScene>& scenes, const TimingPlan& plan, int process,
                          std::FILE* out) {
  const bench::HardwareCounters counters;  // opened before any thread is started
  std::fprintf(out, "counters %d\n", counters.read() ? 1 : 0);
  const Disturbance before = disturbance_so_far();
  for (std::size_t t = 0; t < plan.threads.size(); ++t) {
    const program::ThreadLimit limit(plan.threads[t]);
    Renderer renderer({.threads = plan.threads[t], .instruction_set = plan.instruction_set});
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      std::vector<std::unique_ptr<SettingFrames>> frames;
      std::vector<std::function<void()>> draws;
      for (const Setting& setting : scenes[s].settings) {
        frames.push_back(std::make_unique<SettingFrames>(scenes[s].scene, setting.variation, renderer));
        draws.push_back([&frame = *frames.back()] { frame.draw(); });
      }
      const RoundTimer timer(std::move(draws), counters);
      for (int round = 0; round < rounds_of_process(plan.rounds, process); ++round) {
        if (program::cli::Interrupt::pressed()) return false;
        write_round(out, t, s, timer.run(seed_of(t, s, process, round)));
      }
    }
  }
  const Disturbance disturbance = disturbance_so_far() - before;
  std::fprintf(out, "disturbance %lld %.17g\n", static_cast<long long>(disturbance.involuntary_switches),
               disturbance.stolen_ms);
  return true;
}

ProcessTimes times_of_process(const std::vector<std::string>& arguments,
                              const std::vector<TimedScene>& scenes, const TimingPlan& plan,
                              const std::function<bool(int)>& progress) {
  ProcessTimes times;
  times.rounds.assign(plan.threads.size(), std::vector<ProcessRounds>(scenes.size()));
  const Child child = start(arguments);
  Lines lines(child.output);
  int done = 0;
  while (const char* line = lines.next()) {
    std::size_t t = 0, s = 0;
    int length = 0, has_counters = 0;
    long long switches = 0;
    if (std::sscanf(line, "round %zu %zu%n", &t, &s, &length) == 2 && t < plan.threads.size() &&
        s < scenes.size()) {
      const char* text = line + length;
      Round& round = times.rounds[t][s].emplace_back();
      round.opening = read_turn(text);
      round.closing = read_turn(text);
      for (std::size_t k = 0; k < scenes[s].settings.size(); ++k) round.turns.push_back(read_turn(text));
      if (!progress(++done)) ::kill(child.id, SIGINT);
    } else if (std::sscanf(line, "counters %d", &has_counters) == 1) {
      times.has_counters = has_counters != 0;
    } else if (std::sscanf(line, "disturbance %lld %lg", &switches, &times.disturbance.stolen_ms) == 2) {
      times.disturbance.involuntary_switches = switches;
    }
  }
  require_success(child.id);
  return times;
}

}  // namespace tessera::accuracy
