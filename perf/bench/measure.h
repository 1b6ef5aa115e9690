// Times frames: the cold first frame, then, after a warm-up, enough frames for a stable median.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "perf/bench/counters.h"
#include "perf/bench/statistics.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

/// Row::fault if memory ran out.
inline constexpr const char* kOutOfMemory = "out of memory";

struct MeasureOptions {
  int repeats = 0;                  ///< frames per row; 0: as many as fit in `seconds`, at least 15
  double seconds = 1;               ///< per row; rooflines use it even if `repeats` is set
  double warm_up_seconds = 0.2;     ///< per row and roofline, at most `seconds`
  std::uint32_t seed = 1;           ///< for the order of turns
  bool measures_rooflines = false;  ///< also time each row's roofline, in turns with its frames
  /// Also time ReferenceWork in turns with the frames, on the threads of the first candidate.
  bool measures_reference = false;
};

/// Ratio of a row's median to that of its baseline, measured in turns.
struct BaselineRatio {
  std::string baseline;  ///< name of the workload
  Ratio ratio;
};

struct Row {
  std::string name;
  int threads = 0;
  std::size_t frames = 0;
  double cold_ms = 0;               ///< first frame, including set-up of renderer and frame buffer
  std::uint64_t peak_bytes = 0;     ///< memory growth up to the end of the first frame, meshes included
  std::uint64_t working_bytes = 0;  ///< part of it that the first frame took, without planes and image
  Statistics ms;
  FrameWork work;
  std::optional<HardwareCounters::Counts> counts{};  ///< per frame
  /// Rate of the workload's roofline in 10^9 bytes/s; 0: none, or not measured.
  double roofline = 0;
  /// L1 store rate in 10^9 bytes/s, for Roofline::tile_stores only.
  double l1_stores = 0;
  double reference_ms = 0;  ///< median time of a unit of ReferenceWork; 0: not measured
  std::optional<BaselineRatio> to_baseline{};
  std::optional<Ratio> earlier_over_now{};  ///< see run_comparison.h; std::nullopt: no --compare
  int confirmations = 0;  ///< times that the row was measured again because it looked slower than earlier
  /// Fault of the picture, or the error that stopped the row; empty: none.
  std::string fault;
  bool is_aborted = false;  ///< whether `fault` is an error that stopped the row
};

struct Candidate {
  std::string name;
  std::function<std::unique_ptr<Workload>()> make;
  int threads = 0;
  /// Additional check of the picture: returns the fault, or an empty string. Optional.
  std::function<std::string(const Picture&)> validate{};
};

/// Makes the candidates, draws and checks one frame of each, then times them in turns.
/// - Each gets the same number of turns, in random order; rooflines may get fewer.
/// - After a change of candidate one untimed frame is drawn first.
/// - If a candidate has a fault or throws, none is timed.
std::vector<Row> measure(std::span<const Candidate> candidates, const MeasureOptions& options,
                         const HardwareCounters& counters);

}  // namespace tessera::bench
