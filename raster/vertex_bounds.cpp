#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertex_bounds.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "raster/vertex_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Four lanes per record, of which the last holds whatever follows its three floats. The last record may end
// the caller's memory, so only three of its floats are read.
bool find_bounds_lanes(StridedFloats values, std::size_t count, FloatBox& box) {
#if HWY_TARGET == HWY_SCALAR
  return find_bounds_reference(values, count, box);
#else
  constexpr hn::CappedTag<float, 4> four;
  alignas(16) float lanes[4] = {};
  std::copy_n(values.at(count - 1), 3, lanes);
  const auto zero = hn::Zero(four);
  auto low = hn::Load(four, lanes);
  auto high = low;
  auto probe = hn::Mul(low, zero);  // 0 times a value that is not finite is a NaN
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const auto value = hn::LoadU(four, values.at(i));
    low = hn::Min(low, value);
    high = hn::Max(high, value);
    probe = hn::MulAdd(value, zero, probe);
  }
  hn::Store(low, four, lanes);
  std::copy_n(lanes, 3, box.low.begin());
  hn::Store(high, four, lanes);
  std::copy_n(lanes, 3, box.high.begin());
  hn::Store(probe, four, lanes);
  return lanes[0] == 0 && lanes[1] == 0 && lanes[2] == 0;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {
FindBounds* find_bounds(InstructionSet isa) { return TESSERA_KERNEL(isa, find_bounds_lanes); }
}  // namespace tessera::detail
#endif
