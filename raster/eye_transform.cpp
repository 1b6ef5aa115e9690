// Plain loops over the arrays of a batch, as in vertex_transform.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/eye_transform.cpp"
#include "framebuffer/lanes.h"

#include <cstddef>

#include "raster/eye_transform.h"
#include "raster/vertex_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void eye_positions_lanes(const EyeTransform& t, StridedFloats positions, int components, std::size_t count,
                         float* x, float* y, float* z) {
  PositionBatch p;
  gather_positions(positions, components, count, p);
  const double* m = t.eye_from_object;
  for (int i = 0; i < kVertexBatch; ++i) {
    const double px = p.x[i], py = p.y[i], pz = p.z[i], pw = p.w[i];
    const double w = row_times_point(m + 12, px, py, pz, pw);
    p.x[i] = row_times_point(m, px, py, pz, pw);
    p.y[i] = row_times_point(m + 4, px, py, pz, pw);
    p.z[i] = row_times_point(m + 8, px, py, pz, pw);
    p.w[i] = w != 0 ? w : 1.0;
  }
  const bool keeps_w = m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
  if (components == 4 || !keeps_w)  // otherwise w is 1
    for (int i = 0; i < kVertexBatch; ++i) {
      p.x[i] /= p.w[i];
      p.y[i] /= p.w[i];
      p.z[i] /= p.w[i];
    }
  for (int i = 0; i < kVertexBatch; ++i) {
    x[i] = static_cast<float>(p.x[i]);
    y[i] = static_cast<float>(p.y[i]);
    z[i] = static_cast<float>(p.z[i]);
  }
}

void eye_normals_lanes(const EyeTransform& t, StridedFloats normals, std::size_t count, float* x, float* y,
                       float* z) {
  alignas(64) double nx[kVertexBatch], ny[kVertexBatch], nz[kVertexBatch];
  gather_rows(normals, count, nx, ny, nz);
  const double* m = t.normal_matrix;
  const auto for_each_eye_normal = [&](const auto& store) HWY_ATTR {
    for (int i = 0; i < kVertexBatch; ++i) {
      const double ex = __builtin_fma(m[0], nx[i], __builtin_fma(m[1], ny[i], m[2] * nz[i]));
      const double ey = __builtin_fma(m[3], nx[i], __builtin_fma(m[4], ny[i], m[5] * nz[i]));
      const double ez = __builtin_fma(m[6], nx[i], __builtin_fma(m[7], ny[i], m[8] * nz[i]));
      store(i, ex, ey, ez);
    }
  };
  const auto [shortest, longest] = t.normal_lengths;
  if (shortest == 0) {
    for_each_eye_normal([&](int i, double ex, double ey, double ez) HWY_ATTR {
      x[i] = static_cast<float>(ex);
      y[i] = static_cast<float>(ey);
      z[i] = static_cast<float>(ez);
    });
    return;
  }
  const double min_squared = shortest * shortest, max_squared = longest * longest;
  const double per_shortest = 1 / shortest, per_longest = 1 / longest;
  for_each_eye_normal([&](int i, double ex, double ey, double ez) HWY_ATTR {
    const double squared = __builtin_fma(ex, ex, __builtin_fma(ey, ey, ez * ez));
    const bool is_short = squared > 0 && squared < min_squared;
    const bool is_long = squared > max_squared;
    const double per_limit = is_short ? per_shortest : per_longest;
    const double length = is_short || is_long ? __builtin_sqrt(squared) * per_limit : 1.0;
    x[i] = static_cast<float>(ex / length);
    y[i] = static_cast<float>(ey / length);
    z[i] = static_cast<float>(ez / length);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

EyePositions* eye_positions(InstructionSet isa) { return TESSERA_KERNEL(isa, eye_positions_lanes); }
EyeNormals* eye_normals(InstructionSet isa) { return TESSERA_KERNEL(isa, eye_normals_lanes); }

}  // namespace tessera::detail
#endif
