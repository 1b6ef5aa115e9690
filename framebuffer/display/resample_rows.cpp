#include "framebuffer/display/resample_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/display/resample_rows.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "framebuffer/display/display_lanes-inl.h"
#include "framebuffer/display/signal_to_light.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

constexpr int kBlockColumns = 16;

void resample_rows(const float* light, const ResampleTable& table, int row_count, float* rows,
                   std::ptrdiff_t row_stride) {
  const int pixels = static_cast<int>(table.first.size());
  alignas(64) float block[kBlockColumns][kBlockRows];
  for (int left = 0; left < pixels; left += kBlockColumns) {
    const int columns = std::min(kBlockColumns, pixels - left);
    for (int column = 0; column < columns; ++column) {
      const float* weights = table.weights_of(left + column);
      const float* samples =
          light +
          static_cast<std::ptrdiff_t>(table.first[static_cast<std::size_t>(left + column)]) * kBlockRows;
      for (int row = 0; row < kBlockRows; row += kFloatLanes) {
        FloatVec sum = splat(0);
        for (int tap = 0; tap < table.taps; ++tap)
          sum = mul_add(load(samples + tap * kBlockRows + row), splat(weights[tap]), sum);
        store(sum, block[column] + row);
      }
    }
    for (int row = 0; row < row_count; ++row) {
      float* out = rows + row * row_stride + left;
      for (int column = 0; column < columns; ++column) out[column] = block[column][row];
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

ResampleRowsFn* resample_rows_for(InstructionSet isa) { return TESSERA_KERNEL(isa, resample_rows); }

}  // namespace tessera::detail
#endif
