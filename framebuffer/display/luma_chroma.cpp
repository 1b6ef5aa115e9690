// Luma and colour differences: YUV, YIQ, PhotoYCC.
#include <algorithm>
#include <cmath>

#include "framebuffer/tessera/color.hpp"
#include "framebuffer/trigonometry.h"

namespace tessera {
namespace {

/// Rows Y', B' - Y' and R' - Y' of R'G'B'.
constexpr ColorMatrix color_differences(const ColorValues& luma) {
  const auto [r, g, b] = luma;
  return {{{{r, g, b}, {-r, -g, 1 - b}, {1 - r, -g, -b}}}};
}
constexpr ColorMatrix kDifferences = color_differences({.299, .587, .114});  // [SMPTE 170M; ITU-R BT.601]

/// A matrix and its inverse.
struct Transform {
  ColorMatrix forward;
  ColorMatrix backward = inverse(forward);
};

// U and V keep the composite signal of saturated colours within -1/3 and 4/3 [SMPTE 170M].
constexpr ColorMatrix kYuvFromDifferences{{{{1, 0, 0}, {0, .492111, 0}, {0, 0, .877283}}}};

const Transform& yuv_transform() {
  static const Transform transform{kYuvFromDifferences * kDifferences};
  return transform;
}

const Transform& yiq_transform() {
  static const Transform transform = [] {
    const auto [sine, cosine] = detail::sine_cosine(33);
    const ColorMatrix yiq_from_yuv{{{{1, 0, 0}, {0, -sine, cosine}, {0, cosine, sine}}}};
    return Transform{yiq_from_yuv * kYuvFromDifferences * kDifferences};
  }();
  return transform;
}

// [FCC rules, 1953, 3.682]
const Transform& yiq_1953_transform() {
  constexpr ColorMatrix kYiqFromDifferences{{{{1, 0, 0}, {0, -.27, .74}, {0, .41, .48}}}};
  static const Transform transform{kYiqFromDifferences * color_differences({.30, .59, .11})};
  return transform;
}

const Transform& photo_ycc_transform() {
  static const Transform transform{kDifferences};
  return transform;
}

// 8-bit codes: scale times the value plus an offset. Y reaches 1.402, in highlights above white.
constexpr ColorValues kCodeScale{255 / 1.402, 111.40, 135.64};
constexpr ColorValues kCodeOffset{0, 156, 137};

}  // namespace

ColorValues yuv_from_rgb(const ColorValues& rgb) { return yuv_transform().forward * rgb; }
ColorValues rgb_from_yuv(const ColorValues& yuv) { return yuv_transform().backward * yuv; }

ColorValues yiq_from_rgb(const ColorValues& rgb) { return yiq_transform().forward * rgb; }
ColorValues rgb_from_yiq(const ColorValues& yiq) { return yiq_transform().backward * yiq; }

ColorValues yiq_1953_from_rgb(const ColorValues& rgb) { return yiq_1953_transform().forward * rgb; }
ColorValues rgb_from_yiq_1953(const ColorValues& yiq) { return yiq_1953_transform().backward * yiq; }

ColorValues photo_ycc_from_rgb(const ColorValues& rgb) { return photo_ycc_transform().forward * rgb; }
ColorValues rgb_from_photo_ycc(const ColorValues& ycc) { return photo_ycc_transform().backward * ycc; }

ColorValues photo_ycc_8bit_from_photo_ycc(const ColorValues& ycc) {
  ColorValues code{};
  for (std::size_t i = 0; i < 3; ++i)
    code[i] = std::clamp(std::floor(kCodeScale[i] * ycc[i] + kCodeOffset[i] + 0.5), 0.0, 255.0);
  return code;
}
ColorValues photo_ycc_from_photo_ycc_8bit(const ColorValues& code) {
  ColorValues ycc{};
  for (std::size_t i = 0; i < 3; ++i) ycc[i] = (code[i] - kCodeOffset[i]) / kCodeScale[i];
  return ycc;
}

ColorValues photo_cd_display_levels(const ColorValues& code) {
  return rgb_from_photo_ycc(
      {1.3584 * code[0], 2.2179 * (code[1] - kCodeOffset[1]), 1.8215 * (code[2] - kCodeOffset[2])});
}

}  // namespace tessera
