// draw_triangles() without depth.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_triangles_no_depth.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

DrawGroupFunction triangles_function_no_depth(const PixelPath& path) {
  return triangles_function_by_color<NoDepth, DepthTestPath::generic>(path.color_write);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
