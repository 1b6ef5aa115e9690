// Draws a mesh: clips, rasterizes, shades and stores its primitives in order.
#pragma once

#include <cstdint>
#include <vector>

#include "sample_buffers.h"
#include "scene.h"
#include "window.h"

namespace tessera::reference {

/// Frame state at a draw.
struct FrameState {
  const Scene& scene;
  const Camera& camera;
  const std::vector<Light>& lights;
  std::int32_t command = 0;  ///< index in Scene::frame
  Point sample_shift{};      ///< shift of all sample positions, in 1/256 pixel
};

void draw_mesh(const Draw& draw, const FrameState& state, SampleBuffers& buffers);

}  // namespace tessera::reference
