// The processor's clock of the moment, and what else used the processor.
#pragma once

#include <cstdint>

namespace tessera::accuracy {

/// Cycles per millisecond of the calling thread's core: 100,000 dependent additions, one cycle each, are
/// timed.
/// - Takes about 30 microseconds. Measured in processor time, so that an interruption does not slow it.
double cycles_per_ms();

/// Processor time of all threads of this process, milliseconds.
double process_cpu_ms();

/// Disturbances of a measurement, summed.
struct Disturbance {
  std::int64_t involuntary_switches = 0;  ///< context switches of this process that it did not ask for
  double stolen_ms = 0;                   ///< time that a hypervisor took from all processors of the machine

  Disturbance& operator+=(const Disturbance& other);
};

/// Sums since the start of this process, or of the machine for stolen time.
Disturbance disturbance_so_far();
Disturbance operator-(const Disturbance& a, const Disturbance& b);

}  // namespace tessera::accuracy
