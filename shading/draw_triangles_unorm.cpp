// draw_triangles() with unorm depth of 16 or 24 bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_triangles_unorm.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

DrawGroupFunction triangles_function_unorm(const PixelPath& path) {
  if (path.depth_test == DepthTestPath::less_write)
    return triangles_function_by_color<UnormDepth, DepthTestPath::less_write>(path.color_write);
  return triangles_function_by_color<UnormDepth, DepthTestPath::generic>(path.color_write);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
