// The triangles of a group that have pixels in the tile: set-up, edges, and the record that shading reads.
#if defined(TESSERA_SHADING_VISIBLE_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_VISIBLE_TRIANGLES_INL_H_
#undef TESSERA_SHADING_VISIBLE_TRIANGLES_INL_H_
#else
#define TESSERA_SHADING_VISIBLE_TRIANGLES_INL_H_
#endif

#include <bit>

#include "raster/coverage-inl.h"
#include "raster/triangle_setup-inl.h"
#include "shading/tile_context-inl.h"

// For a lambda that is the body of a loop over triangles: the loop and its body are one function.
#define TESSERA_LOOP_BODY HWY_ATTR __attribute__((always_inline))

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Edges of one triangle in the tile.
struct TileEdges {
  Edges32 edges;    ///< for coverage
  Edges64 edges64;  ///< weights of a wide triangle; unset if narrow
  bool is_wide;

  /// Loads triangle i of the group. Returns false if it is wide and misses the tile.
  HWY_INLINE bool load(const TileContext& context, int i) {
    const TriangleGroup& g = context.memory.group;
    edges = tile_edges32(g, i);
    is_wide = g.needs_edges64[i] != 0;
    return !is_wide || tile_edges64(g, i, context.tile_x, context.tile_y, context.tile_size, edges, edges64);
  }
};

/// Sets up the group in the tile. Returns the triangles that have pixels there, one bit each.
HWY_INLINE std::uint32_t set_up_group(TileContext& context, bool needs_depth, bool needs_weights) {
  TriangleGroup& g = context.memory.group;
  set_up_edges(g, context.tile_x, context.tile_y, context.rect);
  if (g.mask == 0) return 0;
  if (needs_depth) set_up_depth(g, context.frame.depth_format, context.tile_x, context.tile_y);
  if (needs_weights) set_up_weights(g);
  return g.mask;
}

/// Calls body(i) for each bit i of `triangles`, in order.
template <class Body>
HWY_INLINE void for_each_triangle(std::uint32_t triangles, const Body& body) {
  for (std::uint32_t left = triangles; left != 0; left &= left - 1) body(std::countr_zero(left));
}

/// Calls body(i, edges) for the triangles that touch the tile, in order.
/// @param triangles  triangles of the group, one bit each
/// @param shortcut   returns true for triangle i if it has drawn it without its edges
template <class Shortcut, class Body>
HWY_INLINE void for_each_visible_triangle(const TileContext& context, std::uint32_t triangles,
                                          const Shortcut& shortcut, const Body& body) {
  for_each_triangle(triangles, [&](int i) TESSERA_LOOP_BODY {
    if (shortcut(i)) return;
    TileEdges edges;
    if (edges.load(context, i)) body(i, edges);
  });
}
template <class Body>
HWY_INLINE void for_each_visible_triangle(const TileContext& context, std::uint32_t triangles,
                                          const Body& body) {
  for_each_visible_triangle(
      context, triangles, [](int) TESSERA_LOOP_BODY { return false; }, body);
}

/// Fills `t` for triangle i of the group, except the edges of a wide triangle.
inline HWY_NOINLINE void fill_shaded_triangle(ShadedTriangle& t, const TileContext& context,
                                              std::uint32_t draw, int i, bool back) {
  const TriangleGroup& g = context.memory.group;
  set_tile_edges32(t.edges, g, i);  // in place: a copy would wait for each of its stores
  for (int k = 0; k < 3; ++k) {
    t.scale[k] = g.needs_edges64[i] != 0 ? g.unit_scale[k][i] : g.scale[k][i];
    t.shift[k] = g.shift[k][i];
    t.attributes[k] = context.memory.attributes[k][i];
  }
  t.affine = g.affine[i] != 0;
  t.back = back;
  t.draw = draw;
  t.edges64_index = -1;
}

HWY_INLINE void store_edges64(ShadedTriangle& triangle, TileWorkspace::Memory& memory, const Edges64& edges) {
  triangle.edges64_index = static_cast<std::int32_t>(memory.edges64.size());
  memory.edges64.push_back(edges);
}

/// Fills `t` for triangle i of the group, and stores the edges of a wide triangle in the workspace.
HWY_INLINE void fill_shaded_triangle(ShadedTriangle& t, TileContext& context, std::uint32_t draw, int i,
                                     bool back, const TileEdges& edges) {
  fill_shaded_triangle(t, context, draw, i, back);
  if (edges.is_wide) store_edges64(t, context.memory, edges.edges64);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
