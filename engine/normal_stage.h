// The smooth normals of a frame's meshes that have none.
#pragma once

#include <span>
#include <vector>

#include "engine/frame_watch.h"
#include "engine/generated_normals.h"
#include "engine/geometry.h"
#include "engine/parallel.h"

namespace tessera {

/// Memory for them is kept from frame to frame.
class NormalStage {
 public:
  /// Makes those that draws want: of a large mesh all workers together, each small one some worker alone.
  /// Throws std::bad_alloc, and what FrameWatch::task() throws.
  /// @param done  share of the frame that is done then
  void run(std::span<const GeometryDraw> draws, Parallel& parallel, FrameWatch& watch, double done);

 private:
  struct Maker {
    SmoothNormals normals;
    Parallel alone{1};
  };
  std::vector<Maker> makers_;  // one for each worker that has ever been needed
  std::vector<const GeometryDraw*> small_;
};

}  // namespace tessera
