// The plan of a draw: from its state and data the set of effects it needs, and with it what runs for its
// vertices and pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/plan/texture_plan.h"
#include "engine/plan/varying_layout.h"
#include "engine/record/recording.h"
#include "raster/vertex_transform.h"
#include "shading/lighting.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

struct DrawPlan {
  VertexTransform transform;
  EyeTransform eye;
  EyeTransform captured_eye;  ///< for normals whose direction alone is wanted
  Topology topology = Topology::triangles;
  float point_size = 1, line_width = 1;  ///< pixels
  bool outlines = false;                 ///< some faces are drawn as lines or points
  PolygonMode style[2] = {};             ///< of fronts and backs
  PixelRect rect;                        ///< where pixels may change, raster space
  bool keep_front = true, keep_back = true, front_is_clockwise = false;
  bool is_noop = false;  ///< no buffer can change

  std::optional<PixelRectangle> pixel_rectangle;  ///< a bitmap or an image, in place of a mesh
  std::int32_t depth_key = 0;                     ///< of all its pixels

  ColorSource source = ColorSource::constant;
  bool deferred = false;
  std::uint32_t write_mask = 0xffffffffu;
  bool uses_depth = false, depth_write = false;
  Compare depth_test = Compare::less;

  /// Its fragments go through `ops`, or have their depth offset.
  bool has_ops = false;
  bool float_colors = false;  ///< and these take colours 0..1 with alpha: all but a stencil test alone of
                              ///< untextured triangles with one sample
  FragmentOps ops;
  bool uses_stencil = false;  ///< tests or writes it
  float offset_factor = 0, offset_units = 0;
  float alpha[2] = {1, 1};          ///< front, back
  bool vertex_alpha = false;        ///< the vertices' in place of that
  bool clamps_vertex_alpha = true;  ///< before it is interpolated: not where pixels are lit
  bool flat = false;                ///< ColorSource::interpolated, but one colour a triangle

  bool lit = false;        ///< lights run: at vertices, triangles or pixels
  bool two_sided = false;  ///< back faces have a program of their own
  std::vector<EyeLight> lights;
  LightingProgram front, back;
  Rgb constant_color{};      ///< ColorSource::constant; within 0 .. 1
  bool is_index[2] = {};     ///< front, back: the colour is an index
  float constant_index = 0;  ///< ColorSource::constant, if it is
  bool uses_vertex_colors = false, uses_color_indices = false;
  bool smooth_normals = false;              ///< the mesh has none: means of its faces
  bool face_normals = false;                ///< the mesh has none: flat
  bool provoking_vertex_elsewhere = false;  ///< flat, and the provoking vertex is not one of each triangle's
  bool scaled_colors = true;                ///< interpolated colours are carried in levels

  TexturePlan texture;
  bool textures_per_pixel = false;  ///< at each of them
  bool folds_texture() const {
    return !textures_per_pixel && texture.use != TexturePlan::Use::none;
  }  ///< its one colour into the colours of vertices, triangles or the draw

  VaryingLayout varyings;

  /// Inputs of lighting, at vertices, triangles or pixels.
  bool needs_normal() const { return lit && (front.needs_normal || (two_sided && back.needs_normal)); }
  bool needs_position() const { return lit && (front.needs_position || (two_sided && back.needs_position)); }
  bool has_offset() const { return offset_factor != 0 || offset_units != 0; }
  bool only_indices() const { return is_index[0] && is_index[1]; }
  bool uses_palette() const {
    return write_mask != 0 && !only_indices();
  }  ///< in the palette, if the buffer has one
  /// Floats that a vertex's colour of one face takes: for operations that take it it has alpha; an index has
  /// no more than itself, but beside a face with colours as much room as those.
  int color_floats() const { return only_indices() ? 1 : float_colors ? 4 : 3; }
  /// Colours are made for triangles, not for vertices.
  bool has_per_triangle_colors() const {
    return source == ColorSource::per_triangle_packed ||
           (flat && (face_normals || provoking_vertex_elsewhere));
  }

  /// As a new one, but that its lists keep their memory.
  void reset();
};

/// @param plan             is replaced
/// @param capture_normals  the frame captures normals
/// @param notes            receives the effects of the draw
void plan_draw(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target, bool capture_normals,
               const EffectNotes& notes);

/// The bits of colour words that may change; all 32 for all planes.
std::uint32_t write_mask(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask,
                         const ColorLayout& layout);

/// A rectangle in window coordinates as pixels in raster space.
PixelRect raster_rect(const Rect& rect, int frame_height);

inline PixelRect whole_buffer(const FrameBufferState& target) {
  return {0, 0, target.format.width, target.format.height};
}
/// Whether `rect` contains all of `whole`.
inline bool covers(const PixelRect& rect, const PixelRect& whole) {
  return rect.x0 <= whole.x0 && rect.y0 <= whole.y0 && rect.x1 >= whole.x1 && rect.y1 >= whole.y1;
}

}  // namespace tessera::detail
