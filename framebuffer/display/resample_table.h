// Sparse linear maps from evenly spaced samples of light to the pixels of an image.
#pragma once

#include <functional>
#include <vector>

namespace tessera::detail {

/// Evenly spaced samples along an axis of the screen.
struct SampleGrid {
  int count;
  double center_mm;   ///< position of sample 0
  double spacing_mm;  ///< above 0
};

/// Pixels of the image along an axis of the screen.
struct PixelGrid {
  int count;
  double edge_mm;   ///< beginning of pixel 0
  double pitch_mm;  ///< above 0

  double center_mm(int pixel) const { return edge_mm + (pixel + 0.5) * pitch_mm; }
};

/// Light of a pixel: the sum over k of weight(pixel, k) times sample first[pixel] + k.
struct ResampleTable {
  int taps = 0;                ///< samples per pixel
  std::vector<int> first;      ///< per pixel; first + taps does not pass the last sample
  std::vector<float> weights;  ///< [pixel][tap]

  const float* weights_of(int pixel) const {
    return weights.data() + static_cast<std::size_t>(pixel) * static_cast<std::size_t>(taps);
  }
};

/// Light that a sample gives to a pixel, and how far it reaches.
struct SpreadFunction {
  /// Mean light of a pixel whose centre lies `distance_mm` right of a sample of light 1. Where all samples
  /// are 1, the sum is 1 on average.
  std::function<double(double distance_mm)> light;
  double reach_mm;  ///< light is 0 beyond this distance on both sides
};

ResampleTable make_resample_table(const SampleGrid& samples, const PixelGrid& pixels,
                                  const SpreadFunction& spread);

/// A Gaussian beam, averaged over pixels, and over `smoothing_mm` if above 0.
/// @param sigma_mm  standard deviation, above 0
SpreadFunction gaussian_spread(double sigma_mm, double spacing_mm, double pixel_mm, double smoothing_mm);

/// Samples that are held: each emits evenly over its spacing. Pixels average.
SpreadFunction held_spread(double spacing_mm, double pixel_mm);

}  // namespace tessera::detail
