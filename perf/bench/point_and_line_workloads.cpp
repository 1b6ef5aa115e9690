// A million points and a million lines, scattered over the window.
#include <random>

#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
namespace {

constexpr int kCount = 1000000;

/// Random numbers that are the same on every machine.
class Rng {
 public:
  explicit Rng(std::uint32_t seed) : random_(seed) {}
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(random_() >> 8) * 0x1p-24f;
  }

 private:
  std::mt19937 random_;
};

Drawing scattered(int width, int height, std::uint32_t seed, Primitive primitive) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  MeshData mesh;
  mesh.primitive = primitive;
  Rng rng(seed);
  // 16 pixels in clip space.
  const float reach_x = 32.0f / static_cast<float>(width);
  const float reach_y = 32.0f / static_cast<float>(height);
  for (int i = 0; i < kCount; ++i) {
    const float x = rng.between(-1, 1), y = rng.between(-1, 1), z = rng.between(-1, 1);
    for (int end = 0; end < (primitive == Primitive::lines ? 2 : 1); ++end) {
      mesh.positions.insert(mesh.positions.end(), {x + (end != 0 ? rng.between(-reach_x, reach_x) : 0),
                                                   y + (end != 0 ? rng.between(-reach_y, reach_y) : 0), z});
      mesh.colors.insert(mesh.colors.end(),
                         {rng.between(0.1f, 1), rng.between(0.1f, 1), rng.between(0.1f, 1), 1});
    }
  }
  drawing.meshes.push_back(std::move(mesh));
  drawing.gl_workload = [primitive](const Drawing& d) {
    GlWorkload gl{.mesh = d.meshes.front(),
                  .shaders = rivals::window_shaders(rivals::Varying::colors),
                  .tests_depth = true};
    // OpenGL leaves the end pixel of a line, and the depth of pixels next to the ideal line, to the
    // implementation.
    if (primitive == Primitive::lines) gl.max_mismatch_share = 0.1;
    return gl;
  };
  drawing.record = [](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.lighting = false;
    frame.draw(d.meshes.front().view(), state);
  };
  return drawing;
}

WorkloadEntry point_and_line_entry(const std::string& name, const std::string& description,
                                   Primitive primitive) {
  return drawn(name, description, [=](int width, int height, std::uint32_t seed) {
    return scattered(width, height, seed, primitive);
  });
}

}  // namespace

std::vector<WorkloadEntry> point_and_line_workloads() {
  return {
      point_and_line_entry("points-1M", "a million points of one pixel, coloured, depth", Primitive::points),
      point_and_line_entry("lines-1M", "a million lines of up to 16 pixels along each axis, coloured, depth",
                           Primitive::lines)};
}

}  // namespace tessera::bench
