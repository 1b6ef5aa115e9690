// Many small objects, each a draw with its own material and matrix.
#include <cmath>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
namespace {

constexpr float kAmbient = 0.2f;

struct Object {
  Matrix world_from_object{};
  Color color{};
};

const Matrix& projection() {
  static const Matrix kProjection = orthographic(-1, 1, -1, 1, -1, 1);
  return kProjection;
}

/// Objects of radius 1 in rows over the window, -1 to 1. z = 1 is near.
std::vector<Object> objects_in_rows(int count) {
  const int columns = static_cast<int>(std::lround(std::sqrt(1.6 * count)));
  const int rows = (count + columns - 1) / columns;
  std::vector<Object> objects;
  for (int k = 0; k < count; ++k)
    objects.push_back(
        {.world_from_object =
             translate(2.0 * (k % columns + 0.5) / columns - 1, 2.0 * (k / columns + 0.5) / rows - 1, 0) *
             scale(1.0 / columns, 1.0 / columns, 1.0 / columns),
         .color = {static_cast<float>(k % 10 + 1) / 12, static_cast<float>(k / 10 % 10 + 1) / 12,
                   static_cast<float>(k / 100 % 10 + 1) / 12, 1}});
  return objects;
}

/// Checks that every object is in the picture: the pixel at its centre has its colour, lit from the front.
std::string objects_fault(const Picture& picture, const std::vector<Object>& objects) {
  const double radius_px = objects.front().world_from_object.m[0] / 2 * picture.width;
  if (radius_px < 3) return {};                        // too small to have a pixel at its middle
  const double tolerance = 3 + 1.5 * 255 / radius_px;  // levels: colours fall to the outline
  for (const Object& object : objects) {
    const auto& m = object.world_from_object.m;
    const auto x = static_cast<int>((m[3] + 1) / 2 * picture.width);
    const auto y = static_cast<int>((1 - m[7]) / 2 * picture.height);
    const std::uint8_t* const pixel = &picture.rgba[static_cast<std::size_t>(4 * (y * picture.width + x))];
    const float expected[] = {object.color.r, object.color.g, object.color.b};
    for (int c = 0; c < 3; ++c)
      if (std::abs(pixel[c] - 255 * std::min((1 + kAmbient) * expected[c], 1.0f)) > tolerance)
        return "pixel " + std::to_string(x) + " of row " + std::to_string(y) +
               " does not have the colour of its object";
  }
  return {};
}

Drawing many_objects(int width, int height, int count) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  drawing.meshes.push_back(sphere(4, 4, 1));
  const std::vector<Object> objects = objects_in_rows(count);
  drawing.record = [objects](const Drawing& d, Frame& frame) {
    Light light;
    light.position = {0, 0, 1, 0};
    frame.set_camera({.projection = projection()});
    frame.set_lights({light});
    frame.set_light_model({.ambient = {kAmbient, kAmbient, kAmbient, 1}});
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.normalize = true;
    state.cull = Cull::back;
    const Mesh mesh = d.meshes.front().view();
    for (const Object& object : objects) {
      state.material.ambient = state.material.diffuse = object.color;
      state.transform = object.world_from_object;
      frame.draw(mesh, state);
    }
  };
  drawing.gl_workload = [objects](const Drawing& d) {
    GlWorkload gl{.mesh = d.meshes.front(),
                  .shaders = rivals::object_shaders(kAmbient),
                  .tests_depth = true,
                  .culls_back = true,
                  .max_mismatch_share = 0.01};
    for (const Object& object : objects)
      gl.draws.push_back({projection() * object.world_from_object, object.color});
    return gl;
  };
  drawing.fault = [objects](const Picture& picture) { return objects_fault(picture, objects); };
  return drawing;
}

}  // namespace

std::vector<WorkloadEntry> object_workloads() {
  std::vector<WorkloadEntry> list;
  for (const int count : {1000, 10000})
    list.push_back(drawn_outside_mean(
        "objects-" + std::to_string(count),
        std::to_string(count) + " draws of 32 triangles, each with a material and a matrix, lit per vertex",
        [count](int width, int height, std::uint32_t) { return many_objects(width, height, count); }));
  return list;
}

}  // namespace tessera::bench
