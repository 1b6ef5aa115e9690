#include "engine/program/threads/thread_limit.h"

#include <algorithm>
#include <cstddef>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

namespace tessera::program {

namespace tbb = oneapi::tbb;

int available_cores() { return std::max(1, tbb::info::default_concurrency()); }

struct ThreadLimit::Control {
  explicit Control(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) : control_(std::make_unique<Control>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace tessera::program
