// What the points of a batch share, and the way of a triangle's attributes into it.
#if defined(TESSERA_SHADING_BATCH_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_BATCH_SURFACE_INL_H_
#undef TESSERA_SHADING_BATCH_SURFACE_INL_H_
#else
#define TESSERA_SHADING_BATCH_SURFACE_INL_H_
#endif

#include <type_traits>

#include "shading/texture_coordinates-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// What the points of a batch share: one draw, one face.
struct BatchSurface {
  std::uint32_t draw = 0xffffffffu;
  bool back = false;
  // Which attributes of its triangles' vertices go into which arrays of the batch.
  int first_attribute = 0, attribute_count = 0;
  float* target[kMaxAttributes];
  bool adjacent = false;                 // the arrays follow each other
  bool clamps_to_range = false;          // of the triangles' vertices
  const DrawTexture* texture = nullptr;  // or none
  TextureCoordinates coordinates;        // of the triangle last gathered, of textures with levels

  HWY_INLINE bool is_of(const ShadedTriangle& triangle) const {
    return draw == triangle.draw && back == triangle.back;
  }
  /// No other surface has it: draws' numbers have 31 bits (kDrawMarker).
  HWY_INLINE std::int32_t surface_number() const {
    return static_cast<std::int32_t>(2 * draw + (back ? 1 : 0));
  }
};

/// The texture of a draw's faces: where indices are drawn, none has a say.
HWY_INLINE const DrawTexture* texture_of(const TileDraw& draw, bool back) {
  return draw.index[back ? 1 : 0] ? nullptr : draw.texture;
}

/// Whether a draw's attributes stay within those of a triangle's vertices: where pixels' centres may be
/// outside; and colours, unless they keep away from the borders of levels already (scaled_colors). What lies
/// beyond a line's end is as equation 3.6 has it.
HWY_INLINE bool attributes_clamp_to_range(const TileContext& context, const TileDraw& draw) {
  return draw.topology != Topology::lines &&
         (context.samples > 1 || (draw.source == ColorSource::interpolated && !draw.scaled_colors));
}

/// Makes the batch one of another surface. @pre it is empty
HWY_INLINE void begin_surface(const TileContext& context, BatchSurface& surface,
                              const ShadedTriangle& triangle) {
  const TileDraw& draw = context.frame.draws[triangle.draw];
  const bool per_pixel = draw.source == ColorSource::per_pixel, back = triangle.back;
  surface.draw = triangle.draw;
  surface.back = back;
  surface.first_attribute = per_pixel ? draw.first_attribute : draw.color_attribute[back ? 1 : 0];
  surface.attribute_count = per_pixel                              ? draw.attribute_count
                            : draw.source == ColorSource::constant ? 0
                            : draw.index[back ? 1 : 0]             ? 1
                                                                   : 3;
  surface.adjacent = true;
  for (int j = 0; j < surface.attribute_count; ++j) {
    surface.target[j] = context.memory.batch.field[per_pixel ? draw.fields[j] : kColorR + j];
    surface.adjacent &= surface.target[j] == surface.target[0] + j * kBatchPoints;
  }
  surface.clamps_to_range = attributes_clamp_to_range(context, draw);
  surface.texture = texture_of(draw, back);
  surface.coordinates.triangle = nullptr;
}

/// Of a texture with levels: what its coordinates in a triangle are made of.
HWY_INLINE const TextureCoordinates& coordinates_in(const TileContext& context, BatchSurface& surface,
                                                    const ShadedTriangle& triangle) {
  if (surface.coordinates.triangle != &triangle)
    surface.coordinates.set_up(triangle, context.memory.edges64.data(), *surface.texture,
                               context.frame.draws[surface.draw].topology == Topology::lines,
                               context.samples);
  return surface.coordinates;
}
HWY_INLINE bool has_coordinates(const BatchSurface& surface) {
  return surface.texture != nullptr && surface.texture->levels != nullptr;
}

/// Texture coordinates of the chunk of points from `point` on, in the lanes of `mask`.
inline HWY_NOINLINE void gather_coordinates(const TileContext& context, BatchSurface& surface,
                                            const ShadedTriangle& triangle, const Barycentric& at,
                                            LaneMask mask, int point) {
  const auto lanes = hn::RebindMask(kFloat, mask);
  coordinates_in(context, surface, triangle).at(at, [&](int field, Float value) HWY_ATTR {
    store_where(lanes, value, kFloat, context.memory.batch.field[field] + point);
  });
}

/// How many attributes a surface has, where they stand in adjacent arrays and are not kept within a range,
/// where there are no texture coordinates, and where the number is one that gather_block_span() is made for;
/// else 0.
HWY_INLINE int known_count(const BatchSurface& surface) {
  const int count = surface.attribute_count;
  return (count == 1 || count == 3 || count == 6) && surface.adjacent && !surface.clamps_to_range &&
                 !has_coordinates(surface)
             ? count
             : 0;
}
/// Calls body(known_count()) with a constant.
template <class Run>
HWY_INLINE void with_known_count(const BatchSurface& surface, const Run& body) {
  switch (known_count(surface)) {
    case 1: return body(std::integral_constant<int, 1>());
    case 3: return body(std::integral_constant<int, 3>());
    case 6: return body(std::integral_constant<int, 6>());
    default: return body(std::integral_constant<int, 0>());
  }
}

/// Adds what is seen of one triangle in one block to the points from `first` on; what other lanes hold stays.
/// @param kCount  known_count(), or 0 for any
/// @param values  TriangleInterpolants or InterpolantArrays of the surface's attributes
/// @param at      Barycentric of a chunk
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
    if (kCount == 0 && has_coordinates(surface))
      gather_coordinates(context, surface, triangle, weights, mask, point);
  }
}
/// Compiled once: few triangles are wide, but points and lines all are.
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
