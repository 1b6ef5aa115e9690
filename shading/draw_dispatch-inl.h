// Maps the path of a draw to the function that draws a group of its points, lines or triangles.
#if defined(TESSERA_SHADING_DRAW_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#undef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#else
#define TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#endif

#include "shading/draw_group_msaa-inl.h"
#include "shading/draw_textured-inl.h"
#include "shading/points_lines-inl.h"
#include "shading/tile_renderer.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

using DrawGroupFunction = void (*)(TileContext&, std::uint32_t draw);

template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction triangles_function(ColorWrite color_write) {
  switch (color_write) {
    case ColorWrite::none: return &draw_group<Depth, kDepthTest, ColorWrite::none>;
    case ColorWrite::constant: return &draw_group<Depth, kDepthTest, ColorWrite::constant>;
    case ColorWrite::interpolated: return &draw_group<Depth, kDepthTest, ColorWrite::interpolated>;
    case ColorWrite::blended: return &draw_group<Depth, DepthTestPath::generic, ColorWrite::blended>;
    default: return &draw_group<Depth, kDepthTest, ColorWrite::deferred>;
  }
}
template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction triangles_msaa_function(ColorWrite color_write) {
  switch (color_write) {
    // Rare: one function for all tests.
    case ColorWrite::none: return &draw_group_msaa<Depth, DepthTestPath::generic, ColorWrite::none>;
    case ColorWrite::constant: return &draw_group_msaa<Depth, kDepthTest, ColorWrite::constant>;
    default: return &draw_group_msaa<Depth, kDepthTest, ColorWrite::deferred>;
  }
}

template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction triangles_function_of(const PixelPath& path) {
  return path.kind == PixelPath::Kind::triangles_msaa
             ? triangles_msaa_function<Depth, kDepthTest>(path.color_write)
             : triangles_function<Depth, kDepthTest>(path.color_write);
}
inline DrawGroupFunction triangles_function_of(const PixelPath& path) {
  const bool less_write = path.depth_test == DepthTestPath::less_write;
  switch (path.depth_format) {
    case DepthFormat::none: return triangles_function_of<NoDepth, DepthTestPath::generic>(path);
    case DepthFormat::float32:
      return less_write ? triangles_function_of<Float32Depth, DepthTestPath::less_write>(path)
                        : triangles_function_of<Float32Depth, DepthTestPath::generic>(path);
    case DepthFormat::unorm32: return triangles_function_of<Unorm32Depth, DepthTestPath::generic>(path);
    default:
      return less_write ? triangles_function_of<UnormDepth, DepthTestPath::less_write>(path)
                        : triangles_function_of<UnormDepth, DepthTestPath::generic>(path);
  }
}

/// The function that draws a group of elements of a draw.
inline HWY_NOINLINE DrawGroupFunction draw_group_function(const PixelPath& path) {
  using Kind = PixelPath::Kind;
  switch (path.kind) {
    case Kind::triangles:
    case Kind::triangles_msaa: return triangles_function_of(path);
    case Kind::textured_triangles:
      if constexpr (kLanes > 1) return &draw_textured;
      break;
    case Kind::fragments: return &draw_fragments;
    case Kind::fragments_msaa: return &draw_fragments_msaa;
    case Kind::points: return &draw_points;
    case Kind::lines: return &draw_lines;
    case Kind::point_fragments: return &draw_point_fragments;
    case Kind::line_fragments: return &draw_line_fragments;
    case Kind::pixel_rectangle: break;  // has no groups
  }
  return nullptr;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
