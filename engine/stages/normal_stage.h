// Generated smooth normals of meshes without normals.
#pragma once

#include <span>
#include <vector>

#include "engine/runtime/frame_progress.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/generated_normals.h"
#include "engine/stages/geometry.h"

namespace tessera::detail {

/// Memory is kept from frame to frame.
class NormalStage {
 public:
  /// Generates the normals that draws need: large meshes by all workers together, small ones by one worker
  /// each. Throws std::bad_alloc, and exceptions of FrameProgress::task().
  /// @param done  share of the frame that is done at the end
  void run(std::span<const GeometryDraw> draws, WorkerPool& worker_pool, FrameProgress& progress,
           double done);

 private:
  struct Generator {
    SmoothNormals normals;
    WorkerPool serial_pool{1};
  };
  std::vector<Generator> generators_;       // one per worker that was ever needed
  std::vector<const GeometryDraw*> small_;  // draws with small meshes
};

}  // namespace tessera::detail
