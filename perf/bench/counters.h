// Hardware performance counters, where the kernel permits them.
#pragma once

#include <cstdint>
#include <optional>

namespace tessera::bench {

/// Counts user-mode events of this thread and of all threads that it starts later.
class HardwareCounters {
 public:
  HardwareCounters();
  ~HardwareCounters();
  HardwareCounters(const HardwareCounters&) = delete;
  HardwareCounters& operator=(const HardwareCounters&) = delete;

  struct Counts {
    std::uint64_t cycles = 0;
    std::uint64_t instructions = 0;
  };
  /// Counts since construction; std::nullopt if the counters are not available.
  std::optional<Counts> read() const;

 private:
  int cycles_ = -1;
  int instructions_ = -1;
};

}  // namespace tessera::bench
