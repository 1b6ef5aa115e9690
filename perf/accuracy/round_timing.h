// Times alternatives in rounds: they take turns, so that a clock that changes affects all alike.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "perf/bench/counters.h"

namespace tessera::accuracy {

/// One turn, per frame.
struct Turn {
  double wall_ms = 0;
  double cpu_ms = 0;          ///< processor time of all threads
  double million_cycles = 0;  ///< sum over all threads
};

/// One round: the first alternative opens and closes it and also takes a turn.
struct Round {
  Turn opening, closing;
  std::vector<Turn> turns;  ///< one per alternative, in the order given to RoundTimer
};

/// Frames shorter than this are repeated within their turn.
inline constexpr double kMinTurnMs = 2;

class RoundTimer {
 public:
  /// Draws each alternative three times, to warm up and to choose the frames per turn.
  /// @param draws     each draws one frame; the first is the default
  /// @param counters  opened before the threads that draw were started; must outlive this
  RoundTimer(std::vector<std::function<void()>> draws, const bench::HardwareCounters& counters);

  /// Runs one round in an order that follows from the seed.
  /// - Cycles are those of hardware counters, or else processor time times the clock measured before the
  /// turn.
  Round run(std::uint32_t seed) const;

 private:
  Turn turn(std::size_t alternative) const;

  std::vector<std::function<void()>> draws_;
  std::vector<int> frames_;  // per turn
  const bench::HardwareCounters& counters_;
};

}  // namespace tessera::accuracy
