// Renders a scene as the program does, at a few pixels.
#pragma once

#include <algorithm>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"

namespace tessera::fuzz {
using namespace program;

/// Skips scenes of many triangles, which are slow and add no coverage.
/// @throws Error as the program would.
inline void render_small(Scene scene) {
  constexpr int kMaxSidePixels = 32;
  constexpr std::size_t kMaxSceneTriangles = 20000;
  apply({.width = std::min(scene.framebuffer.width, kMaxSidePixels),
         .height = std::min(scene.framebuffer.height, kMaxSidePixels)},
        scene);
  std::size_t triangles = 0;
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.value))
      triangles += scene.meshes[draw->mesh].triangle_count();
  if (triangles > kMaxSceneTriangles) return;
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  for (std::size_t i = 0; i < frame.draw_count(); ++i) frame.explain(i);
  Picture picture(scene.framebuffer.width, scene.framebuffer.height);
  Renderer({.threads = 1}).finish(frame, picture.target());
}

}  // namespace tessera::fuzz
