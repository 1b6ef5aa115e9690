// Weighted points in OKLab: the input of clustering.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "framebuffer/color_counts.h"
#include "framebuffer/oklab.h"

namespace tessera::detail {

// Distances between points double a and b: plain OKLab underestimates differences of chroma. This is the
// scale of the CSS Working Group's deltaEOK2; FLIP's errors of dithered pictures are 4 % (16 entries) to 7 %
// (256) smaller.
inline constexpr float kChromaScale = 2;
constexpr double squared_point_distance(const Oklab& x, const Oklab& y) noexcept {
  const double dl = x.l - y.l, da = kChromaScale * (x.a - y.a), db = kChromaScale * (x.b - y.b);
  return dl * dl + da * da + db * db;
}

/// Arrays of points, padded for kernels with points of weight 0.
/// - Weights of colours of a picture: pixels^1.5. Least squares alone would give too many entries to few
///   pixels: in a plane, entries per colour follow the square root of the weight, while the mean of a less
///   steep error, FLIP's distance^0.7, asks for the weight to the power 2 / 2.7 (A. Gersho, Asymptotically
///   optimal block quantization, 1979).
struct ColorPoints {
  static constexpr std::size_t kPadding = 16;  ///< array sizes are multiples of this, the widest vector

  ColorPoints() = default;
  explicit ColorPoints(std::span<const WeightedColor> colors) : count(colors.size()) {
    reserve_padded();
    for (std::size_t i = 0; i < count; ++i) {
      set(i, oklab_from_rgb8(colors[i].color));
      const auto pixels = static_cast<double>(colors[i].pixels);
      weight[i] = pixels * std::sqrt(pixels);
    }
  }
  /// Points of weight 1.
  explicit ColorPoints(std::span<const Oklab> colors) : count(colors.size()) {
    reserve_padded();
    for (std::size_t i = 0; i < count; ++i) {
      set(i, colors[i]);
      weight[i] = 1;
    }
  }

  std::size_t padded_size() const noexcept { return l.size(); }
  Oklab operator[](std::size_t i) const noexcept { return {l[i], a[i] / kChromaScale, b[i] / kChromaScale}; }

  std::size_t count = 0;       ///< without padding
  std::vector<float> l, a, b;  ///< a and b times kChromaScale
  std::vector<double> weight;

 private:
  void reserve_padded() {
    const std::size_t size = (count + kPadding - 1) / kPadding * kPadding;
    for (std::vector<float>* array : {&l, &a, &b}) array->resize(size);
    weight.resize(size);
  }
  void set(std::size_t i, const Oklab& color) noexcept {
    l[i] = static_cast<float>(color.l);
    a[i] = kChromaScale * static_cast<float>(color.a);
    b[i] = kChromaScale * static_cast<float>(color.b);
  }
};

}  // namespace tessera::detail
