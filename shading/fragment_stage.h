// A fragment stage of the user as tiles run it: its inputs, its arrays, and what it may do wrong.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>

#include "framebuffer/tessera/stages.hpp"
#include "shading/lighting.h"

namespace tessera::detail {

/// Fields of StageArrays.
enum StageField : std::uint8_t {
  kStageX,
  kStageY,
  kStageAlpha,
  kStageEye,
  kStageNormal = kStageEye + 3,
  kStageExtras = kStageNormal + 3,
  kStageFields = kStageExtras + kMaxExtras
};

/// The values of a block of fragments that are not in its ShadingBatch.
struct alignas(64) StageArrays {
  float field[kStageFields][kBatchPoints];
  double depth[kBatchPoints];
  std::uint8_t keep[kBatchPoints];
};

/// The first exception of a frame's stages. After it, stages are not called any more.
class StageFailure {
 public:
  bool any() const { return failed_.load(std::memory_order_relaxed); }
  void set(std::exception_ptr exception) {
    const std::lock_guard lock(mutex_);
    if (!exception_) exception_ = std::move(exception);
    failed_.store(true, std::memory_order_relaxed);
  }
  /// Throws the exception, if there is one.
  void rethrow() {
    const std::lock_guard lock(mutex_);
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// The fragment stage of a draw. Offsets are those of the records of the vertices; -1: not read.
struct TileFragmentStage {
  FragmentStage stage;
  int eye = -1;
  int normal = -1;
  int extras = -1;
  bool runs_before_tests = false;  ///< its result decides which fragments pass
};

/// Calls the stage for the first `count` points.
/// @param face   properties of the block that its points share
/// @param batch  has the colours r g b
void call_fragment_stage(const TileFragmentStage& stage, FragmentBlock face, int count, ShadingBatch& batch,
                         StageArrays& arrays, StageFailure& failure);

}  // namespace tessera::detail
