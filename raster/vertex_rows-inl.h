// Loads of vertex attributes from rows into the arrays of a batch, and the product of a matrix row and a
// point. Included by kernels once per instruction set, see framebuffer/lanes.h.
#if defined(TESSERA_RASTER_VERTEX_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_RASTER_VERTEX_ROWS_INL_H_
#undef TESSERA_RASTER_VERTEX_ROWS_INL_H_
#else
#define TESSERA_RASTER_VERTEX_ROWS_INL_H_
#endif

#include <cstddef>

#include "raster/vertex_transform.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One matrix row times a point, in the order of operations of clip_position().
HWY_INLINE double row_times_point(const double* row, double x, double y, double z, double w) {
  return __builtin_fma(row[0], x, __builtin_fma(row[1], y, __builtin_fma(row[2], z, row[3] * w)));
}

/// Transposes rows of three floats into three arrays; elements from `count` on are 0.
inline HWY_NOINLINE void gather_rows(StridedFloats rows, std::size_t count, double* x, double* y, double* z) {
  if (rows.stride == 3 && count == kVertexBatch) {
    constexpr hn::ScalableTag<float> floats;
    alignas(64) float columns[3][kVertexBatch];
    for (std::size_t i = 0; i < kVertexBatch; i += hn::Lanes(floats)) {
      auto a = hn::Undefined(floats), b = a, c = a;
      hn::LoadInterleaved3(floats, rows.at(i), a, b, c);
      hn::Store(a, floats, columns[0] + i);
      hn::Store(b, floats, columns[1] + i);
      hn::Store(c, floats, columns[2] + i);
    }
    for (int i = 0; i < kVertexBatch; ++i) {
      x[i] = columns[0][i];
      y[i] = columns[1][i];
      z[i] = columns[2][i];
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float* const row = rows.at(i);
    x[i] = row[0];
    y[i] = row[1];
    z[i] = row[2];
  }
  for (std::size_t i = count; i < kVertexBatch; ++i) x[i] = y[i] = z[i] = 0;
}

/// Transposes positions into four arrays; w is 1 if it is not given.
HWY_INLINE void gather_positions(StridedFloats positions, int components, std::size_t count,
                                 PositionBatch& batch) {
  gather_rows(positions, count, batch.x, batch.y, batch.z);
  const auto w = [&](std::size_t i) HWY_ATTR { return components == 4 ? positions.at(i)[3] : 1.0f; };
  for (std::size_t i = 0; i < kVertexBatch; ++i) batch.w[i] = i >= count ? 0.0f : w(i);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
