// The plan of a draw: the effects that its state and data need, and the code paths of its vertices and
// pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/plan/texture_plan.h"
#include "engine/plan/varying_layout.h"
#include "engine/record/recording.h"
#include "raster/eye_transform.h"
#include "raster/vertex_transform.h"
#include "shading/lighting.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

/// A light that may turn out to miss one face of a draw.
struct LightCandidate {
  std::size_t light;
  int face;  ///< 0 front, 1 back
  LightReach reach;
};

struct DrawPlan {
  // Geometry.
  VertexTransform transform;
  EyeTransform eye;
  EyeTransform captured_eye;  ///< for captured normals, whose length does not matter
  Topology topology = Topology::triangles;
  float point_size = 1;      ///< pixels
  float line_width = 1;      ///< pixels
  bool outlines = false;     ///< some faces are drawn as lines or points
  PolygonMode mode[2] = {};  ///< per face: [0] front, [1] back
  PixelRect rect;            ///< pixels that may change; raster space
  bool keep_front = true;
  bool keep_back = true;
  bool front_is_clockwise = false;
  bool is_noop = false;      ///< the state lets no buffer change
  bool is_left_out = false;  ///< the data let no buffer change. Attachments are loaded and stored as with it

  // A bitmap or an image in place of a mesh.
  std::optional<PixelRectangle> pixel_rectangle;
  std::int32_t depth_key = 0;  ///< depth of all its pixels

  // Pixels.
  ColorSource source = ColorSource::constant;
  bool affine = false;    ///< varyings are linear in the window
  int cell_size = 0;      ///< coarse shading of triangles: 2 or 4, the side of a cell in pixels; 0: off
  bool deferred = false;  ///< colours are evaluated once per visible pixel
  std::uint32_t write_mask = 0xffffffffu;
  bool touches_color = true;  ///< the state lets colours change; with alpha 0, write_mask may still be 0
  bool uses_depth = false;
  bool depth_write = false;
  Compare depth_test = Compare::less;
  bool skips_hidden = false;  ///< tiles leave out triangles behind everything that they hold

  // Fragment operations.
  bool has_ops = false;  ///< fragments go through `ops`, or have a depth offset
  /// Operations take colours r g b a of 0 to 1. False for a stencil test alone of untextured triangles with
  /// one sample, which stores packed colors.
  bool float_colors = false;
  /// Colours are 0..1 at the pixels, as operations would have taken them that are left out because of the
  /// draw's data. Colours in levels round differently.
  bool unit_colors = false;
  /// `ops` has only a dither, which can be applied where visible pixels are shaded.
  bool can_defer_dither = false;
  bool defers_dither = false;  ///< visible pixels are dithered; fragments go through no operations
  FragmentOps ops;
  bool uses_stencil = false;  ///< tests or writes the stencil buffer
  float offset_factor = 0;
  float offset_units = 0;
  float alpha[2] = {1, 1};          ///< per face: [0] front, [1] back
  bool vertex_alpha = false;        ///< alpha of the vertices in place of `alpha`
  bool clamps_vertex_alpha = true;  ///< before interpolation; lit pixels clamp it themselves
  bool flat = false;                ///< ColorSource::interpolated with one colour per triangle

  // Colours.
  bool lit = false;        ///< lighting runs, at vertices, triangles or pixels
  bool two_sided = false;  ///< back faces have their own lighting program
  std::vector<EyeLight> lights;
  std::vector<LightReach> light_reach[2];  ///< per face: what is proven about each light; empty: nothing
  std::vector<LightCandidate> light_candidates;  ///< memory of prove_light_reach()
  LightingProgram front, back;
  Rgb constant_color{};      ///< ColorSource::constant: 0 to 1
  bool is_index[2] = {};     ///< per face, [0] front, [1] back: the colour is an index
  float constant_index = 0;  ///< ColorSource::constant, if the colour is an index
  bool uses_vertex_colors = false;
  bool uses_color_indices = false;
  bool smooth_normals = false;  ///< generated normals per vertex: means of the face normals
  bool face_normals = false;    ///< generated normals per triangle
  /// Flat shading of quads: the provoking vertex of a triangle may be a vertex of the other triangle only.
  bool provoking_vertex_elsewhere = false;
  bool scaled_colors = true;  ///< interpolated colours are carried as levels

