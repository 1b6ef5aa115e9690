// Shared by tests of user stages: two balls drawn with a state, and comparisons of frame buffers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "engine/program/scene/builtin_mesh.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::test::user_stages {

inline const FrameBufferFormat kFormat{.width = 90, .height = 60};

inline void keep_everything(const FragmentBlock&, void*) {}

inline FragmentStage pass_through() {
  return {.run = keep_everything,
          .name = "pass through",
          .reads = {.position = true, .depth = true, .color = true, .eye = true, .normal = true}};
}

/// A sphere of big and small triangles with colours, normals and texture coordinates.
inline const MeshData& ball() {
  static const MeshData kBall = [] {
    MeshData mesh = builtin_mesh("sphere", 9);
    Random random(3);
    for (std::size_t i = 0; i < mesh.positions.size() / 3; ++i)
      for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0.2f, 1));
    return mesh;
  }();
  return kBall;
}

/// Records two balls that cut each other, with a perspective view; near parts are clipped.
inline void record_balls(Frame& frame, DrawState state, bool clears_depth = true,
                         const MeshData& mesh = ball()) {
  Clear clear{.color = Color{0.1f, 0.2f, 0.3f, 1}};
  if (clears_depth) clear.depth = 1.0;
  frame.clear(clear);
  frame.set_camera({.view = look_at({0.4f, 0.6f, 2.2f}, {0, 0, 0}, {0, 1, 0}),
                    .projection = perspective(50, 1.5, 0.9, 10)});
  Light point;
  point.position = {1, 2, 2, 1};
  frame.set_lights({Light{}, point});
  frame.set_light_model({.local_viewer = true, .two_sided = true});
  frame.draw(mesh.view(), state);
  state.transform = translate(0.7, 0.2, 0.4) * rotate(70, 1, 1, 0);
  frame.draw(mesh.view(), state);
}

struct Picture {
  FrameBuffer buffer;
  FrameStats stats;

  explicit Picture(const FrameBufferFormat& format) : buffer(format) {}
};

/// The picture of record_balls().
inline std::unique_ptr<Picture> picture(const FrameBufferFormat& format, const DrawState& state,
                                        const RendererOptions& options = {.threads = 2},
                                        const MeshData& mesh = ball()) {
  auto result = std::make_unique<Picture>(format);
  Frame frame(result->buffer);
  record_balls(frame, state, format.depth != DepthFormat::none, mesh);
  result->stats = Renderer(options).finish(frame);
  return result;
}

inline std::vector<std::uint32_t> colors_of(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> colors(pixel_count(buffer));
  buffer.read_packed_colors(colors);
  return colors;
}

/// Largest difference of a component.
inline int largest_difference(const FrameBuffer& a, const FrameBuffer& b) {
  const std::vector<std::uint32_t> x = colors_of(a), y = colors_of(b);
  int largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int shift = 0; shift < 32; shift += 8)
      largest = std::max(
          largest, std::abs(static_cast<int>(x[i] >> shift & 255) - static_cast<int>(y[i] >> shift & 255)));
  return largest;
}

inline DrawState shiny(Shading shading) {
  DrawState state;
  state.shading = shading;
  state.material.specular = {0.6f, 0.6f, 0.6f, 1};
  state.material.shininess = 20;
  return state;
}

}  // namespace tessera::test::user_stages
