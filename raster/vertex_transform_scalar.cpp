// The transform of one vertex: the scalar twin of the kernels in vertex_transform.cpp, and the bounds of
// their rounding errors.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "raster/exact_vertex.h"
#include "raster/vertex_transform.h"

namespace tessera::detail {

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
//   are equal: no bound is needed.
// - For |w| > 2^-30 S the relative error of w is below 2^-20, which moves a visible vertex by at most 2^-20
//   of the guard band's width.
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
