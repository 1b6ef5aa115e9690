// Kernels of a tile that call each other across translation units. Each is compiled for every instruction
// set, in the file named above it; calls stay within one instruction set. A call across units happens once
// per group of elements, per batch of points or per block of fragments, never per pixel.
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

// PixelPath::Kind::triangles: draw_triangles_no_depth.cpp, draw_triangles_unorm.cpp,
// draw_triangles_unorm32.cpp, draw_triangles_float32.cpp
DrawGroupFunction triangles_function_no_depth(const PixelPath& path);
DrawGroupFunction triangles_function_unorm(const PixelPath& path);
DrawGroupFunction triangles_function_unorm32(const PixelPath& path);
DrawGroupFunction triangles_function_float32(const PixelPath& path);

// PixelPath::Kind::triangles_msaa: draw_triangles_msaa.cpp
DrawGroupFunction triangles_msaa_function(const PixelPath& path);

// draw_textured.cpp
void draw_textured_triangles(TileContext& context, std::uint32_t draw_number);

// draw_fragments.cpp
void draw_fragments(TileContext& context, std::uint32_t draw_number);
void draw_fragments_msaa(TileContext& context, std::uint32_t draw_number);

// draw_points_lines.cpp
void draw_points(TileContext& context, std::uint32_t draw_number);
void draw_lines(TileContext& context, std::uint32_t draw_number);
void draw_point_fragments(TileContext& context, std::uint32_t draw_number);
void draw_line_fragments(TileContext& context, std::uint32_t draw_number);

// draw_pixel_rectangle.cpp

/// Draws a bitmap or an image, which has no groups.
void draw_pixel_rectangle(TileContext& context, std::uint32_t draw_number);

// deferred_shading.cpp, deferred_shading_msaa.cpp

/// Shades the visible triangles in the blocks that [x0, x1] x [y0, y1], pixels of the tile, touches, and
/// clears the visibility buffer there. @pre one sample per pixel
void shade_visible(TileContext& context, int x0, int y0, int x1, int y1);
/// Shades the visible triangles at all samples of the tile, and clears the samples' visibility buffers.
void shade_visible_msaa(TileContext& context);

/// Shades all visible triangles of the tile and removes them.
HWY_INLINE void shade_whole_tile(TileContext& context) {
  if (!context.memory.visible_triangles.empty()) {
    const std::uint32_t measured_draw = context.meter != nullptr ? context.meter->current() : 0;
    if (context.samples > 1) shade_visible_msaa(context);
    else shade_visible(context, 0, 0, context.tile_size - 1, context.tile_size - 1);
    if (context.meter != nullptr) context.meter->switch_to(measured_draw, context.counts.shaded_pixels);
  }
  context.memory.visible_triangles.clear();
  context.memory.edges64.clear();
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
