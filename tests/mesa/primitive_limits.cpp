#include "primitive_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "primitives.h"
#include "program_texturing.h"
#include "shadow.h"
#include "tests/reference/compare.h"
#include "tests/reference/primitives.h"
#include "textures.h"

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

constexpr double kLargestSize = 255;  // largest point and line of Mesa

bool is_quads(PrimitiveType type) {
  return type == PrimitiveType::kQuads || type == PrimitiveType::kQuadStrip;
}

bool has_one_mode(const Draw& draw, PolygonMode mode) {
  return draw.polygon_mode[0] == mode && draw.polygon_mode[1] == mode;
}

bool has_mode(const Draw& draw, PolygonMode mode) {
  return draw.polygon_mode[0] == mode || draw.polygon_mode[1] == mode;
}

bool is_same(const StencilFace& a, const StencilFace& b) {
  const auto fields = [](const StencilFace& f) {
    return std::tie(f.func, f.ref, f.mask, f.fail, f.zfail, f.zpass, f.write_mask);
  };
  return fields(a) == fields(b);
}

bool stencils_each_side(const Draw& draw) {
  return draw.stencil && !is_same(draw.stencil->front, draw.stencil->back);
}

using Vertices = std::vector<std::uint32_t>;

/// The corners of a point, line or polygon in clip space.
using Corners = std::vector<Vec4>;

Corners in_clip_space(const Vertices& vertices, const Draw& draw, const Mesh& mesh,
                      const reference::Camera& camera) {
  const reference::Mat4 eye_from_object = reference::multiply(camera.view_from_world, draw.world_from_object);
  Corners corners;
  for (const std::uint32_t vertex : vertices)
    corners.push_back(reference::transform(camera.clip_from_view,
                                           reference::transform(eye_from_object, mesh.positions[vertex])));
  return corners;
}

/// Whether the plane inside(p) = 0 has corners on both sides.
template <class Inside>
bool cuts(const Corners& corners, const Inside& inside) {
  return std::ranges::any_of(corners, [&](Vec4 p) { return inside(p) < 0; }) &&
         std::ranges::any_of(corners, [&](Vec4 p) { return inside(p) > 0; });
}

bool is_cut_in_depth(const Corners& corners, const reference::Camera& camera) {
  if (camera.reversed)
    return cuts(corners, [](Vec4 p) { return p.w - p.z; }) || cuts(corners, [](Vec4 p) { return p.z; });
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
  const bool sides_are_lit_apart = draw.lighting && two_sided_lighting;
  const bool modes_differ = draw.polygon_mode[0] != draw.polygon_mode[1];
  return draw.cull != reference::Cull::kNone || sides_are_lit_apart || modes_differ ||
         stencils_each_side(draw);
}

Reason line_limit(const Corners& line, const Draw& draw, const reference::Camera& camera) {
  if (draw.shading == reference::Shading::kFlat && is_cut_in_depth(line, camera))
    return "a flat line cut by the near or far plane: Mesa takes its other end's colour";
  return std::nullopt;
}

// Offset along the line between the edge pixels of a wide line's column (or row) and the line's centre, as a
// fraction of the line's length.
double lean(Vec4 a, Vec4 b, double width_px, const reference::Rect& viewport) {
  // The visible part may be arbitrarily short.
  if (!(a.w > 0 && b.w > 0)) return std::numeric_limits<double>::infinity();
  const double dx = std::abs(b.x / b.w - a.x / a.w) * viewport.width / 2;
  const double dy = std::abs(b.y / b.w - a.y / a.w) * viewport.height / 2;
  return std::min(dx, dy) == 0 ? 0 : width_px / 2 * std::min(dx, dy) / (dx * dx + dy * dy);
}

// Change of colour between the ends of a line, in levels; the maximum under lighting. Textures have a
// separate limit.
double color_change(std::uint32_t a, std::uint32_t b, const Draw& draw, const Mesh& mesh) {
  if (draw.shading == reference::Shading::kFlat) return 0;
  if (draw.lighting) return 255;
  if (!has_vertex_colors(draw, mesh)) return 0;
  const Vec4 p = mesh.colors[a];
  const Vec4 q = mesh.colors[b];
  return 255 * std::max({std::abs(q.x - p.x), std::abs(q.y - p.y), std::abs(q.z - p.z), std::abs(q.w - p.w)});
}

