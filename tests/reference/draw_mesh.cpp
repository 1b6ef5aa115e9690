#include "draw_mesh.h"

#include "clip.h"
#include "fragment_pipeline.h"
#include "planar_shadow.h"
#include "polygon_offset.h"
#include "primitive_shader.h"
#include "rasterize_line.h"
#include "rasterize_point.h"
#include "rasterize_polygon.h"
#include "vertex_stage.h"

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

std::optional<TextureSampler> sampler(const Draw& draw, const Scene& scene) {
  if (!draw.texture) return std::nullopt;
  return TextureSampler(scene.textures.at(*draw.texture));
}

// The draw of the shadow: one colour, projected after the object's transform.
Draw shadow_of(const Draw& draw, const std::vector<Light>& lights) {
  Draw shadow = draw;
  const Mat4 projection = shadow_matrix(draw.shadow_on->plane, lights.at(draw.shadow_on->light)).value();
  shadow.world_from_object = multiply(projection, draw.world_from_object);
  shadow.lighting = false;
  shadow.texture = std::nullopt;
  shadow.material.diffuse = draw.shadow_on->color;
  return shadow;
}

class MeshDrawing {
 public:
  MeshDrawing(const Draw& draw, const FrameState& state, const Rect& viewport, SampleBuffers& buffers)
      : draw_(draw),
        command_(state.command),
        buffers_(buffers),
        volume_(clip_volume(state.camera, viewport)),
        texture_(sampler(draw, state.scene)),
        window_{viewport,
                intersection(intersection(viewport, buffers.rect()), draw.scissor.value_or(buffers.rect())),
                draw.depth_range,
                state.camera.reversed,
                buffers.format().samples,
                draw.texture.has_value()},
        colors_{draw,
                state.scene.light_model,
                lights_in_eye_space(state.lights, state.camera.view_from_world),
                buffers.format(),
                texture_ ? &*texture_ : nullptr,
                !draw.shadow_on && !state.scene.meshes.at(draw.mesh).colors.empty(),
                !draw.shadow_on && !state.scene.meshes.at(draw.mesh).color_indices.empty()} {}

  void draw_primitive(const Corners& corners, std::size_t number) {
    number_ = static_cast<std::int32_t>(number);
    if (!is_finite(corners)) return;
    switch (corners.all.size()) {
      case 1: return draw_point(corners);
      case 2: return draw_line(corners);
      default: return draw_polygon(corners);
    }
  }

 private:
  FragmentPipeline pipeline(const PrimitiveShader& shader, bool is_back) const {
    return {draw_,
            [&shader](const Fragment& fragment) { return shader.shade(fragment); },
            {command_, number_, is_back},
            buffers_};
  }

  void draw_point(const Corners& corners) {
    const ClipVertex vertex = clip_vertices(corners)[0];
    if (!is_in_view(vertex.position, volume_)) return;
    const PrimitiveShader shader(corners, kIsBack, colors_);
    FragmentPipeline pipeline = this->pipeline(shader, kIsBack);
    rasterize_point(window_vertex(vertex, window_), draw_.point_size, kNoOffset, window_,
                    [&](const Fragment& fragment) { pipeline.take(fragment); });
  }

  void draw_line(const Corners& corners) {
    const std::vector<ClipVertex> vertices = clip_vertices(corners);
    const std::vector<ClipVertex> line = clip_line(vertices[0], vertices[1], volume_);
    if (line.empty()) return;
    const PrimitiveShader shader(corners, kIsBack, colors_);
    FragmentPipeline pipeline = this->pipeline(shader, kIsBack);
    rasterize_line(window_vertex(line[0], window_), window_vertex(line[1], window_), draw_.line_width,
                   kNoOffset, window_, [&](const Fragment& fragment) { pipeline.take(fragment); });
  }

  // Facing, culling and offset are determined by the whole polygon, however it is split.
  void draw_polygon(const Corners& corners) {
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
    const PrimitiveShader shader(corners, is_back, colors_);
    FragmentPipeline pipeline = this->pipeline(shader, is_back);
    const FragmentCallback take = [&](const Fragment& fragment) { pipeline.take(fragment); };
    const double offset = depth_offset(draw_.polygon_offset, triangles, buffers_.format().depth);
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
  static constexpr bool kIsBack = false;
  static constexpr double kNoOffset = 0;

  const Draw& draw_;
  std::int32_t command_;
  std::int32_t number_ = 0;
  SampleBuffers& buffers_;
  ClipVolume volume_;
  std::optional<TextureSampler> texture_;
  Window window_;
  DrawColors colors_;
};

}  // namespace

void draw_mesh(const Draw& draw, const FrameState& state, SampleBuffers& buffers) {
  const Rect viewport = draw.viewport.value_or(buffers.rect());
  if (viewport.width == 0 || viewport.height == 0) return;
  const Draw drawn = draw.shadow_on ? shadow_of(draw, state.lights) : draw;
  const VertexStage vertices(state.scene.meshes.at(draw.mesh), drawn, state.camera);
  MeshDrawing drawing(drawn, state, viewport, buffers);
  for (std::size_t i = 0; i < vertices.primitive_count(); ++i) drawing.draw_primitive(vertices.corners(i), i);
}

}  // namespace tessera::reference
