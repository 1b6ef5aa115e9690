// Plain loops over the arrays of a batch, which the compiler vectorizes for each instruction set. Every step
// is one correctly rounded IEEE operation, so all sets give the same bits. Highway transposes between rows
// and columns.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertex_transform.cpp"
#include "framebuffer/lanes.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raster/vertex_rows-inl.h"
#include "raster/vertex_transform.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

HWY_INLINE double larger(double a, double b) { return a > b ? a : b; }

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

}  // namespace tessera::detail
#endif
