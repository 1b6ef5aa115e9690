#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/line_depth_lanes.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/point_line_values-inl.h"
#include "tests/shading/line_depth_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

std::vector<std::int32_t> line_keys_lanes(DepthFormat kind, std::uint32_t z0, std::uint32_t z1,
                                          const std::vector<double>& parameters) {
  const LineDepth depth(kind, z0, z1, 0);
  std::vector<std::int32_t> keys(parameters.size());
  for (std::size_t first = 0; first < keys.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, keys.size() - first);
    alignas(64) double in[kLanes] = {};
    alignas(64) std::int32_t out[kLanes];
    std::copy_n(parameters.begin() + static_cast<std::ptrdiff_t>(first), count, in);
    hn::Store(depth.keys(each_part(
                  [&](int p) HWY_ATTR { return hn::Load(kDouble, in + p * kLanes / kDoubleParts); })),
              kInt, out);
    std::copy_n(out, count, keys.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return keys;
}

test::KeyPair point_keys_lanes(DepthFormat kind, std::uint32_t z, double offset) {
  return {point_key(kind, z, offset),
          hn::GetLane(LineDepth(kind, z, z, offset).keys(to_doubles(hn::Zero(kInt))))};
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
LineKeys* line_keys(InstructionSet isa) { return TESSERA_KERNEL(isa, line_keys_lanes); }
PointKeys* point_keys(InstructionSet isa) { return TESSERA_KERNEL(isa, point_keys_lanes); }
}  // namespace tessera::test
#endif
