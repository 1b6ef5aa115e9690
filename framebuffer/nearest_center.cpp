#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/nearest_center.cpp"
#include "framebuffer/lanes.h"

// foreach_target.h includes this file once per instruction set
#include <cstddef>
#include <cstdint>

#include "framebuffer/check.h"
#include "framebuffer/nearest_center.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of points at a time against all centres.
void nearest_centers_lanes(const ColorPoints& points, const ColorPoints& centers, NearestCenters& result) {
  const hn::CappedTag<float, ColorPoints::kPadding> df;
  const hn::RebindToSigned<decltype(df)> di;
  const hn::RebindToUnsigned<decltype(df)> du;
  const float* const center_l = centers.l.data();
  const float* const center_a = centers.a.data();
  const float* const center_b = centers.b.data();
  const auto center_count = static_cast<std::int32_t>(centers.count);
  for (std::size_t i = 0; i < points.padded_size(); i += hn::Lanes(df)) {
    const auto l = hn::LoadU(df, points.l.data() + i);
    const auto a = hn::LoadU(df, points.a.data() + i);
    const auto b = hn::LoadU(df, points.b.data() + i);
    auto nearest = hn::Zero(di);
    auto nearest_distance = hn::Set(df, 1e30f);  // exceeds every distance
    for (std::int32_t k = 0; k < center_count; ++k) {
      const auto dl = hn::Sub(l, hn::Set(df, center_l[k]));
      const auto da = hn::Sub(a, hn::Set(df, center_a[k]));
      const auto db = hn::Sub(b, hn::Set(df, center_b[k]));
      const auto distance = hn::Add(hn::Add(hn::Mul(dl, dl), hn::Mul(da, da)), hn::Mul(db, db));
      const auto nearer = hn::Lt(distance, nearest_distance);
      nearest_distance = hn::IfThenElse(nearer, distance, nearest_distance);
      nearest = hn::IfThenElse(hn::RebindMask(di, nearer), hn::Set(di, k), nearest);
    }
    hn::StoreU(hn::BitCast(du, nearest), du, result.center.data() + i);
    hn::StoreU(nearest_distance, df, result.squared_distance.data() + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

void nearest_centers(const ColorPoints& points, const ColorPoints& centers, InstructionSet isa,
                     NearestCenters& result) {
  TESSERA_ASSERT(centers.count > 0);
  result.center.resize(points.padded_size());
  result.squared_distance.resize(points.padded_size());
  (TESSERA_KERNEL(isa, nearest_centers_lanes))(points, centers, result);
}

}  // namespace tessera::detail
#endif
