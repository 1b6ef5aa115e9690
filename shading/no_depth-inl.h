// Replaces a depth type (raster/depth-inl.h) in draws without depth.
#if defined(TESSERA_SHADING_NO_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_NO_DEPTH_INL_H_
#undef TESSERA_SHADING_NO_DEPTH_INL_H_
#else
#define TESSERA_SHADING_NO_DEPTH_INL_H_
#endif

#include "raster/depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

struct NoDepth {
  struct Block {};
  HWY_INLINE Block block(int, int) const { return {}; }
  HWY_INLINE void step_right(Block&) const {}
  HWY_INLINE void set_up(const TriangleGroup&, int, int, int, DepthFormat) {}
  HWY_INLINE void prepare_blocks() {}
  struct SampleOrigin {};
  static HWY_INLINE SampleOrigin sample_origin(const TriangleGroup&, const SampleGroup&, int, int,
                                               SamplePosition, int, int) {
    return {};
  }
  HWY_INLINE Block step_to(int, int) const { return {}; }
};
template <class Depth>
inline constexpr bool kHasDepth = true;
template <>
inline constexpr bool kHasDepth<NoDepth> = false;

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