Reason wide_line_limit(const Vertices& vertices, const Corners& corners, const Draw& draw, const Mesh& mesh,
                       const reference::Rect& viewport) {
  if (draw.line_width < 1.5) return std::nullopt;  // rounded to 1 pixel
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const double change = color_change(vertices[i], vertices[next], draw, mesh);
    if (change > 0 &&
        change * lean(corners[i], corners[next], draw.line_width, viewport) > reference::kTolerance)
      return "a wide line that slants and changes its colour: Mesa has one for each column or row, not for "
             "each pixel's projection";
  }
  return std::nullopt;
}

// Whether the fourth value continues the other three linearly, so that the diagonal of the split is
// invisible.
bool is_even(const Vertices& quad, const std::vector<Vec4>& values) {
  const Vec4 rest = values[quad[0]] + values[quad[2]] - (values[quad[1]] + values[quad[3]]);
  return std::max({std::abs(rest.x), std::abs(rest.y), std::abs(rest.z), std::abs(rest.w)}) < 1e-9;
}

bool split_shows(const Vertices& quad, const Draw& draw, const Mesh& mesh) {
  if (draw.texture || !is_even(quad, mesh.positions)) return true;
  if (draw.shading == reference::Shading::kFlat) return false;
  return draw.lighting || (has_vertex_colors(draw, mesh) && !is_even(quad, mesh.colors));
}

Reason polygon_limit(const Corners& polygon, const Draw& draw, bool two_sided_lighting,
                     const reference::Camera& camera) {
  if (!has_one_mode(draw, PolygonMode::kFill) && is_cut_in_depth(polygon, camera))
    return "lines or points of a polygon that is cut: Mesa leaves out what the cut adds";
  if (has_mode(draw, PolygonMode::kPoint) && is_cut_by_sides(polygon))
    return "points of a polygon that is cut: Mesa adds points where it leaves the picture";
  if (sides_matter(draw, two_sided_lighting) && faces_both_ways(polygon))
    return "a polygon whose parts face both ways: Mesa decides for each";
  return std::nullopt;
}

using TexCoord = std::array<double, 2>;

/// An end of a line in clip space, with its texture coordinate.
struct TexturedEnd {
  Vec4 at;
  TexCoord texcoord;
};

TexturedEnd mix(const TexturedEnd& a, const TexturedEnd& b, double t) {
  return {(1 - t) * a.at + t * b.at,
          {(1 - t) * a.texcoord[0] + t * b.texcoord[0], (1 - t) * a.texcoord[1] + t * b.texcoord[1]}};
}

/// A textured line: a line of a mesh, or an edge of a polygon's boundary.
class TexturedLine {
 public:
  TexturedLine(TexturedEnd a, TexturedEnd b, const reference::Rect& viewport) {
    constexpr double kInFront = 1.0 / 64;  // clips at a small fraction of the farther w
    if (std::max(a.at.w, b.at.w) <= 0) return;
    if (a.at.w < kInFront * b.at.w) a = mix(b, a, (1 - kInFront) * b.at.w / (b.at.w - a.at.w));
    if (b.at.w < kInFront * a.at.w) b = mix(a, b, (1 - kInFront) * a.at.w / (a.at.w - b.at.w));
    const double dx = 0.5 * viewport.width * (b.at.x / b.at.w - a.at.x / a.at.w);
    const double dy = 0.5 * viewport.height * (b.at.y / b.at.w - a.at.y / a.at.w);
    const double major = std::max(std::abs(dx), std::abs(dy));
    if (major == 0) return;
    slant_ = std::min(std::abs(dx), std::abs(dy)) / major;
    for (std::size_t i = 0; i < 2; ++i)
      slope_[i] =
          std::abs(b.texcoord[i] - a.texcoord[i]) / major * std::max(a.at.w / b.at.w, b.at.w / a.at.w);
  }

  // Mesa interpolates where the line passes the middle of the pixel's column (row for steep lines). Equation
  // 3.5 uses the projection of the pixel's centre onto the line. A step along the line is also longer than
  // one from column to column.
  bool is_beyond_mesa(const reference::Texture& texture, double width_px) const {
    // In texels: one or two levels; a pixel in 16.
    constexpr double kLevelApart = 1.0 / 128;
    constexpr double kLinearApart = 1.0 / 128;
    constexpr double kNearestApart = 1.0 / 16;
    if (asks_for_level(texture) && 0.5 * std::log2(1 + slant_ * slant_) > kLevelApart) return true;
    const double texels_px =
        std::max(slope_[0] * texture.image.width, is_row(texture) ? 0.0 : slope_[1] * texture.image.height);
    const bool is_nearest =
        texture.mag == reference::MagFilter::kNearest && texture.min == reference::MinFilter::kNearest;
    return 0.5 * std::max(1.0, width_px) * slant_ * texels_px > (is_nearest ? kNearestApart : kLinearApart);
  }

