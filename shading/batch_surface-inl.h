// The surface that the points of a batch share, and how attributes of triangles are gathered into the batch.
#if defined(TESSERA_SHADING_BATCH_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_BATCH_SURFACE_INL_H_
#undef TESSERA_SHADING_BATCH_SURFACE_INL_H_
#else
#define TESSERA_SHADING_BATCH_SURFACE_INL_H_
#endif

#include <type_traits>

#include "shading/fragment_ops-inl.h"
#include "shading/texture_coordinates-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// One face of one draw: where its attributes go, and the steps from there to colours.
struct BatchSurface {
  enum class Packing : std::uint8_t { levels, indices, unit };

  std::uint32_t draw = 0xffffffffu;
  bool back = false;

  int first_attribute = 0;  // in the records of the vertices
  int attribute_count = 0;
  float* target[kMaxAttributes];     // per attribute: its array in the batch
  bool adjacent = false;             // these arrays follow each other
  bool clamps_to_range = false;      // attributes are clamped to the range of the vertices
  bool gathers_coordinates = false;  // texture coordinates are gathered with the attributes
  TextureCoordinates coordinates;    // those of the triangle gathered last

  bool is_constant = false;                  // all points have the colour of the draw
  bool interpolates_colors = false;          // attributes are colours, 0..1 or levels; not indices
  const LightingProgram* program = nullptr;  // computes colours from the attributes; null: they are colours
  // Coarse shading: cells of cell_size x cell_size pixels are lit by cell_program, and pixels gather none of
  // the inputs of lighting. 0: no cells.
  int cell_size = 0;
  int cell_attribute_count = 0;
  const LightingProgram* cell_program = nullptr;
  bool clamps_colors = false;                // extrapolated colours are clamped to 0..1
  const DrawTexture* texture = nullptr;      // null: none
  const TileFragmentStage* stage = nullptr;  // runs on the textured colours; null: none
  bool gathers_stage_inputs = false;         // inputs of the stage are gathered with the attributes
  int alpha_attribute = -1;                  // with a stage: the attribute of alpha; -1: `alpha` everywhere
  float alpha = 1;
  const TileDraw* tile_draw = nullptr;  // the draw whose colours these are
  Packing packing = Packing::unit;

  HWY_INLINE bool is_of(const ShadedTriangle& triangle) const {
    return draw == triangle.draw && back == triangle.back;
  }
  /// Unique per surface: numbers of draws have 31 bits (kDrawMarker).
  HWY_INLINE std::int32_t surface_number() const {
    return static_cast<std::int32_t>(2 * draw + (back ? 1 : 0));
  }
};

/// The texture of a draw's faces. Indices are not textured.
HWY_INLINE const DrawTexture* texture_of(const TileDraw& draw, bool back) {
  return draw.index[back ? 1 : 0] ? nullptr : draw.texture;
}

/// Whether attributes are clamped to the range of a triangle's vertices. With several samples the centre of a
/// covered pixel may lie outside the triangle. With one sample only colours 0..1 are clamped; scaled_colors
/// keep a margin instead (scale_colors()), and those of a fragment stage are clamped before it. Lines
/// extrapolate beyond their ends [GL 2.1, equation 3.6].
HWY_INLINE bool attributes_clamp_to_range(const TileContext& context, const TileDraw& draw) {
  if (draw.topology == Topology::lines) return false;
  if (context.samples > 1) return true;
  return draw.source == ColorSource::interpolated && !draw.scaled_colors && draw.stage == nullptr;
}

/// Whether a fragment stage has inputs that are interpolated from the vertices, besides the colour.
HWY_INLINE bool has_interpolated_inputs(const TileFragmentStage& stage, int alpha_attribute) {
  return stage.eye >= 0 || stage.normal >= 0 || stage.extras >= 0 || alpha_attribute >= 0;
}

