// The smooth normals of a frame's meshes that have none.
#pragma once

#include <span>
#include <vector>

#include "engine/runtime/frame_progress.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/generated_normals.h"
#include "engine/stages/geometry.h"

namespace tessera::detail {

/// Memory for them is kept from frame to frame.
class NormalStage {
 public:
  /// Makes those that draws want: of a large mesh all workers together, each small one some worker alone.
  /// Throws std::bad_alloc, and what FrameProgress::task() throws.
  /// @param done  share of the frame that is done then
  void run(std::span<const GeometryDraw> draws, WorkerPool& worker_pool, FrameProgress& progress,
           double done);

 private:
  struct Generator {
    SmoothNormals normals;
    WorkerPool serial_pool{1};
  };
  std::vector<Generator> generators_;  // one for each worker that has ever been needed
  std::vector<const GeometryDraw*> small_;
};

}  // namespace tessera::detail
