#include "perf/accuracy/processor_clock.h"

#include <ctime>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace tessera::accuracy {
namespace {

double clock_ms(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Stolen time of /proc/stat: the eighth number of its first line [man 5 proc].
double stolen_ms() {
  std::ifstream file("/proc/stat");
  std::string word;
  double ticks = 0;
  file >> word;
  for (int i = 0; i < 8; ++i) file >> ticks;
  return file ? 1e3 * ticks / static_cast<double>(::sysconf(_SC_CLK_TCK)) : 0;
}

}  // namespace

double cycles_per_ms() {
  constexpr int kAdditions = 100'000;
  std::uint64_t sum = 0, step = 1;
  asm volatile("" : "+r"(step));  // a constant step could be folded, by the compiler or by the processor
  const double start = clock_ms(CLOCK_THREAD_CPUTIME_ID);
  for (int i = 0; i < kAdditions; ++i) {
    sum += step;
    asm volatile("" : "+r"(sum));
  }
  return kAdditions / (clock_ms(CLOCK_THREAD_CPUTIME_ID) - start);
}

double process_cpu_ms() { return clock_ms(CLOCK_PROCESS_CPUTIME_ID); }

Disturbance& Disturbance::operator+=(const Disturbance& other) {
  involuntary_switches += other.involuntary_switches;
  stolen_ms += other.stolen_ms;
  return *this;
}

Disturbance operator-(const Disturbance& a, const Disturbance& b) {
  return {a.involuntary_switches - b.involuntary_switches, a.stolen_ms - b.stolen_ms};
}

Disturbance disturbance_so_far() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return {usage.ru_nivcsw, stolen_ms()};
}

}  // namespace tessera::accuracy