/// Sets `surface` to that of the triangle, with the colours of `draw`. @pre the batch is empty
HWY_INLINE void begin_surface(const TileContext& context, BatchSurface& surface,
                              const ShadedTriangle& triangle, const TileDraw& draw) {
  const int face = triangle.back ? 1 : 0;
  const bool is_lit = draw.source == ColorSource::per_pixel;
  const bool is_index = draw.index[face];
  surface.draw = triangle.draw;
  surface.tile_draw = &draw;
  surface.back = triangle.back;
  surface.is_constant = draw.source == ColorSource::constant;
  surface.program = is_lit ? draw.programs[face] : nullptr;
  surface.first_attribute = is_lit ? draw.first_attribute : draw.color_attribute[face];
  surface.attribute_count = is_index ? 1 : 3;
  if (is_lit) surface.attribute_count = draw.attribute_count;
  surface.cell_size = is_lit ? draw.cell_size : 0;
  surface.cell_attribute_count = surface.attribute_count;
  surface.cell_program = surface.program;
  if (surface.cell_size > 0) surface.program = nullptr;
  if (surface.is_constant || surface.cell_size > 0) surface.attribute_count = 0;
  surface.adjacent = true;
  for (int j = 0; j < surface.attribute_count; ++j) {
    surface.target[j] = context.memory.batch.field[is_lit ? draw.fields[j] : kColorR + j];
    surface.adjacent &= surface.target[j] == surface.target[0] + j * kBatchPoints;
  }
  surface.clamps_to_range = attributes_clamp_to_range(context, draw);
  surface.interpolates_colors = draw.source == ColorSource::interpolated && !is_index;
  const bool may_exceed_unit = draw.topology == Topology::lines || draw.stage != nullptr;
  surface.clamps_colors = surface.interpolates_colors && may_exceed_unit;
  surface.texture = texture_of(draw, triangle.back);
  surface.gathers_coordinates = surface.texture != nullptr && surface.texture->levels != nullptr;
  surface.coordinates.triangle = nullptr;
  surface.stage = draw.stage;
  surface.alpha_attribute = draw.alpha_attribute[face];
  surface.gathers_stage_inputs =
      surface.stage != nullptr && has_interpolated_inputs(*surface.stage, surface.alpha_attribute);
  surface.alpha = surface.is_constant ? draw.color[face][3] : draw.alpha[face];
  surface.packing = BatchSurface::Packing::unit;
  if (!is_lit && draw.scaled_colors) surface.packing = BatchSurface::Packing::levels;
  if (is_index) surface.packing = BatchSurface::Packing::indices;
}
HWY_INLINE void begin_surface(const TileContext& context, BatchSurface& surface,
                              const ShadedTriangle& triangle) {
  begin_surface(context, surface, triangle, context.frame.draws[triangle.draw]);
}

/// The texture coordinates of a triangle. @pre the texture has levels
HWY_INLINE const TextureCoordinates& coordinates_in(const TileContext& context, BatchSurface& surface,
                                                    const ShadedTriangle& triangle) {
  if (surface.coordinates.triangle != &triangle)
    surface.coordinates.set_up(triangle, context.memory.edges64.data(), *surface.texture,
                               surface.tile_draw->topology == Topology::lines, context.samples);
  return surface.coordinates;
}

/// Stores texture coordinates in the chunk of points from `point` on, in the lanes of `mask`.
inline HWY_NOINLINE void gather_coordinates(const TileContext& context, BatchSurface& surface,
                                            const ShadedTriangle& triangle, const Barycentric& at,
                                            LaneMask mask, int point) {
  const auto lanes = hn::RebindMask(kFloat, mask);
  coordinates_in(context, surface, triangle).at(at, [&](int field, Float value) HWY_ATTR {
    store_where(lanes, value, kFloat, context.memory.batch.field[field] + point);
  });
}

/// Calls store(field, value) for each interpolated input of the surface's fragment stage (StageField).
template <class Store>
HWY_INLINE void interpolate_stage_inputs(const TileContext& context, const BatchSurface& surface,
                                         const ShadedTriangle& triangle, const Barycentric& at,
                                         const Store& store) {
  const TileFragmentStage& stage = *surface.stage;
  const bool clamps = context.samples > 1 && surface.tile_draw->topology != Topology::lines;
  const auto interpolate_each = [&](int attribute, int field, int count) HWY_ATTR {
    for (int k = 0; k < count && attribute >= 0; ++k)
      store(field + k, interpolate_clamped(at, make_interpolant(triangle, attribute + k, clamps)));
  };
  interpolate_each(stage.eye, kStageEye, 3);
  interpolate_each(stage.normal, kStageNormal, 3);
  interpolate_each(stage.extras, kStageExtras, stage.stage.reads.extras);
  if (surface.alpha_attribute < 0) return;
  const Interpolant alpha = make_interpolant(triangle, surface.alpha_attribute,
                                             attributes_clamp_to_range(context, *surface.tile_draw));
  store(kStageAlpha, clamped_unit(interpolate_clamped(at, alpha)));
}
/// Stores these inputs in the chunk of points from `point` on, in the lanes of `mask`.
inline HWY_NOINLINE void gather_stage_inputs(const TileContext& context, const BatchSurface& surface,
                                             const ShadedTriangle& triangle, const Barycentric& at,
                                             LaneMask mask, int point) {
  const auto lanes = hn::RebindMask(kFloat, mask);
  interpolate_stage_inputs(context, surface, triangle, at, [&](int field, Float value) HWY_ATTR {
    store_where(lanes, value, kFloat, context.memory.stage.field[field] + point);
  });
}

