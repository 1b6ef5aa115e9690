// Design of symmetric FIR filters.
#pragma once

#include <cstddef>
#include <vector>

namespace tessera::detail {

/// Filter of odd length: output k is the sum of tap(j) * input[k + j] for j from -radius to radius.
/// Symmetric, so that it delays no frequency; its gain at frequency 0 is 1. Frequencies are in cycles per
/// sample.
struct SymmetricFilter {
  std::vector<double> half{1};  ///< taps from the centre on

  int radius() const { return static_cast<int>(half.size()) - 1; }
  double tap(int j) const { return half[static_cast<std::size_t>(j < 0 ? -j : j)]; }
  /// Amplitude of the output for a sine of amplitude 1.
  double response(double frequency) const;
};

/// Gaussian of which `bandwidth` passes with 0.707 of its amplitude (-3 dB).
/// - Taps reach to four standard deviations.
/// - Above 0.12, the sampled Gaussian is wider: by 1 % at 0.2.
SymmetricFilter gaussian_low_pass(double bandwidth);

/// Product of a sinc and a Hamming window, of which `bandwidth` passes with half of its amplitude (-6 dB).
/// - Passes 0.99 to 1.01 below bandwidth - d and less than 0.01 above bandwidth + d; d = 1.65 / (2 radius +
/// 1).
/// - From 1/2 on, every frequency passes.
SymmetricFilter sinc_low_pass(double bandwidth, int radius);

/// The filter plus multiples of itself, shifted to the frequencies 1/4 and 1/2, so that both are blocked. In
/// a demodulator at a quarter of the sampling rate, this removes constant luma and the image at twice the
/// subcarrier.
SymmetricFilter without_quarter_frequencies(const SymmetricFilter& filter);

/// Taps of a filter whose other taps are 0: output k is the sum of taps[i] * input[k + first + i * step].
struct FilterTaps {
  int first = 0;
  int step = 1;
  std::vector<float> taps;
};

FilterTaps all_taps(const SymmetricFilter& filter);
/// 2 tap(j) cos(90 j degrees): the band around 1/4 cycle per sample.
FilterTaps band_pass_taps(const SymmetricFilter& low_pass);
/// 2 tap(j) sin(90 j degrees): the same band, each frequency a quarter cycle later.
FilterTaps quadrature_taps(const SymmetricFilter& low_pass);

}  // namespace tessera::detail
