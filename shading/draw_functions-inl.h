// Kernels of a tile that call each other across translation units. Each is compiled in the file named with
// it, for every instruction set; calls stay within one set. Calls cross units once per group of elements,
// once per batch of points or once per block of fragments, never per pixel.
#if defined(TESSERA_SHADING_DRAW_FUNCTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_FUNCTIONS_INL_H_
#undef TESSERA_SHADING_DRAW_FUNCTIONS_INL_H_
#else
#define TESSERA_SHADING_DRAW_FUNCTIONS_INL_H_
#endif

#include "shading/pixel_path.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Draws the elements in the workspace's group.
using DrawGroupFunction = void (*)(TileContext&, std::uint32_t draw_number);

// Functions for PixelPath::Kind::triangles, by type of depth.
DrawGroupFunction triangles_function_no_depth(const PixelPath& path);  // draw_triangles_no_depth.cpp
DrawGroupFunction triangles_function_unorm(const PixelPath& path);     // draw_triangles_unorm.cpp
DrawGroupFunction triangles_function_unorm32(const PixelPath& path);   // draw_triangles_unorm32.cpp
DrawGroupFunction triangles_function_float32(const PixelPath& path);   // draw_triangles_float32.cpp
// The function for PixelPath::Kind::triangles_msaa.
DrawGroupFunction triangles_msaa_function(const PixelPath& path);  // draw_triangles_msaa.cpp

void draw_textured_triangles(TileContext& context, std::uint32_t draw_number);  // draw_textured.cpp
void draw_fragments(TileContext& context, std::uint32_t draw_number);           // draw_fragments.cpp
void draw_fragments_msaa(TileContext& context, std::uint32_t draw_number);      // draw_fragments.cpp
void draw_points(TileContext& context, std::uint32_t draw_number);              // draw_points_lines.cpp
void draw_lines(TileContext& context, std::uint32_t draw_number);               // draw_points_lines.cpp
void draw_point_fragments(TileContext& context, std::uint32_t draw_number);     // draw_points_lines.cpp
void draw_line_fragments(TileContext& context, std::uint32_t draw_number);      // draw_points_lines.cpp
/// Draws a bitmap or an image, which has no groups.
void draw_pixel_rectangle(TileContext& context, std::uint32_t draw_number);  // draw_pixel_rectangle.cpp

/// Shades what was collected in the blocks of [x0, x1] x [y0, y1], pixels of the tile, and clears the
/// visibility buffer there. @pre one sample per pixel
void shade_visible(TileContext& context, int x0, int y0, int x1, int y1);  // deferred_shading.cpp
/// Shades what was collected at all samples of the tile, and clears their visibility buffers.
void shade_visible_msaa(TileContext& context);  // deferred_shading_msaa.cpp

/// Shades everything that was collected in the tile.
HWY_INLINE void shade_whole_tile(TileContext& context) {
  if (!context.memory.visible_triangles.empty()) {
    if (context.samples > 1) shade_visible_msaa(context);
    else shade_visible(context, 0, 0, context.tile_size - 1, context.tile_size - 1);
  }
  context.memory.visible_triangles.clear();
  context.memory.edges64.clear();
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