  TexturePlan texture;
  bool textures_per_pixel = false;

  // User stages.
  const VertexStage* vertex_stage = nullptr;  ///< null: none
  std::optional<TileFragmentStage> fragment_stage;
  bool has_only_stage = false;         ///< fragments go through the stage and the depth test alone
  bool stage_needs_fragments = false;  ///< the fragment stage cannot run on visible pixels alone

  VaryingLayout varyings;

  // Inputs of lighting, at vertices, triangles or pixels.
  bool needs_normal() const { return lit && (front.needs_normal || (two_sided && back.needs_normal)); }
  bool needs_position() const { return lit && (front.needs_position || (two_sided && back.needs_position)); }
  /// Colours are stored, or decide which fragments pass.
  bool needs_colors() const {
    return write_mask != 0 || (fragment_stage && fragment_stage->runs_before_tests);
  }
  /// Vertices carry positions or normals in eye space.
  bool carries_position() const { return varyings.position >= 0 || varyings.stage_eye >= 0; }
  bool carries_normal() const { return varyings.normal >= 0 || varyings.stage_normal >= 0; }
  /// The texture's one colour is folded into the colours of vertices, triangles or the draw.
  bool folds_texture() const { return !textures_per_pixel && texture.use != TexturePlan::Use::none; }
  bool has_offset() const { return offset_factor != 0 || offset_units != 0; }
  bool only_indices() const { return is_index[0] && is_index[1]; }
  /// Maps colours to palette entries, if the buffer has a palette.
  bool uses_palette() const { return write_mask != 0 && !only_indices(); }
  /// Floats of a vertex's colour, per face. If one face stores an index and the other a colour, both take the
  /// room of a colour.
  int color_floats() const {
    if (only_indices()) return 1;
    return float_colors ? 4 : 3;
  }
  /// Colours are computed per triangle, not per vertex.
  bool has_per_triangle_colors() const {
    return source == ColorSource::per_triangle_packed ||
           (flat && (face_normals || provoking_vertex_elsewhere));
  }

  /// Restores the defaults. Lists keep their memory.
  void reset();
};

struct PlanOptions {
  bool capture_normals = false;  ///< the frame captures normals
  bool elide = true;             ///< leave out effects that the data of a draw make unnecessary
  InstructionSet isa = InstructionSet::scalar;  ///< for scans of the data
};

/// @param plan   is replaced
/// @param notes  receives the effects of the draw
void plan_draw(DrawPlan& plan, const RecordedDraw& draw, const FrameBufferState& target,
               const PlanOptions& options, const EffectNotes& notes);

/// Whether lighting normalizes the normals again that it is given: those of Phong shading.
inline bool renormalizes_normals(const RecordedDraw& draw) {
  return draw.state.shading == Shading::phong && draw.scene_state->quality.renormalize;
}

/// DrawState::plane_mask. With error diffusion it selects all planes of the colours as drawn, or none.
std::uint32_t plane_mask(const DrawState& state, const FrameBufferState& target);
/// Bits of stored colour words that may change; all 32 bits if all planes may.
std::uint32_t write_mask(const std::array<bool, 4>& color_mask, std::uint32_t plane_mask,
                         const ColorLayout& layout);

/// Converts a rectangle from window coordinates to raster space.
PixelRect raster_rect(const Rect& rect, int frame_height);

inline PixelRect whole_buffer(const FrameBufferState& target) {
  return {0, 0, target.format.width, target.format.height};
}
/// Whether `rect` contains all of `whole`.
inline bool covers(const PixelRect& rect, const PixelRect& whole) {
  return rect.x0 <= whole.x0 && rect.y0 <= whole.y0 && rect.x1 >= whole.x1 && rect.y1 >= whole.y1;
}

}  // namespace tessera::detail
