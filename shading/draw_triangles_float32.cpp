// draw_triangles() with floating-point depth.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_triangles_float32.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

DrawGroupFunction triangles_function_float32(const PixelPath& path) {
  if (path.depth_test == DepthTestPath::less_write)
    return triangles_function_by_color<Float32Depth, DepthTestPath::less_write>(path.color_write);
  return triangles_function_by_color<Float32Depth, DepthTestPath::generic>(path.color_write);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
