// What is linear along a line: depth keys and colours of the pixels it covers. Beyond the ends, where pixels of wide lines are, too [GL 2.1, 3.4.1].
#if defined(TESSERA_SHADING_POINT_LINE_VALUES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#undef TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#else
#define TESSERA_SHADING_POINT_LINE_VALUES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "framebuffer/format.h"
#include "raster/line_walk.h"
#include "shading/tile_run-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

// Loops over a line's pixels have no branch and come in eights where there are vectors, so that the compiler makes such of them. No sum of theirs is fused: it
// is the same everywhere.
inline constexpr int kLinePixels = 16, kPixelsAtOnce = kLanes < 8 ? 1 : 8;
template <class Pixel>
HWY_INLINE void for_pixels(int count, const Pixel& pixel) {
  for (int first = 0; first < count; first += kPixelsAtOnce)
    for (int l = 0; l < kPixelsAtOnce; ++l) pixel(first + l);
}

/// Depth in units of what is stored: levels, or floats.
class LineDepth {
 public:
  /// @param z0, z1  depth words of the vertices (raster/fixed_point.h)
  /// @param offset  in units of depth words (unorm) or of depth
  HWY_INLINE LineDepth(DepthKind kind, std::uint32_t z0, std::uint32_t z1, double offset) : kind_(kind) {
    if (kind == DepthKind::float32) {
      first_ = std::bit_cast<float>(z0) + offset;
      change_ = double{std::bit_cast<float>(z1)} - std::bit_cast<float>(z0);
      return;
    }
    // Words of 16 and 24 bits carry the half that rounds the level.
    const double scale = kind == DepthKind::unorm16 ? 0x1p-16 : kind == DepthKind::unorm24 ? 0x1p-8 : 1;
    first_ = scale * (z0 + (offset != 0 ? std::floor(std::clamp(offset, -0x1p32, 0x1p32) + 0.5) : 0));
    change_ = scale * (static_cast<double>(z1) - z0);
    most_ = scale * 4294967295.0;
    if (kind == DepthKind::unorm32) first_ += 0.5;
  }

  /// The keys where the line has come as far as `t` of its length; no depth leaves 0..1.
  HWY_INLINE void keys(int count, const double* t, std::int32_t* keys) const {
    const double first = first_, change = change_, most = most_;
    if (kind_ == DepthKind::float32)
      for_pixels(count, [&](int l) HWY_ATTR { keys[l] = std::bit_cast<std::int32_t>(static_cast<float>(std::clamp(first + t[l] * change, 0.0, 1.0)) + 0.0f); });
    else if (kind_ == DepthKind::unorm32)
      for_pixels(count, [&](int l) HWY_ATTR { keys[l] = static_cast<std::int32_t>(std::floor(std::clamp(first + t[l] * change, 0.0, most)) - 0x1p31); });
    else
      for_pixels(count, [&](int l) HWY_ATTR { keys[l] = static_cast<std::int32_t>(std::clamp(first + t[l] * change, 0.0, most)); });
  }

  /// Of a point.
  HWY_INLINE std::int32_t first_key() const {
    alignas(64) const double t[kPixelsAtOnce] = {};
    alignas(64) std::int32_t key[kPixelsAtOnce];
    keys(1, t, key);
    return key[0];
  }

 private:
  DepthKind kind_;
  double first_, change_, most_ = 1;
};

/// Pixels that a line covers.
struct LinePixels {
  int count = 0;
  alignas(64) std::int32_t x[kLinePixels] = {}, y[kLinePixels] = {};  // tile-relative
};

/// Where pixels stand along a line. What lies aside has the values of where it is projected onto the line; a point is the same everywhere.
struct LineValues {
  std::int32_t first_x, first_y;  // from the first vertex to the tile's first pixel centre, 1/256 pixel
  double dx, dy, per_squared_length;
  LineDepth depth;

