// Pictures of colour-index buffers, for tests: rendering to stored indices, and triangles and states with few
// parameters.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

using PackedColors = std::vector<std::uint32_t>;
using Record = std::function<void(Frame&)>;

inline const FrameBufferFormat kIndexFormat{
    .width = 64, .height = 32, .color_mode = ColorMode::index, .color_bits = 6};

inline PackedColors drawn(const FrameBufferFormat& format, const Record& record,
                          const RendererOptions& options = {.threads = 1}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.clear({.index = 0, .depth = 1.0});
  record(frame);
  Renderer(options).finish(frame);
  return packed_colors(buffer);
}

// Covers the window. At pixel (x, y) from the lower left the interpolated value is a + (b - a) (x + 0.5) /
// 128 + (c - a) (y + 0.5) / 64.
inline MeshData large_triangle(float a, float b, float c) {
  MeshData mesh;
  mesh.positions = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  mesh.color_indices = {a, b, c};
  return mesh;
}

inline DrawState index_state(Shading shading = Shading::gouraud) {
  DrawState state;
  state.lighting = false;
  state.shading = shading;
  return state;
}

// States that draw the same picture on every pixel path: immediate, deferred, and with order-dependent or
// order-independent operations.
inline std::vector<DrawState> every_pixel_path(const DrawState& plain) {
  std::vector<DrawState> states(4, plain);
  states[1].logic_op = LogicOp::bit_or;
  states[2].stencil = StencilState{.front = {.zpass = StencilOp::incr}};
  states[3].polygon_offset = {0, 1};
  return states;
}
inline void expect_everywhere(std::uint32_t word, const MeshData& mesh, const DrawState& plain,
                              const FrameBufferFormat& format = kIndexFormat,
                              const std::vector<Light>& lights = {Light{}}) {
  for (const DrawState& state : every_pixel_path(plain)) {
    const PackedColors words = drawn(format, [&](Frame& frame) {
      frame.set_lights(lights);
      frame.draw(mesh.view(), state);
    });
    EXPECT_THAT(words, testing::Each(word))
        << "shading " << static_cast<int>(state.shading) << ", logic " << static_cast<int>(state.logic_op)
        << ", stencil " << state.stencil.has_value();
    if (testing::Test::HasFailure()) return;
  }
}

inline MeshData with_normals(float x, float y, float z) {
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.normals = {x, y, z, x, y, z, x, y, z};
  return mesh;
}

inline Material index_material(float ambient, float diffuse, float specular, float shininess) {
  Material material;
  material.index_ramp = {ambient, diffuse, specular};
  material.shininess = shininess;
  return material;
}

// The left half faces the viewer, the right half faces away.
inline MeshData two_faces() {
  MeshData mesh = rectangle(-1, -1, 0, 1);
  const MeshData right = rectangle(0, -1, 1, 1);
  mesh.positions.insert(mesh.positions.end(), right.positions.begin(), right.positions.end());
  mesh.indices.insert(mesh.indices.end(), {4, 6, 5, 4, 7, 6});
  for (int i = 0; i < 8; ++i) mesh.normals.insert(mesh.normals.end(), {0, 0, i < 4 ? 1.0f : -1.0f});
  return mesh;
}

}  // namespace tessera::test
