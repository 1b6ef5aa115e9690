// Measures the cost of each draw of a frame, if DebugOptions::measure_draws asks for it.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "raster/bins.h"
#include "shading/draw_meter.h"

namespace tessera::detail {

/// Each worker adds to its own costs; finish() merges them.
class DrawMeasurer {
 public:
  /// Forgets the results and starts a frame. Throws std::bad_alloc.
  /// @param workers  0: draws are not measured, and no clock is read
  void begin_frame(std::size_t draws, std::size_t workers);
  bool is_on() const { return workers_in_use_ > 0; }
  /// Runs `work` and adds its time to a draw. Distinct workers may run concurrently.
  /// @param draw     number of the recorded draw
  /// @param seconds  member of DrawMeasurement that receives the time
  template <class Work>
  void run(int worker, std::size_t draw, double DrawMeasurement::*seconds, const Work& work) {
    if (!is_on()) return work();
    const auto begin = std::chrono::steady_clock::now();
    work();
    of(worker, draw).*seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  /// Runs `work`, in which all workers take part, and adds its wall time once per worker. Between passes
  /// only.
  template <class Work>
  void run_on_all(std::size_t draw, double DrawMeasurement::*seconds, const Work& work) {
    if (!is_on()) return work();
    double& sum = of(0, draw).*seconds;
    const double before = sum;
    run(0, draw, seconds, work);
    sum = before + (sum - before) * static_cast<double>(workers_in_use_);
  }
  /// Counts the elements that a task has binned between two states of its counts.
  void count_elements(int worker, std::size_t draw, const BinCounts& before, const BinCounts& after);
  /// Counts vertices [first, last), which one task processes.
  void count_vertices(int worker, std::size_t draw, std::size_t first, std::size_t last);
  /// Null if draws are not measured.
  DrawMeter* tile_meter(int worker);
  /// Merges the costs of all workers.
  void finish() noexcept;
  /// Per recorded draw; empty unless finish() has run.
  std::span<const DrawMeasurement> results() const { return results_; }

 private:
  /// Costs of one worker, in separate cache lines.
  struct alignas(64) WorkerCosts {
    std::vector<DrawMeasurement> stages;  // per draw: vertices and binning
    DrawMeter tiles;
  };
  DrawMeasurement& of(int worker, std::size_t draw) {
    return workers_[static_cast<std::size_t>(worker)].stages[draw];
  }

  std::vector<WorkerCosts> workers_;
  std::size_t workers_in_use_ = 0;
  std::size_t draws_ = 0;
  std::vector<DrawMeasurement> results_;
};

}  // namespace tessera::detail
