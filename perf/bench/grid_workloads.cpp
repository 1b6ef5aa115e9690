// Gouraud-shaded grids over the whole window, with depth: one to a hundred pixels per triangle.
#include <algorithm>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/passing_stages.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
namespace {

struct Grid {
  int side = 100;  ///< 2 * side^2 triangles
  int samples = 1;
  bool has_vertex_stage = false;  ///< user stage that passes clip positions through
};

Drawing grid(int width, int height, const Grid& grid) {
  const int samples = grid.samples;
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0, .samples = samples};
  drawing.meshes.push_back(window_grid(grid.side, grid.side, 0, 0.3f));
  if (samples == 1)  // every pixel exactly once, also along shared edges
    drawing.fragments = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  drawing.record = [has_stage = grid.has_vertex_stage](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.lighting = false;
    if (has_stage) state.vertex_stage = kPassingVertexStage;
    frame.draw(d.meshes.front().view(), state);
  };
  drawing.gl_workload = [samples](const Drawing& d) {
    GlWorkload gl{.mesh = d.meshes.front(),
                  .shaders = rivals::window_shaders(rivals::Varying::colors),
                  .samples = samples,
                  .tests_depth = true};
    gl.mesh.texcoords.clear();
    return gl;
  };
  if (grid.has_vertex_stage) drawing.gl_workload = nullptr;
  drawing.fault = [](const Picture& picture) {
    // Red and blue add up to 1 at every vertex, and so in every pixel.
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      if (const int sum = picture.rgba[i] + picture.rgba[i + 2]; sum < 254 || sum > 256)
        return std::string("a pixel is not covered, or does not have a colour of the grid");
    return std::string();
  };
  return drawing;
}

WorkloadEntry grid_entry(const std::string& name, int side, const std::string& pixels) {
  return drawn("grid-" + name, name + " triangles of " + pixels + ", colours interpolated, depth",
               [side](int width, int height, std::uint32_t) { return grid(width, height, {.side = side}); });
}

}  // namespace

WorkloadEntry grid_of(int side) {
  return drawn_outside_mean(
      "grid-" + std::to_string(2 * side * side), "",
      [side](int width, int height, std::uint32_t) { return grid(width, height, {.side = side}); });
}

WorkloadEntry grid_with_stage() {
  WorkloadEntry entry = drawn_outside_mean(
      "stage-grid-2M", "grid-2M with a vertex stage that passes clip positions through",
      [](int w, int h, std::uint32_t) { return grid(w, h, {.side = 1000, .has_vertex_stage = true}); });
  entry.baseline = "grid-2M";
  return entry;
}

std::vector<WorkloadEntry> grid_workloads() {
  return {grid_entry("2M", 1000, "1 pixel"),
          grid_entry("500k", 500, "4 pixels"),
          grid_entry("80k", 200, "26 pixels"),
          grid_entry("20k", 100, "104 pixels"),
          drawn_outside_mean("grid-20M", "20 M triangles of 0.1 pixels, colours interpolated, depth",
                             [](int w, int h, std::uint32_t) { return grid(w, h, {.side = 3162}); }),
          drawn_outside_mean(
              "samples-4", "80k triangles of 26 pixels, 4 samples per pixel",
              [](int w, int h, std::uint32_t) { return grid(w, h, {.side = 200, .samples = 4}); })};
}

}  // namespace tessera::bench
