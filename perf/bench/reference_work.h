// Work that does not depend on Tessera: how fast the machine is while a row is measured.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/runtime/worker_pool.h"

namespace tessera::bench {
using namespace detail;

/// Arithmetic on memory that fits in L2 caches, on all threads. Other programs, a lower clock and neighbours
/// of a virtual machine slow it down as they slow down frames, so its time shows the drift between two runs.
class ReferenceWork {
 public:
  /// @param threads  1 or more
  /// @param seconds  approximate time of a run; it has at least one unit per thread
  ReferenceWork(int threads, double seconds);

  void run();
  /// Units of work that run() does, on all threads together.
  std::size_t units() const { return units_; }

 private:
  WorkerPool worker_pool_;
  std::vector<std::vector<float>> memory_;  // per thread
  std::size_t units_ = 1;
};

}  // namespace tessera::bench
