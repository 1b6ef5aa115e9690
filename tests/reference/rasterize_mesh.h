// The primitives of a draw and their fragments: clipping, facing, culling, polygon modes and coverage, before
// any test of a fragment.
#pragma once

#include <cstddef>
#include <functional>

#include "scene.h"
#include "vertex_stage.h"
#include "window.h"

namespace tessera::reference {

/// A point, line or polygon that was neither clipped away nor culled.
struct DrawnPrimitive {
  const Corners& corners;
  std::size_t number = 0;  ///< in the mesh
  bool is_back = false;
};

/// Called once per drawn primitive. Returns what takes its fragments, which may be none.
using PrimitiveCallback = std::function<FragmentCallback(const DrawnPrimitive&)>;

/// @param camera  current at the draw
/// @param sample_shift  of all sample positions, in 1/256 pixel
void rasterize_mesh(const Mesh& mesh, const Draw& draw, const Camera& camera, const FrameBufferFormat& format,
                    const PrimitiveCallback& start, Point sample_shift = {});

}  // namespace tessera::reference
