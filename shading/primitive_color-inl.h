// Colours of primitives that have one colour, for example flat triangles.
#if defined(TESSERA_SHADING_PRIMITIVE_COLOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_PRIMITIVE_COLOR_INL_H_
#undef TESSERA_SHADING_PRIMITIVE_COLOR_INL_H_
#else
#define TESSERA_SHADING_PRIMITIVE_COLOR_INL_H_
#endif

#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

HWY_INLINE std::size_t provoking_vertex(const TileDraw& draw, std::uint32_t element) {
  const std::size_t corner = std::size_t{element} * static_cast<std::size_t>(draw.element_corners) +
                             static_cast<std::size_t>(draw.provoking);
  return draw.indices ? draw.indices[corner] : corner;
}

/// Packed colour of element i of the group.
/// @pre ColorSource::constant, per_vertex_packed or per_triangle_packed; or an IdOutput
HWY_INLINE std::uint32_t packed_color_of(const TileContext& context, const TileDraw& draw, int i, bool back) {
  const int face = back ? 1 : 0;
  if (draw.source == ColorSource::per_triangle_packed)
    return draw.packed_colors[face][context.memory.source[i]];
  if (draw.source == ColorSource::per_vertex_packed)
    return draw.packed_colors[face][provoking_vertex(draw, context.memory.source[i])];
  return draw.packed_color;
}

/// Colour of a flat triangle, r g b a or an index: TileDraw::face_colors, or that of its provoking vertex.
HWY_INLINE const float* flat_color(const TileDraw& draw, std::uint32_t source, bool back) {
  const int face = back ? 1 : 0;
  if (draw.face_colors[face] != nullptr) return draw.face_colors[face] + std::size_t{source} * 4;
  return draw.attributes + provoking_vertex(draw, source) * static_cast<std::size_t>(draw.attribute_stride) +
         draw.color_attribute[face];
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
