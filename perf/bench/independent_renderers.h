// Two renderers that share nothing but the machine. If they are not twice as fast as one, the limit is the
// machine (clock, caches, memory), not what the threads of a frame share.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "engine/runtime/worker_pool.h"
#include "perf/bench/statistics.h"
#include "perf/bench/workload.h"

namespace tessera::bench {
using namespace detail;

/// The same workload twice, each on one thread. Reports a fault of either; statistics and picture are those
/// of the first.
class IndependentRenderers : public Workload {
 public:
  /// Frames per renderer in one draw(). With several, the time in which one waits for the other is small.
  static constexpr int kFrames = 3;
  /// Speed-up over one renderer.
  /// @param one    times of a single frame on one thread
  /// @param draws  times of draw() of this class
  static Ratio speed_up(const Statistics& one, const Statistics& draws) {
    const Ratio ratio = ratio_of(one, draws);
    constexpr double kAllFrames = 2 * kFrames;
    return {kAllFrames * ratio.value, kAllFrames * ratio.low, kAllFrames * ratio.high};
  }

  IndependentRenderers(const WorkloadEntry& entry, WorkloadSetup setup) {
    setup.options.threads = 1;
    for (std::unique_ptr<Workload>& workload : workloads_) workload = entry.make(setup);
  }

  FrameStats draw() override {
    std::array<FrameStats, 2> stats;
    worker_pool_.for_each(stats.size(), [&](std::size_t i, int) {
      for (int frame = 0; frame < kFrames; ++frame) stats[i] = workloads_[i]->draw();
    });
    return stats.front();
  }
  std::string fault() override {
    for (const std::unique_ptr<Workload>& workload : workloads_)
      if (std::string fault = workload->fault(); !fault.empty()) return fault;
    return {};
  }
  const Picture& picture() override { return workloads_.front()->picture(); }
  FrameWork work(const FrameStats& stats) const override { return workloads_.front()->work(stats); }

 private:
  WorkerPool worker_pool_{2};
  std::array<std::unique_ptr<Workload>, 2> workloads_;
};

}  // namespace tessera::bench
