#include "cut_quads.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::mesa {
namespace {

using reference::PrimitiveType;
using reference::Vec4;

bool is_filled(const reference::Draw& draw) {
  return std::ranges::all_of(
      draw.polygon_mode, [](reference::PolygonMode mode) { return mode == reference::PolygonMode::kFill; });
}

bool is_outside(Vec4 clip, bool reversed) {
  return std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w || clip.z > clip.w ||
         clip.z < (reversed ? 0 : -clip.w);
}

}  // namespace

PrimitiveType split_cut_quads(const reference::Mesh& mesh, const reference::Draw& draw,
                              const reference::Camera& camera, std::vector<Vertex>& vertices) {
  const bool is_strip = mesh.primitive == PrimitiveType::kQuadStrip;
  const bool has_quads = is_strip || mesh.primitive == PrimitiveType::kQuads;
  if (!has_quads || draw.shading == reference::Shading::kFlat || !is_filled(draw)) return mesh.primitive;
  const reference::Mat4 eye_from_object = reference::multiply(camera.view_from_world, draw.world_from_object);
  const auto may_be_cut = [&](const Vertex& v) {
    const auto [x, y, z, w] = v.position;
    return is_outside(
        reference::transform(camera.clip_from_view, reference::transform(eye_from_object, Vec4{x, y, z, w})),
        camera.reversed);
  };
  if (std::ranges::none_of(vertices, may_be_cut)) return mesh.primitive;

  std::vector<Vertex> triangles;
  const std::array<std::size_t, 6> corners =
      is_strip ? std::array<std::size_t, 6>{0, 1, 3, 0, 3, 2} : std::array<std::size_t, 6>{0, 1, 2, 0, 2, 3};
  for (std::size_t first = 0; first + 3 < vertices.size(); first += is_strip ? 2 : 4)
    for (const std::size_t corner : corners) triangles.push_back(vertices[first + corner]);
  vertices = triangles;
  return PrimitiveType::kTriangles;
}

}  // namespace tessera::mesa
