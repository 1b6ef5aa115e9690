// Triangles without fragment operations where pixels have several samples.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_triangles_msaa.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_functions-inl.h"
#include "shading/msaa_triangle_pixels-inl.h"
#include "shading/primitive_color-inl.h"
#include "shading/visible_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Draws a group without wide triangles: one walk through the blocks of a triangle serves all samples.
/// Returns whether the visibility buffer got any of the triangles, whose numbers start at `id`.
/// @pre the group is set up with the samples' reach
template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
HWY_INLINE bool draw_narrow_triangles(TileContext& context, std::uint32_t draw_number, std::uint32_t id) {
  const TriangleGroup& g = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  set_up_samples(g, context.memory.samples->samples32, context.samples,
                 kHasDepth<Depth> ? context.frame.depth_format : DepthFormat::none, context.tile_x,
                 context.tile_y);
  bool any_visible = false;
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1, ++id) {
    const int i = std::countr_zero(left);
    std::int32_t min_depth_key = 0;
    if constexpr (kUsesHiz<Depth, kDepthTest>) {
      min_depth_key = Depth::nearest_key(g, i, context.frame.depth_format);
      if (hiz_culls(context, min_depth_key, g.x0[i], g.y0[i], g.x1[i], g.y1[i])) continue;
    }
    const std::uint32_t value = kColorWrite == ColorWrite::constant
                                    ? packed_color_of(context, draw, i, is_back(context, draw, i))
                                    : id;
    const bool immediate =
        kColorWrite == ColorWrite::deferred && draw.path.color_write == ColorWrite::interpolated;
    MsaaColorEval color;
    if (immediate) color.set_up(context, draw, context.memory.visible_triangles[id], i);
    MsaaTrianglePixels<Depth, kDepthTest, kColorWrite> pixels(context, draw, i, value,
                                                              immediate ? &color : nullptr, min_depth_key);
    const BlockOffsets offsets(pixels.edges);
    for_each_block(pixels.edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
    if (kColorWrite == ColorWrite::constant || immediate)
      context.counts.shaded_pixels += count_of(pixels.visible);
    else if constexpr (kColorWrite == ColorWrite::deferred)
      any_visible |= !hn::AllTrue(kInt, hn::Eq(pixels.visible, hn::Zero(kInt)));
  }
  return any_visible;
}

template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
void draw_triangles_msaa(TileContext& context, std::uint32_t draw_number) {
  TileWorkspace::Memory& memory = context.memory;
  TriangleGroup& g = memory.group;
  set_up_edges(g, context.tile_x, context.tile_y, context.rect, sample_reach(context.samples));
  if (g.mask == 0) return;
  if constexpr (kHasDepth<Depth>) set_up_depth(g, context.frame.depth_format, context.tile_x, context.tile_y);
  bool any_wide = false;
  for (int i = 0; i < g.count; ++i) any_wide |= g.needs_edges64[i] != 0;
  if (any_wide) return draw_fragments_msaa(context, draw_number);
  const std::size_t first_id = memory.visible_triangles.size();
  if constexpr (kColorWrite == ColorWrite::deferred) {
    set_up_weights(g);
    for_each_triangle(g.mask, [&](int i) TESSERA_LOOP_BODY {
      fill_shaded_triangle(memory.visible_triangles.emplace_back(), context, draw_number, i,
                           is_back(context, context.frame.draws[draw_number], i));
    });
  }
  const bool any_visible = draw_narrow_triangles<Depth, kDepthTest, kColorWrite>(
      context, draw_number, static_cast<std::uint32_t>(first_id));
  if constexpr (kColorWrite == ColorWrite::deferred) {
    if (!any_visible) {
      memory.visible_triangles.resize(first_id);
    } else if (context.frame.shade_immediately) {
      shade_whole_tile(context);
    }
  }
}

template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction msaa_function_by_color(ColorWrite color_write) {
  switch (color_write) {
    // Rare: one function for all tests.
    case ColorWrite::none: return &draw_triangles_msaa<Depth, DepthTestPath::generic, ColorWrite::none>;
    case ColorWrite::constant: return &draw_triangles_msaa<Depth, kDepthTest, ColorWrite::constant>;
    default: return &draw_triangles_msaa<Depth, kDepthTest, ColorWrite::deferred>;
  }
}
template <class Depth>
DrawGroupFunction msaa_function_by_test(const PixelPath& path) {
  return path.depth_test == DepthTestPath::less_write
             ? msaa_function_by_color<Depth, DepthTestPath::less_write>(path.color_write)
             : msaa_function_by_color<Depth, DepthTestPath::generic>(path.color_write);
}

DrawGroupFunction triangles_msaa_function(const PixelPath& path) {
  switch (path.depth_format) {
    case DepthFormat::none: return msaa_function_by_color<NoDepth, DepthTestPath::generic>(path.color_write);
    case DepthFormat::float32: return msaa_function_by_test<Float32Depth>(path);
    case DepthFormat::unorm32:
      return msaa_function_by_color<Unorm32Depth, DepthTestPath::generic>(path.color_write);
    default: return msaa_function_by_test<UnormDepth>(path);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
