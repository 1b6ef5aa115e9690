#include "rasterize_mesh.h"

#include "clip.h"
#include "polygon_offset.h"
#include "rasterize_line.h"
#include "rasterize_point.h"
#include "rasterize_polygon.h"

namespace tessera::reference {
namespace {

bool is_finite(const Corners& corners) {
  for (const Corner& corner : corners.all) {
    const Vec4 p = corner.position_clip;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w))
      return false;
  }
  return true;
}

std::vector<ClipVertex> clip_vertices(const Corners& corners) {
  std::vector<ClipVertex> vertices;
  for (std::size_t i = 0; i < corners.all.size(); ++i)
    vertices.push_back(corner_vertex(corners.all[i].position_clip, i, corners.all.size()));
  return vertices;
}

Rect whole_window(const FrameBufferFormat& format) { return {0, 0, format.width_px, format.height_px}; }

class MeshRasterizer {
 public:
  MeshRasterizer(const Draw& draw, const Camera& camera, const FrameBufferFormat& format,
                 const Rect& viewport, const PrimitiveCallback& start, Point sample_shift)
      : draw_(draw),
        depth_format_(format.depth),
        start_(start),
        volume_(clip_volume(camera, viewport)),
        window_{viewport,
                intersection(intersection(viewport, whole_window(format)),
                             draw.scissor.value_or(whole_window(format))),
                draw.depth_range,
                camera.reversed,
                format.samples,
                draw.texture.has_value(),
                sample_shift} {}

  void draw_primitive(const Corners& corners, std::size_t number) {
    if (!is_finite(corners)) return;
    switch (corners.all.size()) {
      case 1: return draw_point(corners, number);
      case 2: return draw_line(corners, number);
      default: return draw_polygon(corners, number);
    }
  }

 private:
  void draw_point(const Corners& corners, std::size_t number) {
    const ClipVertex vertex = clip_vertices(corners)[0];
    if (!is_in_view(vertex.position, volume_)) return;
    rasterize_point(window_vertex(vertex, window_), draw_.point_size, kNoOffset, window_,
                    start_({corners, number}));
  }

  void draw_line(const Corners& corners, std::size_t number) {
    const std::vector<ClipVertex> vertices = clip_vertices(corners);
    const std::vector<ClipVertex> line = clip_line(vertices[0], vertices[1], volume_);
    if (line.empty()) return;
    rasterize_line(window_vertex(line[0], window_), window_vertex(line[1], window_), draw_.line_width,
                   kNoOffset, window_, start_({corners, number}));
  }

  // Facing, culling and offset are determined by the whole polygon, however it is split.
  void draw_polygon(const Corners& corners, std::size_t number) {
    const std::vector<ClipVertex> vertices = clip_vertices(corners);
    std::vector<WindowPolygon> triangles;
    std::int64_t area = 0;
    for (std::size_t i = 2; i < vertices.size(); ++i) {
      triangles.emplace_back(clip_polygon({vertices[0], vertices[i - 1], vertices[i]}, volume_), window_);
      area += triangles.back().signed_area();
    }
    // Without area a polygon is back-facing [GL 2.1, 3.5.1], but lit as a front.
    const bool is_front = draw_.front_face == FrontFace::kCcw ? area > 0 : area < 0;
    const bool is_back = !is_front && area != 0;
    if (draw_.cull == (is_front ? Cull::kFront : Cull::kBack)) return;
    const FragmentCallback take = start_({corners, number, is_back});
    const double offset = depth_offset(draw_.polygon_offset, triangles, depth_format_);
    switch (draw_.polygon_mode[is_front ? 0 : 1]) {
      case PolygonMode::kFill:
        for (const WindowPolygon& triangle : triangles) triangle.for_each_fragment(offset, take);
        break;
      case PolygonMode::kLine: draw_outline(clip_polygon(vertices, volume_), offset, take); break;
      case PolygonMode::kPoint: draw_corners(clip_polygon(vertices, volume_), offset, take); break;
    }
  }

  // Edges created by clipping belong to the boundary [GL 2.1, 2.12]; those along the guard band are never
  // visible.
  void draw_outline(const std::vector<ClipVertex>& polygon, double offset,
                    const FragmentCallback& take) const {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      rasterize_line(window_vertex(polygon[i], window_),
                     window_vertex(polygon[(i + 1) % polygon.size()], window_), draw_.line_width, offset,
                     window_, take);
  }

  void draw_corners(const std::vector<ClipVertex>& polygon, double offset,
                    const FragmentCallback& take) const {
    for (const ClipVertex& vertex : polygon)
      if (is_between_sides(vertex.position))
        rasterize_point(window_vertex(vertex, window_), draw_.point_size, offset, window_, take);
  }

  // Points and lines are front-facing and have no slope.
  static constexpr double kNoOffset = 0;

  const Draw& draw_;
  DepthFormat depth_format_;
  const PrimitiveCallback& start_;
  ClipVolume volume_;
  Window window_;
};

}  // namespace

void rasterize_mesh(const Mesh& mesh, const Draw& draw, const Camera& camera, const FrameBufferFormat& format,
                    const PrimitiveCallback& start, Point sample_shift) {
  const Rect viewport = draw.viewport.value_or(whole_window(format));
  if (viewport.width == 0 || viewport.height == 0) return;
  const VertexStage vertices(mesh, draw, camera);
  MeshRasterizer rasterizer(draw, camera, format, viewport, start, sample_shift);
  for (std::size_t i = 0; i < vertices.primitive_count(); ++i)
    rasterizer.draw_primitive(vertices.corners(i), i);
}

}  // namespace tessera::reference
