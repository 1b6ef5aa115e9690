#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/raster/line_steps_lanes.cpp"
#include "framebuffer/lanes.h"

#include "raster/line_steps-inl.h"
#include "tests/raster/line_steps_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void pixels_of_lines_lanes(const TriangleGroup& lines, int width, const PixelRect& window,
                           std::vector<std::pair<int, int>> (&pixels)[kGroupSize]) {
  LineSteps steps;
  steps.set_up(lines, width);
  for (int i = 0; i < kGroupSize; ++i)
    steps.for_each(i, window, [&](Int x, Int y, auto inside) HWY_ATTR {
      alignas(64) std::int32_t columns[kLanes], rows[kLanes];
      hn::Store(x, kInt, columns);
      hn::Store(y, kInt, rows);
      const std::uint32_t bits = mask_bits(kInt, inside);
      for (int l = 0; l < kLanes; ++l)
        if ((bits >> l & 1) != 0) pixels[i].push_back({columns[l], rows[l]});
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
PixelsOfLines* pixels_of_lines(InstructionSet isa) { return TESSERA_KERNEL(isa, pixels_of_lines_lanes); }
}  // namespace tessera::test
#endif
