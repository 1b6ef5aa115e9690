// Generated smooth normals of meshes without normals.
#pragma once

#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/runtime/draw_measurer.h"
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
  void run(const FrameCommands& commands, WorkerPool& worker_pool, DrawMeasurer& draw_measurer,
           FrameProgress& progress, double done);

 private:
  struct Generator {
    SmoothNormals normals;
    WorkerPool serial_pool{1};
  };
  std::vector<Generator> generators_;  // one per worker that was ever needed
  std::vector<std::size_t> small_;     // plans of draws with small meshes
};

}  // namespace tessera::detail
