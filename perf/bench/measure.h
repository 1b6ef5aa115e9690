// Times frames: first the cold one, then, after a warm-up, so many that their median stands still.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "perf/bench/counters.h"
#include "perf/bench/statistics.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

/// The fault of a row whose frames there was no memory for.
inline constexpr const char* kOutOfMemory = "out of memory";

struct MeasureOptions {
  int repeats = 0;     ///< frames of each row; 0: as many as `seconds` hold, 15 at least
  double seconds = 1;  ///< for each row; for what it is held against always
  double warm_up_seconds = 0.2;
  std::uint32_t seed = 1;           ///< of the order in which rows take turns
  bool measures_rooflines = false;  ///< what a row is held against takes turns with it
};

struct Row {
  std::string name;
  int threads = 0;
  std::size_t frames = 0;
  double cold_ms = 0;               ///< renderer, frame buffer and first frame
  std::uint64_t peak_bytes = 0;     ///< of memory, with meshes, until the first frame is finished
  std::uint64_t working_bytes = 0;  ///< of that, what the first frame took, without planes and image
  Statistics ms;
  FrameWork work;
  std::optional<HardwareCounters::Counts> counts{};  ///< of a frame
  double roofline = 0;      ///< 10^9 bytes a second, where there is one and it was measured
  double l1_stores = 0;     ///< the same of stores in L1, where tiles' words are what is stored
  std::string fault;        ///< of the picture, or what stopped it; empty: it is right
  bool is_aborted = false;  ///< no memory, say: the fault is nothing that was drawn
};

struct Candidate {
  std::string name;
  std::function<std::unique_ptr<Workload>()> make;
  int threads = 0;
  std::function<std::string(const Picture&)>
      validate{};  ///< says what is wrong with what was drawn, or nothing; may be empty
};

/// Makes the candidates, draws and checks each, and then lets them take turns, as many each (limits may take
/// fewer), in random order; who follows another draws a frame first that is not timed. Where one has a fault,
/// or throws, none is timed.
std::vector<Row> measure(std::span<const Candidate> candidates, const MeasureOptions& options,
                         const HardwareCounters& counters);

}  // namespace tessera::bench
