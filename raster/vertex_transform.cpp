// Plain loops over the arrays of a batch, which the compiler vectorizes for each instruction set. Every step
// is one correctly rounded IEEE operation, so all sets give the same bits. Highway transposes between rows
// and columns.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertex_transform.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "raster/exact_vertex.h"
#include "raster/vertex_transform.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// One matrix row times a point, in the order of operations of clip_position().
HWY_INLINE double row_times_point(const double* row, double x, double y, double z, double w) {
  return __builtin_fma(row[0], x, __builtin_fma(row[1], y, __builtin_fma(row[2], z, row[3] * w)));
}

HWY_INLINE double larger(double a, double b) { return a > b ? a : b; }

// Transposes rows of three floats into three arrays; elements from `count` on are 0.
HWY_NOINLINE void gather_rows(StridedFloats rows, std::size_t count, double* x, double* y, double* z) {
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

// Transposes positions into four arrays; w is 1 if it is not given.
HWY_INLINE void gather_positions(StridedFloats positions, int components, std::size_t count,
                                 PositionBatch& batch) {
  gather_rows(positions, count, batch.x, batch.y, batch.z);
  const auto w = [&](std::size_t i) HWY_ATTR { return components == 4 ? positions.at(i)[3] : 1.0f; };
  for (std::size_t i = 0; i < kVertexBatch; ++i) batch.w[i] = i >= count ? 0.0f : w(i);
}

HWY_INLINE void to_clip_space(const VertexTransform& t, const PositionBatch& p, PositionBatch& clip) {
  const double* m = t.clip_from_object;
  for (int i = 0; i < kVertexBatch; ++i) {
    clip.x[i] = row_times_point(m, p.x[i], p.y[i], p.z[i], p.w[i]);
    clip.y[i] = row_times_point(m + 4, p.x[i], p.y[i], p.z[i], p.w[i]);
    clip.z[i] = row_times_point(m + 8, p.x[i], p.y[i], p.z[i], p.w[i]);
    clip.w[i] = row_times_point(m + 12, p.x[i], p.y[i], p.z[i], p.w[i]);
  }
}

// Computes outcodes, and counts the tests of each vertex that rounding might decide (`inexact`). Outcodes are
// sums of their bits in doubles: loops vectorize if all elements have the same width.
HWY_INLINE void classify_vertices(const VertexTransform& t, const PositionBatch& p, const PositionBatch& clip,
                                  double (&outcode)[kVertexBatch], double (&inexact)[kVertexBatch]) {
  const auto bit = [](Outcode plane) HWY_ATTR { return static_cast<double>(std::uint8_t{plane}); };
  // Loops with branches do not vectorize: the direction of depth is a factor of 1, -1 or 0.
  const double near_of_z = t.reversed ? -1 : 1;
  const double far_of_z = -near_of_z;
  const double far_of_w = t.reversed ? 0 : 1;
  for (int i = 0; i < kVertexBatch; ++i) {
    const double cx = clip.x[i], cy = clip.y[i], cz = clip.z[i], cw = clip.w[i];
    const double gx = t.guard_x * cw, gy = t.guard_y * cw;
    const double near_z = __builtin_fma(near_of_z, cz, cw);
    const double far_z = __builtin_fma(far_of_z, cz, far_of_w * cw);
    const double probe = cx * 0 + cy * 0 + cz * 0 + cw * 0;  // NaN if one is not finite
    double c = cx < -gx ? bit(kLeftOfGuardBand) : 0.0;
    c += cx > gx ? bit(kRightOfGuardBand) : 0.0;
    c += cy < -gy ? bit(kBelowGuardBand) : 0.0;
    c += cy > gy ? bit(kAboveGuardBand) : 0.0;
    c += near_z < 0 ? bit(kBeforeNear) : 0.0;
    c += far_z < 0 ? bit(kBehindFar) : 0.0;
    c += cw > 0 ? 0.0 : bit(kNonPositiveW);
    c += probe == 0 ? 0.0 : bit(kNonFinite);
    outcode[i] = c;
    const double xyz = larger(larger(__builtin_fabs(p.x[i]), __builtin_fabs(p.y[i])), __builtin_fabs(p.z[i]));
    const double magnitude =
        __builtin_fma(t.max_row_norm_xyz, xyz, t.max_abs_translation * __builtin_fabs(p.w[i]));
    const double to_guard_x = __builtin_fabs(__builtin_fabs(gx) - __builtin_fabs(cx));
    const double to_guard_y = __builtin_fabs(__builtin_fabs(gy) - __builtin_fabs(cy));
    double n = __builtin_fabs(near_z) <= t.near_error * magnitude ? 1.0 : 0.0;
    n += __builtin_fabs(far_z) <= t.far_error * magnitude ? 1.0 : 0.0;
    n += to_guard_x <= t.guard_x_error * magnitude ? 1.0 : 0.0;
    n += to_guard_y <= t.guard_y_error * magnitude ? 1.0 : 0.0;
    n += __builtin_fabs(cw) <= t.w_error * magnitude ? 1.0 : 0.0;
    inexact[i] = n;
  }
}

// Repeats the transform of inexact vertices one by one.
HWY_INLINE void correct_inexact(const VertexTransform& t, const PositionBatch& p, std::size_t count,
                                const double (&inexact)[kVertexBatch], PositionBatch& clip,
                                double (&outcode)[kVertexBatch]) {
  std::int32_t any_inexact = 0;
  for (int i = 0; i < kVertexBatch; ++i) any_inexact |= static_cast<std::int32_t>(inexact[i]);
  for (std::size_t i = 0; any_inexact != 0 && i < count; ++i) {
    if (inexact[i] == 0) continue;
    const TransformedVertex exact =
        transform_vertex(t, {static_cast<float>(p.x[i]), static_cast<float>(p.y[i]),
                             static_cast<float>(p.z[i]), static_cast<float>(p.w[i])});
    clip.x[i] = exact.position.x;
    clip.y[i] = exact.position.y;
    clip.z[i] = exact.position.z;
    clip.w[i] = exact.position.w;
    outcode[i] = exact.outcode;
  }
}

struct WindowBatch {
  alignas(64) std::int32_t x[kVertexBatch], y[kVertexBatch];  // 1/256 pixel from the viewport's centre, y up
  alignas(64) float rw[kVertexBatch];                         // 1/w
  alignas(64) double depth[kVertexBatch];                     // 0..1
};

// Projects and snaps vertices without outcode; all others go to the viewport's centre.
HWY_INLINE void to_window_space(const VertexTransform& t, const PositionBatch& clip,
                                const double (&outcode)[kVertexBatch], WindowBatch& window) {
  const double unit_of_z = t.reversed ? 1 : 0.5;
  const double first_unit = t.reversed ? 0 : 0.5;
  for (int i = 0; i < kVertexBatch; ++i) {
    const double w = outcode[i] == 0 ? clip.w[i] : 1.0;
    const double x = outcode[i] == 0 ? clip.x[i] : 0.0, y = outcode[i] == 0 ? clip.y[i] : 0.0;
    const double z = outcode[i] == 0 ? clip.z[i] : 0.0;
    const double inverse_w = 1.0 / w;
    window.x[i] = static_cast<std::int32_t>(__builtin_floor(__builtin_fma(x / w * t.half_width, 256.0, 0.5)));
    window.y[i] =
        static_cast<std::int32_t>(__builtin_floor(__builtin_fma(y / w * t.half_height, 256.0, 0.5)));
    window.rw[i] = static_cast<float>(inverse_w);
    const double ranged =
        __builtin_fma(__builtin_fma(z / w, unit_of_z, first_unit), t.depth_far - t.depth_near, t.depth_near);
    const double at_least_zero = ranged > 0 ? ranged : 0;
    window.depth[i] = at_least_zero < 1 ? at_least_zero : 1;
  }
}

// Depth words (WindowVertex::z) of depths in 0..1.
HWY_INLINE void to_depth_words(DepthFormat kind, const double (&depth)[kVertexBatch],
                               std::uint32_t (&words)[kVertexBatch]) {
  if (kind == DepthFormat::float32) {
    for (int i = 0; i < kVertexBatch; ++i) {
      const float f = static_cast<float>(depth[i]);
      std::memcpy(&words[i], &f, sizeof f);
    }
  } else if (kind != DepthFormat::none) {
    const int bits = depth_bits(kind);
    const double levels = static_cast<double>((std::uint64_t{1} << bits) - 1);
    const double fraction = static_cast<double>(std::uint64_t{1} << (32 - bits));
    // Rounded to the nearest fraction of the same level: a depth in the middle of a level that rounding
    // errors have moved a little maps to that middle again.
    for (int i = 0; i < kVertexBatch; ++i) {
      const double level = depth[i] * levels + 0.5;
      const double nearest = __builtin_floor(level * fraction + 0.5);
      const double highest = __builtin_floor(level) * fraction + (fraction - 1);
      const double value = nearest < highest ? nearest : highest;
      words[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(value - 2147483648.0)) ^ 0x80000000u;
    }
  } else {
    for (int i = 0; i < kVertexBatch; ++i) words[i] = 0;
  }
}

// Transposes to rows; a partial batch goes through a buffer.
HWY_INLINE void store_vertices(const VertexTransform& t, const WindowBatch& window,
                               const std::uint32_t (&depth_words)[kVertexBatch], std::size_t count,
                               WindowVertex* vertices) {
  static_assert(offsetof(WindowVertex, x) == 0 && offsetof(WindowVertex, y) == 4 &&
                offsetof(WindowVertex, z) == 8 && offsetof(WindowVertex, rw) == 12);
  alignas(64) std::int32_t rest[4 * kVertexBatch];
  auto* const rows = count == kVertexBatch ? reinterpret_cast<std::int32_t*>(vertices) : rest;
  constexpr hn::ScalableTag<std::int32_t> ints;
  const auto center_x = hn::Set(ints, t.center_x), center_y = hn::Set(ints, t.center_y);
  for (std::size_t i = 0; i < kVertexBatch; i += hn::Lanes(ints))
    hn::StoreInterleaved4(
        hn::Add(center_x, hn::Load(ints, window.x + i)), hn::Sub(center_y, hn::Load(ints, window.y + i)),
        hn::Load(ints, reinterpret_cast<const std::int32_t*>(depth_words) + i),
        hn::BitCast(ints, hn::Load(hn::RebindToFloat<decltype(ints)>(), window.rw + i)), ints, rows + 4 * i);
  if (rows == rest) std::memcpy(vertices, rest, count * sizeof *vertices);
}

// Clip-space positions and outcodes of a batch.
HWY_INLINE void transform_batch(const VertexTransform& t, StridedFloats positions, int components,
                                std::size_t count, PositionBatch& clip, double (&outcode)[kVertexBatch]) {
  PositionBatch p;
  gather_positions(positions, components, count, p);
  to_clip_space(t, p, clip);
  alignas(64) double inexact[kVertexBatch];
  classify_vertices(t, p, clip, outcode, inexact);
  correct_inexact(t, p, count, inexact, clip, outcode);
}

// Window positions of a batch. Returns the bitwise or of the outcodes.
HWY_INLINE std::uint8_t place_batch(const VertexTransform& t, const PositionBatch& clip,
                                    const double (&outcode)[kVertexBatch], std::size_t count,
                                    WindowVertex* vertices, std::uint8_t* outcodes) {
  WindowBatch window;
  to_window_space(t, clip, outcode, window);
  alignas(64) std::uint32_t depth_words[kVertexBatch];
  to_depth_words(t.depth, window.depth, depth_words);
  store_vertices(t, window, depth_words, count, vertices);
  int all_outcodes = 0;
  alignas(64) std::int32_t bits[kVertexBatch];
  for (int i = 0; i < kVertexBatch; ++i) bits[i] = static_cast<std::int32_t>(outcode[i]);
  for (std::size_t i = 0; i < count; ++i) {
    outcodes[i] = static_cast<std::uint8_t>(bits[i]);
    all_outcodes |= bits[i];
  }
  return static_cast<std::uint8_t>(all_outcodes);
}

std::uint8_t transform_vertices_lanes(const VertexTransform& t, StridedFloats positions, int components,
                                      std::size_t count, WindowVertex* vertices, std::uint8_t* outcodes) {
  PositionBatch clip;
  alignas(64) double outcode[kVertexBatch];
  transform_batch(t, positions, components, count, clip, outcode);
  return place_batch(t, clip, outcode, count, vertices, outcodes);
}

void clip_positions_lanes(const VertexTransform& t, StridedFloats positions, int components,
                          std::size_t count, PositionBatch& clip) {
  alignas(64) double outcode[kVertexBatch];
  transform_batch(t, positions, components, count, clip, outcode);
}

std::uint8_t place_vertices_lanes(const VertexTransform& t, const PositionBatch& clip, std::size_t count,
                                  WindowVertex* vertices, std::uint8_t* outcodes) {
  alignas(64) double outcode[kVertexBatch], inexact[kVertexBatch];
  classify_vertices(t, clip, clip, outcode, inexact);
  return place_batch(t, clip, outcode, count, vertices, outcodes);
}

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

TransformVertices* transform_vertices(InstructionSet isa) {
  return TESSERA_KERNEL(isa, transform_vertices_lanes);
}
ClipPositions* clip_positions(InstructionSet isa) { return TESSERA_KERNEL(isa, clip_positions_lanes); }
PlaceVertices* place_vertices(InstructionSet isa) { return TESSERA_KERNEL(isa, place_vertices_lanes); }
EyePositions* eye_positions(InstructionSet isa) { return TESSERA_KERNEL(isa, eye_positions_lanes); }
EyeNormals* eye_normals(InstructionSet isa) { return TESSERA_KERNEL(isa, eye_normals_lanes); }

ClipPosition clip_position(const VertexTransform& t, double x, double y, double z, double w) {
  const auto row = [&](int r) {
    const double* m = t.clip_from_object + 4 * r;
    return std::fma(m[0], x, std::fma(m[1], y, std::fma(m[2], z, m[3] * w)));
  };
  return {row(0), row(1), row(2), row(3)};
}

std::uint8_t compute_outcode(const VertexTransform& t, const ClipPosition& p) {
  if (!is_finite(p)) return kNonFinite;
  std::uint8_t outcode = 0;
  if (p.x < -(t.guard_x * p.w)) outcode |= kLeftOfGuardBand;
  if (p.x > t.guard_x * p.w) outcode |= kRightOfGuardBand;
  if (p.y < -(t.guard_y * p.w)) outcode |= kBelowGuardBand;
  if (p.y > t.guard_y * p.w) outcode |= kAboveGuardBand;
  if ((t.reversed ? p.w - p.z : p.z + p.w) < 0) outcode |= kBeforeNear;
  if ((t.reversed ? p.z : p.w - p.z) < 0) outcode |= kBehindFar;
  if (!(p.w > 0)) outcode |= kNonPositiveW;
  return outcode;
}

// True if a row's product with any float vector is exact: at most one nonzero element, of at most 29 bits and
// far from the ends of the double range.
static bool is_exact(const double* row) {
  int terms = 0;
  for (int column = 0; column < 4; ++column) {
    const double magnitude = std::abs(row[column]);
    if (magnitude == 0) continue;
    ++terms;
    const bool has_29_bits = std::bit_cast<std::uint64_t>(magnitude) % (1 << 24) == 0;
    if (magnitude < 0x1p-800 || magnitude > 0x1p800 || !has_29_bits) return false;
  }
  return terms <= 1;
}

// Let u = 2^-53 and S the sum of the magnitudes of a coordinate's terms.
// - A coordinate has four roundings: its error is at most 4 u S.
// - A distance z + w has twice that error and one rounding; a distance from a guard plane has (1 + guard)
//   times the error of a coordinate. The bounds below, 2^-48 S and (1 + guard) 2^-49 S, are at least twice
//   these errors.
// - The distance of two exact coordinates has the right sign, and w - z is exactly 0 if the rows of z and w
// are
//   equal: no bound is needed.
// - For |w| > 2^-30 S the relative error of w is below 2^-20, which moves a visible vertex by at most 2^-20
// of
//   the guard band's width.
void VertexTransform::set_error_bounds() {
  const double* const m = clip_from_object;
  max_row_norm_xyz = max_abs_translation = 0;
  for (int row = 0; row < 16; row += 4) {
    max_row_norm_xyz =
        std::max(max_row_norm_xyz, std::abs(m[row]) + std::abs(m[row + 1]) + std::abs(m[row + 2]));
    max_abs_translation = std::max(max_abs_translation, std::abs(m[row + 3]));
  }
  constexpr double kDepthError = 0x1p-48;
  constexpr double kNoError = -1;
  const bool has_exact_z = is_exact(m + 8);
  const bool has_exact_zw = has_exact_z && is_exact(m + 12);
  const auto z_row_equals_w_row = [&](double sign) {
    return std::equal(m + 8, m + 12, m + 12, [sign](double z, double w) { return z == sign * w; });
  };
  near_error = has_exact_zw || z_row_equals_w_row(reversed ? 1 : -1) ? kNoError : kDepthError;
  far_error = has_exact_zw || (reversed ? has_exact_z : z_row_equals_w_row(1)) ? kNoError : kDepthError;
  guard_x_error = (1 + guard_x) * 0x1p-49;
  guard_y_error = (1 + guard_y) * 0x1p-49;
  w_error = 0x1p-30;
}

static bool needs_exact(const VertexTransform& t, const ClipPosition& p, double magnitude) {
  const double near_z = t.reversed ? p.w - p.z : p.z + p.w;
  const double far_z = t.reversed ? p.z : p.w - p.z;
  const double to_guard_x = t.guard_x * std::abs(p.w) - std::abs(p.x);
  const double to_guard_y = t.guard_y * std::abs(p.w) - std::abs(p.y);
  const bool is_depth_unsure =
      std::abs(near_z) <= t.near_error * magnitude || std::abs(far_z) <= t.far_error * magnitude;
  const bool is_guard_unsure = std::abs(to_guard_x) <= t.guard_x_error * magnitude ||
                               std::abs(to_guard_y) <= t.guard_y_error * magnitude;
  return is_depth_unsure || is_guard_unsure || std::abs(p.w) <= t.w_error * magnitude;
}

// True if doubles represent a position. A nonzero w, the divisor, must be a normal number.
static bool is_representable(const ClipPosition& p, bool has_w) {
  return is_finite(p) && (!has_w || std::abs(p.w) >= std::numeric_limits<double>::min());
}

TransformedVertex transform_vertex(const VertexTransform& t, const std::array<float, 4>& object) {
  TransformedVertex v{.position = clip_position(t, object[0], object[1], object[2], object[3])};
  v.outcode = compute_outcode(t, v.position);
  if (v.outcode == kNonFinite ||
      !needs_exact(t, v.position, t.term_magnitude(object[0], object[1], object[2], object[3])))
    return v;
  const double largest = std::max(
      {std::abs(v.position.x), std::abs(v.position.y), std::abs(v.position.z), std::abs(v.position.w)});
  // Scaled to about 1, no distance overflows unless its terms are 2^1000 times as large.
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  const ExactVertex exact(t, object, -exponent);
  const ClipPosition p = exact.position();
  const ClipPosition scaled{std::scalbn(p.x, exponent), std::scalbn(p.y, exponent),
                            std::scalbn(p.z, exponent), std::scalbn(p.w, exponent)};
  if (!is_representable(scaled, p.w != 0)) return v;
  return {.position = scaled, .outcode = exact.outcode(t), .needs_exact = true};
}

// Pixels relative to the viewport's centre -> 1/256 pixel, clamped to the guard band. A cut at the guard band
// is rounded relative to the largest coordinate of its edge; if w is much smaller, the point may lie far
// beyond the guard band.
static std::int32_t snapped(double pixels) {
  constexpr double kFarthest = kGuardBandPixels * kSubpixelScale;
  return static_cast<std::int32_t>(
      std::clamp(std::floor(std::fma(pixels, kSubpixelScale, 0.5)), -kFarthest, kFarthest));
}

WindowVertex project(const VertexTransform& t, const ClipPosition& p) {
  WindowVertex v;
  // Relative to the viewport's centre, so that moving the viewport by whole pixels moves every vertex
  // exactly.
  v.x = t.center_x + snapped(p.x / p.w * t.half_width);
  v.y = t.center_y - snapped(p.y / p.w * t.half_height);
  v.rw = static_cast<float>(1.0 / p.w);
  const double unit = t.reversed ? p.z / p.w : std::fma(p.z / p.w, 0.5, 0.5);
  const double ranged = std::fma(unit, t.depth_far - t.depth_near, t.depth_near);
  // NaN (an infinite quotient times an empty depth range) becomes 0.
  const double z = ranged > 0 ? std::min(ranged, 1.0) : 0;
  if (t.depth == DepthFormat::float32) {
    v.z = quantize_depth(DepthFormat::float32, z);
  } else if (t.depth != DepthFormat::none) {
    const int bits = depth_bits(t.depth);
    const double levels = std::ldexp(1.0, bits) - 1;
    const double fraction = std::ldexp(1.0, 32 - bits);
    const double level = z * levels + 0.5;
    v.z = static_cast<std::uint32_t>(static_cast<std::uint64_t>(
        std::min(std::floor(level * fraction + 0.5), std::floor(level) * fraction + (fraction - 1))));
  }
  return v;
}

}  // namespace tessera::detail
#endif
