// Depth keys and parameters of pixels along a line, also beyond its ends, where wide lines have pixels
// [GL 2.1, 3.4.1].
#if defined(TESSERA_SHADING_POINT_LINE_VALUES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#undef TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#else
#define TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "framebuffer/check.h"
#include "framebuffer/format.h"
#include "raster/double_lanes-inl.h"
#include "raster/sample_positions.h"
#include "shading/fragment_ops-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// An offset in whole units of depth words, clamped to +-2^32.
HWY_INLINE double whole_offset(double offset) {
  return offset != 0 ? std::floor(std::clamp(offset, -0x1p32, 0x1p32) + 0.5) : 0;
}

/// Depth along a line, in stored units: levels, or floats.
class LineDepth {
 public:
  /// @param z0, z1  depth words of the vertices (raster/fixed_point.h)
  /// @param offset  in units of depth words (unorm) or of depth
  HWY_INLINE LineDepth(DepthFormat kind, std::uint32_t z0, std::uint32_t z1, double offset) : kind_(kind) {
    if (kind == DepthFormat::float32) {
      first_ = std::bit_cast<float>(z0) + offset;
      change_ = double{std::bit_cast<float>(z1)} - std::bit_cast<float>(z0);
      return;
    }
    // Depth words of 16 and 24 bits include the half that rounds the level.
    double scale = 1;
    if (kind == DepthFormat::unorm16) scale = 0x1p-16;
    else if (kind == DepthFormat::unorm24) scale = 0x1p-8;
    first_ = scale * (z0 + whole_offset(offset));
    change_ = scale * (static_cast<double>(z1) - z0);
    max_depth_ = scale * 4294967295.0;
    if (kind == DepthFormat::unorm32) first_ += 0.5;
  }

  /// Depth keys at the fraction `t` of the line's length, clamped to depth 0..1.
  HWY_INLINE Int keys(const Doubles& t) const {
    const Doubles depth = clamped(plus(times(t, change_), first_), 0, max_depth_);
    if (kind_ == DepthFormat::float32) return hn::BitCast(kInt, hn::Add(to_floats(depth), hn::Zero(kFloat)));
    return kind_ == DepthFormat::unorm32 ? truncate(plus(floor(depth), -0x1p31)) : truncate(depth);
  }

 private:
  DepthFormat kind_;
  double first_, change_, max_depth_ = 1;
};

/// Depth key of a point: LineDepth at the first vertex, without lanes.
/// @pre there is depth, and the offset is a number
HWY_INLINE std::int32_t point_key(DepthFormat kind, std::uint32_t z, double offset) {
  TESSERA_ASSERT(kind != DepthFormat::none && !std::isnan(offset));
  if (kind == DepthFormat::float32)
    return std::bit_cast<std::int32_t>(
        static_cast<float>(std::clamp(std::bit_cast<float>(z) + offset, 0.0, 1.0)) + 0.0f);
  const auto word = static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(z + static_cast<std::int64_t>(whole_offset(offset)), 0, 0xffffffff));
  return depth_key_from_stored(kind, word >> (32 - depth_bits(kind)));
}

/// Positions of pixels along a line, onto which pixels are projected. All pixels of a point have its values.
struct LineValues {
  std::int32_t first_x, first_y;  // from the first vertex to the tile's first pixel centre, 1/256 pixel
  double dx, dy, per_squared_length;
  LineDepth depth;

  /// @param second  the other end of element i: vertex 1 of a line, 0 of a point
  HWY_INLINE LineValues(const TileContext& context, int i, int second, double depth_offset)
      : depth(context.frame.depth_format, context.memory.group.z[0][i], context.memory.group.z[second][i],
              depth_offset) {
    const TriangleGroup& g = context.memory.group;
    first_x = context.tile_x * kSubpixelScale + kHalfPixel - g.x[0][i];
    first_y = context.tile_y * kSubpixelScale + kHalfPixel - g.y[0][i];
    dx = g.x[second][i] - g.x[0][i];
    dy = g.y[second][i] - g.y[0][i];
    const double squared_length = dx * dx + dy * dy;
    per_squared_length = squared_length > 0 ? 1 / squared_length : 0;
  }
  /// [GL 2.1, equation 3.5] at the centres of the tile's pixels, moved by `by`.
  HWY_INLINE Doubles parameters(Int x, Int y, SamplePosition by = {}) const {
    const auto from_first = [](Int pixel, std::int32_t first) HWY_ATTR {
      return to_doubles(hn::Add(hn::ShiftLeft<kSubpixelBits>(pixel), splat(first)));
    };
    return times(plus(times(from_first(x, first_x + by.x), dx), times(from_first(y, first_y + by.y), dy)),
                 per_squared_length);
  }
};

/// 1/w of both ends relative to the larger one. Both are 1 if the larger one is out of range, as for
/// triangles (raster/triangle_setup-inl.h).
struct RelativeRw {
  float of[2] = {1, 1};

  HWY_INLINE RelativeRw(const TriangleGroup& g, int i, int second) {
    const float a = g.rw[0][i], b = g.rw[second][i];
    const float largest = a > b ? a : b;
    const bool in_range = largest > 0x1p-120f && largest < 0x1p120f;
    if (a == b || !in_range) return;
    of[0] = a / largest;
    of[1] = b / largest;
  }
  HWY_INLINE bool equal() const { return of[0] == of[1]; }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
