#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/raster/selection_lanes.cpp"
#include "framebuffer/lanes.h"

#include "raster/lanes-inl.h"
#include "tests/raster/selection_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void select_lanes(const float* a, const float* b, float* greater, float* lesser, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Float x = hn::LoadU(kFloat, a + i), y = hn::LoadU(kFloat, b + i);
    hn::StoreU(greater_of(x, y), kFloat, greater + i);
    hn::StoreU(lesser_of(x, y), kFloat, lesser + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
Select* select(InstructionSet isa) { return TESSERA_KERNEL(isa, select_lanes); }
}  // namespace tessera::test
#endif
