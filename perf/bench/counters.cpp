#include "perf/bench/counters.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tessera::bench {
namespace {

int open_counter(std::uint64_t config) {
  perf_event_attr attributes{};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof attributes;
  attributes.config = config;
  attributes.inherit = 1;  // to threads that are started later
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  return static_cast<int>(::syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

std::optional<std::uint64_t> read_counter(int file) {
  std::uint64_t count = 0;
  if (file < 0 || ::read(file, &count, sizeof count) != sizeof count) return std::nullopt;
  return count;
}

}  // namespace

HardwareCounters::HardwareCounters()
    : cycles_(open_counter(PERF_COUNT_HW_CPU_CYCLES)),
      instructions_(open_counter(PERF_COUNT_HW_INSTRUCTIONS)) {}

HardwareCounters::~HardwareCounters() {
  for (const int file : {cycles_, instructions_})
    if (file >= 0) ::close(file);
}

std::optional<HardwareCounters::Counts> HardwareCounters::read() const {
  const std::optional<std::uint64_t> cycles = read_counter(cycles_);
  const std::optional<std::uint64_t> instructions = read_counter(instructions_);
  if (!cycles || !instructions) return std::nullopt;
  return Counts{*cycles, *instructions};
}

}  // namespace tessera::bench