 private:
  double slant_ = 0;      // minor over major axis
  TexCoord slope_{0, 0};  // largest derivative along the line, per pixel
};

// Clipped quads are split from the second to the fourth vertex. That is visible unless the values of the quad
// are linear.
bool cut_shows(const Vertices& quad, const Mesh& mesh) {
  const auto rest = [&](std::size_t i) {
    return mesh.texcoords[quad[0]][i] - mesh.texcoords[quad[1]][i] + mesh.texcoords[quad[2]][i] -
           mesh.texcoords[quad[3]][i];
  };
  return !is_even(quad, mesh.positions) || std::abs(rest(0)) > 1e-6 || std::abs(rest(1)) > 1e-6;
}

Reason textured_limit(const Vertices& vertices, const Corners& corners, const Draw& draw, const Mesh& mesh,
                      const reference::Scene& scene, const reference::Camera& camera) {
  if (!draw.texture || mesh.texcoords.empty() || corners.size() < 2) return std::nullopt;
  const reference::Rect viewport = viewport_of(draw, scene.framebuffer);
  const bool is_line = corners.size() == 2;
  if (is_line || has_mode(draw, PolygonMode::kLine))
    for (std::size_t i = 0, j = 1; i < (is_line ? 1 : corners.size()); ++i, j = (i + 1) % corners.size())
      if (TexturedLine({corners[i], mesh.texcoords[vertices[i]]}, {corners[j], mesh.texcoords[vertices[j]]},
                       viewport)
              .is_beyond_mesa(scene.textures.at(*draw.texture), draw.line_width))
        return "a textured line that leans: Mesa interpolates along its major axis alone";
  const bool is_filled_quad = mesh.primitive == PrimitiveType::kQuads && has_mode(draw, PolygonMode::kFill);
  const auto is_cut = [&] { return is_cut_in_depth(corners, camera) || is_cut_by_sides(corners); };
  if (is_filled_quad && is_cut() && cut_shows(vertices, mesh))
    return "a textured quad that is cut: Mesa splits it along its other diagonal";
  return std::nullopt;
}

}  // namespace

Reason primitive_limit(const Draw& draw, const reference::Scene& scene, const reference::Camera& camera) {
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  if (is_quads(mesh.primitive) && draw.provoking_vertex == ProvokingVertex::kFirst)
    return "Mesa's quads keep to the last vertex under the first one's convention, and split along the other "
           "diagonal";
  if (std::max(draw.point_size, draw.line_width) > kLargestSize)
    return "a point or line of more pixels than Mesa's";
  if (stencils_each_side(draw) && !has_one_mode(draw, PolygonMode::kFill))
    return "a stencil for each side: to Mesa lines and points of polygons are front";
  const reference::Rect viewport = viewport_of(draw, scene.framebuffer);
  const bool fills_one_side = draw.cull == reference::Cull::kNone && has_mode(draw, PolygonMode::kFill) &&
                              !has_one_mode(draw, PolygonMode::kFill);
  for (std::size_t i = 0; i < reference::primitive_count(mesh); ++i) {
    const Vertices vertices = reference::primitive(mesh, i, ProvokingVertex::kLast).vertices;
    const Corners corners = in_clip_space(vertices, draw, mesh, camera);
    if (const Reason textured = textured_limit(vertices, corners, draw, mesh, scene, camera)) return textured;
    Reason reason;
    if (corners.size() == 2) reason = line_limit(corners, draw, camera);
    if (corners.size() > 2) reason = polygon_limit(corners, draw, scene.light_model.two_sided, camera);
    if (reason) return reason;
    if (mesh.primitive == PrimitiveType::kQuads && fills_one_side && split_shows(vertices, draw, mesh))
      return "quads that are filled on one side alone: Mesa splits them along the other diagonal";
    if (corners.size() == 2 || (corners.size() > 2 && has_mode(draw, PolygonMode::kLine)))
      if (const Reason wide = wide_line_limit(vertices, corners, draw, mesh, viewport)) return wide;
  }
  return std::nullopt;
}

}  // namespace tessera::mesa
