// What the processor counts, where the kernel lets this process see it.
#pragma once

#include <cstdint>
#include <optional>

namespace tessera::bench {

/// Of this process and all threads that it starts later on, in user mode.
class HardwareCounters {
 public:
  HardwareCounters();
  ~HardwareCounters();
  HardwareCounters(const HardwareCounters&) = delete;
  HardwareCounters& operator=(const HardwareCounters&) = delete;

  struct Counts {
    std::uint64_t cycles = 0, instructions = 0;
  };
  /// Since the start; absent where there are no counters.
  std::optional<Counts> read() const;

 private:
  int cycles_ = -1, instructions_ = -1;
};

}  // namespace tessera::bench
