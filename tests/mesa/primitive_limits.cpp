#include "primitive_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "program_texturing.h"
#include "textures.h"
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

using TexCoord = std::array<double, 2>;

/// A line's end in clip space, and what texture it has there.
struct TexturedEnd {
  Vec4 at;
  TexCoord texcoord;
};

TexturedEnd mix(const TexturedEnd& a, const TexturedEnd& b, double t) {
  return {(1 - t) * a.at + t * b.at, {(1 - t) * a.texcoord[0] + t * b.texcoord[0], (1 - t) * a.texcoord[1] + t * b.texcoord[1]}};
}

/// A textured line, of a mesh or of a polygon's boundary.
class TexturedLine {
 public:
  TexturedLine(TexturedEnd a, TexturedEnd b, const reference::Rect& viewport) {
    constexpr double kInFront = 1.0 / 64;  // what is behind the eye is not there
    if (std::max(a.at.w, b.at.w) <= 0) return;
    if (a.at.w < kInFront * b.at.w) a = mix(b, a, (1 - kInFront) * b.at.w / (b.at.w - a.at.w));
    if (b.at.w < kInFront * a.at.w) b = mix(a, b, (1 - kInFront) * a.at.w / (a.at.w - b.at.w));
    const double dx = 0.5 * viewport.width * (b.at.x / b.at.w - a.at.x / a.at.w), dy = 0.5 * viewport.height * (b.at.y / b.at.w - a.at.y / a.at.w);
    const double major = std::max(std::abs(dx), std::abs(dy));
    if (major == 0) return;
    slant_ = std::min(std::abs(dx), std::abs(dy)) / major;
    for (std::size_t i = 0; i < 2; ++i) slope_[i] = std::abs(b.texcoord[i] - a.texcoord[i]) / major * std::max(a.at.w / b.at.w, b.at.w / a.at.w);
  }

  // Mesa takes what it interpolates from where the line passes the middle of the pixel's column, or row of a steep one; equation 3.5 from the
  // foot of the pixel's centre. A step along the line is longer than the one from column to column, too.
  bool is_beyond_mesa(const reference::Texture& texture, double width_px) const {
    constexpr double kLevelApart = 1.0 / 128, kLinearApart = 1.0 / 128, kNearestApart = 1.0 / 16;  // texels: a level or two; a pixel of 16
    if (asks_for_level(texture) && 0.5 * std::log2(1 + slant_ * slant_) > kLevelApart) return true;
    const double texels_px = std::max(slope_[0] * texture.image.width, is_row(texture) ? 0.0 : slope_[1] * texture.image.height);
    const bool is_nearest = texture.mag == reference::MagFilter::kNearest && texture.min == reference::MinFilter::kNearest;
    return 0.5 * std::max(1.0, width_px) * slant_ * texels_px > (is_nearest ? kNearestApart : kLinearApart);
  }

 private:
  double slant_ = 0;       // of the minor axis to the major one
  TexCoord slope_{0, 0};   // the largest along it, for each pixel
};

// Cut quads are split along the diagonal from the second to the fourth vertex; that shows unless the halves continue each other.
bool halves_differ(const Mesh& mesh, const std::vector<std::uint32_t>& quad) {
  const auto rest = [&](const auto& of) { return std::abs(of(quad[0]) - of(quad[1]) + of(quad[2]) - of(quad[3])) > 1e-6; };
  const auto& p = mesh.positions;
  return rest([&](std::uint32_t v) { return p[v].x; }) || rest([&](std::uint32_t v) { return p[v].y; }) || rest([&](std::uint32_t v) { return p[v].z; }) ||
         rest([&](std::uint32_t v) { return p[v].w; }) || rest([&](std::uint32_t v) { return mesh.texcoords[v][0]; }) ||
         rest([&](std::uint32_t v) { return mesh.texcoords[v][1]; });
}

Reason textured_limit(const Corners& corners, const std::vector<std::uint32_t>& vertices, const Draw& draw, const Mesh& mesh,
                      const reference::Scene& scene, const reference::Camera& camera) {
  if (!draw.texture || mesh.texcoords.empty() || corners.size() < 2) return std::nullopt;
  const reference::Rect viewport = draw.viewport.value_or(reference::Rect{0, 0, scene.framebuffer.width_px, scene.framebuffer.height_px});
  const bool is_line = corners.size() == 2;
  if (is_line || has_mode(draw, PolygonMode::kLine))
    for (std::size_t i = 0, j = 1; i < (is_line ? 1 : corners.size()); ++i, j = (i + 1) % corners.size())
      if (TexturedLine({corners[i], mesh.texcoords[vertices[i]]}, {corners[j], mesh.texcoords[vertices[j]]}, viewport)
              .is_beyond_mesa(scene.textures.at(*draw.texture), draw.line_width))
        return "a textured line that leans: Mesa interpolates along its major axis alone";
  if (mesh.primitive == PrimitiveType::kQuads && has_mode(draw, PolygonMode::kFill) && (is_cut_in_depth(corners, camera) || is_cut_by_sides(corners)) &&
      halves_differ(mesh, vertices))
    return "a textured quad that is cut: Mesa splits it along its other diagonal";
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
  const std::vector<Corners> primitives = primitives_in_clip_space(draw, mesh, camera);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const Corners& corners = primitives[i];
    Reason reason = textured_limit(corners, reference::primitive(mesh, i, ProvokingVertex::kLast).vertices, draw, mesh, scene, camera);
    if (reason) return reason;
    if (corners.size() == 2) reason = line_limit(corners, draw, camera);
    if (corners.size() > 2) reason = polygon_limit(corners, draw, scene.light_model.two_sided, camera);
    if (reason) return reason;
  }
  return std::nullopt;
}

}  // namespace tessera::mesa
