#include "primitive_limits.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "tests/reference/primitives.h"

namespace tessera::mesa {
namespace {

using reference::Draw;
using reference::Mesh;
using reference::PolygonMode;
using reference::PrimitiveType;
using reference::ProvokingVertex;
using reference::StencilFace;
using reference::Vec4;

using Reason = std::optional<std::string>;

constexpr double kLargestSize = 255;  // of Mesa's points and lines

bool is_quads(PrimitiveType type) { return type == PrimitiveType::kQuads || type == PrimitiveType::kQuadStrip; }

bool has_one_mode(const Draw& draw, PolygonMode mode) { return draw.polygon_mode[0] == mode && draw.polygon_mode[1] == mode; }

bool has_mode(const Draw& draw, PolygonMode mode) { return draw.polygon_mode[0] == mode || draw.polygon_mode[1] == mode; }

bool is_same(const StencilFace& a, const StencilFace& b) {
  const auto fields = [](const StencilFace& f) { return std::tie(f.func, f.ref, f.mask, f.fail, f.zfail, f.zpass, f.write_mask); };
  return fields(a) == fields(b);
}

bool stencils_each_side(const Draw& draw) { return draw.stencil && !is_same(draw.stencil->front, draw.stencil->back); }

/// The corners of a point, line or polygon in clip space.
using Corners = std::vector<Vec4>;

std::vector<Corners> primitives_in_clip_space(const Draw& draw, const Mesh& mesh, const reference::Camera& camera) {
  const reference::Mat4 eye_from_object = reference::multiply(camera.view_from_world, draw.world_from_object);
  std::vector<Corners> primitives;
  for (std::size_t i = 0; i < reference::primitive_count(mesh); ++i) {
    Corners corners;
    for (const std::uint32_t vertex : reference::primitive(mesh, i, ProvokingVertex::kLast).vertices)
      corners.push_back(reference::transform(camera.clip_from_view, reference::transform(eye_from_object, mesh.positions[vertex])));
    primitives.push_back(corners);
  }
  return primitives;
}

/// Whether a plane, where `inside` is 0, has corners on both sides.
template <class Inside>
bool cuts(const Corners& corners, const Inside& inside) {
  return std::ranges::any_of(corners, [&](Vec4 p) { return inside(p) < 0; }) &&
         std::ranges::any_of(corners, [&](Vec4 p) { return inside(p) > 0; });
}

bool is_cut_in_depth(const Corners& corners, const reference::Camera& camera) {
  if (camera.reversed) return cuts(corners, [](Vec4 p) { return p.w - p.z; }) || cuts(corners, [](Vec4 p) { return p.z; });
  return cuts(corners, [](Vec4 p) { return p.w + p.z; }) || cuts(corners, [](Vec4 p) { return p.w - p.z; });
}

bool is_cut_by_sides(const Corners& corners) {
  return cuts(corners, [](Vec4 p) { return p.w - p.x; }) || cuts(corners, [](Vec4 p) { return p.w + p.x; }) ||
         cuts(corners, [](Vec4 p) { return p.w - p.y; }) || cuts(corners, [](Vec4 p) { return p.w + p.y; });
}

// The determinant of x, y and w of a triangle has the sign of its visible part's area.
double facing(Vec4 a, Vec4 b, Vec4 c) {
  return a.x * (b.y * c.w - c.y * b.w) - a.y * (b.x * c.w - c.x * b.w) + a.w * (b.x * c.y - c.x * b.y);
}

bool faces_both_ways(const Corners& polygon) {
  bool front = false, back = false;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double sign = facing(polygon[0], polygon[i - 1], polygon[i]);
    front = front || sign > 0;
    back = back || sign < 0;
  }
  return front && back;
}

bool sides_matter(const Draw& draw, bool two_sided_lighting) {
  return draw.cull != reference::Cull::kNone || (draw.lighting && two_sided_lighting) || draw.polygon_mode[0] != draw.polygon_mode[1] ||
         stencils_each_side(draw);
}

Reason line_limit(const Corners& line, const Draw& draw, const reference::Camera& camera) {
  if (draw.shading == reference::Shading::kFlat && is_cut_in_depth(line, camera))
    return "a flat line cut by the near or far plane: Mesa takes its other end's colour";
  return std::nullopt;
}

Reason polygon_limit(const Corners& polygon, const Draw& draw, bool two_sided_lighting, const reference::Camera& camera) {
  if (!has_one_mode(draw, PolygonMode::kFill) && is_cut_in_depth(polygon, camera))
    return "lines or points of a polygon that is cut: Mesa leaves out what the cut adds";
  if (has_mode(draw, PolygonMode::kPoint) && is_cut_by_sides(polygon))
    return "points of a polygon that is cut: Mesa adds points where it leaves the picture";
  if (sides_matter(draw, two_sided_lighting) && faces_both_ways(polygon))
    return "a polygon whose parts face both ways: Mesa decides for each";
  return std::nullopt;
}

}  // namespace

Reason primitive_limit(const Draw& draw, const reference::Scene& scene, const reference::Camera& camera) {
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  if (is_quads(mesh.primitive) && draw.provoking_vertex == ProvokingVertex::kFirst)
    return "Mesa's quads keep to the last vertex under the first one's convention, and split along the other diagonal";
  if (std::max(draw.point_size, draw.line_width) > kLargestSize) return "a point or line of more pixels than Mesa's";
  if (stencils_each_side(draw) && !has_one_mode(draw, PolygonMode::kFill))
    return "a stencil for each side: to Mesa lines and points of polygons are front";
  for (const Corners& corners : primitives_in_clip_space(draw, mesh, camera)) {
    Reason reason;
    if (corners.size() == 2) reason = line_limit(corners, draw, camera);
    if (corners.size() > 2) reason = polygon_limit(corners, draw, scene.light_model.two_sided, camera);
    if (reason) return reason;
  }
  return std::nullopt;
}

}  // namespace tessera::mesa
