// Maps the path of a draw to the function that draws a group of its points, lines or triangles.
#if defined(TESSERA_SHADING_DRAW_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#undef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#else
#define TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#endif

#include "shading/draw_functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

inline DrawGroupFunction triangles_function(const PixelPath& path) {
  switch (path.depth_format) {
    case DepthFormat::none: return triangles_function_no_depth(path);
    case DepthFormat::float32: return triangles_function_float32(path);
    case DepthFormat::unorm32: return triangles_function_unorm32(path);
    default: return triangles_function_unorm(path);
  }
}

/// Null for Kind::pixel_rectangle, which has no groups.
inline HWY_NOINLINE DrawGroupFunction draw_group_function(const PixelPath& path) {
  using Kind = PixelPath::Kind;
  switch (path.kind) {
    case Kind::triangles: return triangles_function(path);
    case Kind::triangles_msaa: return triangles_msaa_function(path);
    case Kind::textured_triangles:
      if constexpr (kLanes > 1) return &draw_textured_triangles;
      break;
    case Kind::fragments: return &draw_fragments;
    case Kind::fragments_msaa: return &draw_fragments_msaa;
    case Kind::points: return &draw_points;
    case Kind::lines: return &draw_lines;
    case Kind::point_fragments: return &draw_point_fragments;
    case Kind::line_fragments: return &draw_line_fragments;
    case Kind::pixel_rectangle: break;
  }
  return nullptr;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