  /// Of the first vertex of element i to the one `second`: 1 of a line, 0 of a point.
  HWY_INLINE LineValues(const TileRun& run, int i, int second, double depth_offset)
      : depth(run.frame.depth_kind, run.memory.group.z[0][i], run.memory.group.z[second][i], depth_offset) {
    const TriangleGroup& g = run.memory.group;
    first_x = run.tile_x * kSubpixelScale + kHalfPixel - g.x[0][i];
    first_y = run.tile_y * kSubpixelScale + kHalfPixel - g.y[0][i];
    dx = g.x[second][i] - g.x[0][i];
    dy = g.y[second][i] - g.y[0][i];
    const double squared_length = dx * dx + dy * dy;
    per_squared_length = squared_length > 0 ? 1 / squared_length : 0;
  }
  /// Equation 3.5, of pixels whose centres are moved by `by`.
  HWY_INLINE void parameters(const LinePixels& pixels, double* t, SamplePosition by = {}) const {
    const std::int32_t from_x = first_x + by.x, from_y = first_y + by.y;
    const double along_x = dx, along_y = dy, per = per_squared_length;
    for_pixels(pixels.count, [&](int l) HWY_ATTR { t[l] = (along_x * (pixels.x[l] * kSubpixelScale + from_x) + along_y * (pixels.y[l] * kSubpixelScale + from_y)) * per; });
  }
};

/// The ends' 1/w as parts of the larger one; equal where that leaves the numbers' range (as of triangles: raster/triangle_setup-inl.h).
struct RelativeRw {
  float of[2] = {1, 1};

  HWY_INLINE RelativeRw(const TriangleGroup& g, int i, int second) {
    const float a = g.rw[0][i], b = g.rw[second][i], largest = a > b ? a : b;
    if (a == b || !(largest > 0x1p-120f && largest < 0x1p120f)) return;
    of[0] = a / largest;
    of[1] = b / largest;
  }
  HWY_INLINE bool equal() const { return of[0] == of[1]; }
};

/// Colours of an RGB buffer, interpolated along a line.
struct LineColors {
  float first[3], change[3], most[3], rw[2];
  int shift[3];

  HWY_INLINE void set_up(const TileRun& run, const TileDraw& draw, int i, bool back) {
    const ColorLayout& layout = run.frame.layout;
    const int bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits}, shifts[3] = {layout.r_shift(), layout.g_shift(), 0};
    for (int c = 0; c < 3; ++c) {
      const int attribute = draw.color_attribute[back ? 1 : 0] + c;
      first[c] = run.memory.attributes[0][i][attribute];
      change[c] = run.memory.attributes[1][i][attribute] - first[c];
      most[c] = static_cast<float>((1 << bits[c]) - 1);
      shift[c] = shifts[c];
    }
    const RelativeRw relative(run.memory.group, i, 1);
    for (int k = 0; k < 2; ++k) rw[k] = relative.of[k];
  }
  /// Equation 3.6
  HWY_INLINE void words(int count, const double* parameters, std::uint32_t* words) const {
    alignas(64) float t[kLinePixels];
    const float rw0 = rw[0], rw1 = rw[1];
    for_pixels(count, [&](int l) HWY_ATTR { t[l] = static_cast<float>(parameters[l]); });
    if (rw0 != rw1)
      for_pixels(count, [&](int l) HWY_ATTR {
        const float sum = (1 - t[l]) * rw0 + t[l] * rw1, corrected = t[l] * rw1 / sum;
        t[l] = sum != 0 ? corrected : t[l];
      });
    for (int c = 0; c < 3; ++c) {
      const float from = first[c], by = change[c], levels = most[c];
      const int place = shift[c];
      for_pixels(count, [&](int l) HWY_ATTR {
        const float x = std::fma(t[l], by, from), above = x > 0 ? x : 0.0f;  // a NaN is 0
        const auto level = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::fma(above < 1 ? above : 1.0f, levels, 0.5f)));
        words[l] = (c == 0 ? 0 : words[l]) | level << place;
      });
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