/// Number of attributes, if gather_block_span() has a specialization for it: 1, 3 or 6 in adjacent arrays,
/// without clamping to a range, texture coordinates and inputs of a stage. Otherwise 0.
HWY_INLINE int known_count(const BatchSurface& surface) {
  const int count = surface.attribute_count;
  const bool has_special_count = count == 1 || count == 3 || count == 6;
  const bool gathers_others = surface.gathers_coordinates || surface.gathers_stage_inputs;
  const bool is_plain = surface.adjacent && !surface.clamps_to_range && !gathers_others;
  return has_special_count && is_plain ? count : 0;
}
/// Calls body(count), where count.value is known_count() as a constant.
template <class Run>
HWY_INLINE void with_known_count(const BatchSurface& surface, const Run& body) {
  switch (known_count(surface)) {
    case 1: return body(std::integral_constant<int, 1>());
    case 3: return body(std::integral_constant<int, 3>());
    case 6: return body(std::integral_constant<int, 6>());
    default: return body(std::integral_constant<int, 0>());
  }
}

/// Gathers the attributes of one triangle's visible pixels in one block into the points from `first` on.
/// Other points are unchanged.
/// @param kCount   known_count(), or 0 for any
/// @param values   TriangleInterpolants or InterpolantArrays of the surface's attributes
/// @param at       at(chunk): barycentric coordinates of a chunk
/// @param covered  visible pixels, 16 bits
template <int kCount, class Values, class At>
HWY_INLINE void gather_values(const TileContext& context, BatchSurface& surface,
                              const ShadedTriangle& triangle, const Values& values, const At& at,
                              std::uint32_t covered, int first) {
  const int count = kCount > 0 ? kCount : surface.attribute_count;
  float* const adjacent = kCount > 0 ? surface.target[0] : nullptr;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const std::uint32_t lanes = chunk_bits(covered, chunk);
    if (kChunksPerBlock > 1 && lanes == 0) continue;
    const LaneMask mask = mask_from_bits(lanes);
    const Barycentric weights = at(chunk);
    const int point = first + chunk * kLanes;
    for (int j = 0; j < count; ++j) {
      const Float value =
          kCount == 0 && surface.clamps_to_range
              ? interpolate_clamped(weights, make_interpolant(triangle, surface.first_attribute + j, true))
              : interpolate(weights, values, j);
      store_where(hn::RebindMask(kFloat, mask), value, kFloat,
                  (kCount > 0 ? adjacent + j * kBatchPoints : surface.target[j]) + point);
    }
    if (kCount == 0 && surface.gathers_coordinates)
      gather_coordinates(context, surface, triangle, weights, mask, point);
    if (kCount == 0 && surface.gathers_stage_inputs)
      gather_stage_inputs(context, surface, triangle, weights, mask, point);
  }
}
/// gather_values() for wide triangles, and for all points and lines. Compiled once: few triangles are wide.
inline HWY_NOINLINE void gather_edges64(const TileContext& context, BatchSurface& surface,
                                        const ShadedTriangle& triangle, int bx, int by, std::uint32_t covered,
                                        int first) {
  const Edges64& edges = context.memory.edges64[static_cast<std::size_t>(triangle.edges64_index)];
  const InterpolantArrays values(triangle, surface.first_attribute, surface.attribute_count);
  gather_values<0>(
      context, surface, triangle, values,
      [&](int chunk) HWY_ATTR { return barycentric_edges64(triangle, edges, bx, by, chunk); }, covered,
      first);
}
/// gather_values() in the block at (bx, by).
template <int kCount, class Values>
HWY_INLINE void gather_block_span(const TileContext& context, BatchSurface& surface,
                                  const ShadedTriangle& triangle, const Values& values, int bx, int by,
                                  std::uint32_t covered, int first) {
  if (HWY_UNLIKELY(triangle.edges64_index >= 0))
    return gather_edges64(context, surface, triangle, bx, by, covered, first);
  const BlockEdges32 edges(triangle, bx, by);
  gather_values<kCount>(
      context, surface, triangle, values, [&](int chunk) HWY_ATTR { return edges.barycentric(chunk); },
      covered, first);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
