// Two frames at once that share nothing but the machine: where they are not twice as fast as one, it holds
// two threads back, whatever these share.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "engine/runtime/worker_pool.h"
#include "perf/bench/statistics.h"
#include "perf/bench/workload.h"

namespace tessera::bench {
using namespace detail;

/// The same workload twice, on a thread each. What is wrong with one of them is wrong with it; the rest is
/// the first one's.
class IndependentRenderers : public Workload {
 public:
  static constexpr int kFrames =
      3;  ///< that each of them draws in a draw(), so that little of it is one that waits for the other
  /// How many times as fast as one alone they draw.
  static Ratio speed_up(const Statistics& one, const Statistics& draws) {
    const Ratio ratio = ratio_of(one, draws);
    constexpr double kAll = 2 * kFrames;
    return {kAll * ratio.value, kAll * ratio.low, kAll * ratio.high};
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
