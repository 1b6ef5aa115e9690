// Inner loops of the television encoder and decoder. Lanes are neighbouring samples; each sample is computed
// by the same operations in the same order on every instruction set.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/display/low_pass.h"
#include "framebuffer/display/subcarrier.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// The kernels compute multiples of this number of samples.
inline constexpr int kSampleGroup = 64;

constexpr int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

/// Means of pixels over samples: sample k is the sum of weights[t * count + k] * pixel[first[k] + t] for t
/// below `taps`.
struct PixelAreas {
  int count = 0;  ///< samples, a multiple of kSampleGroup
  int taps = 0;
  std::vector<std::int32_t> first;
  std::vector<float> weights;
};

/// Luma and colour differences.
struct YuvPointers {
  float *y, *u, *v;
};
struct ConstYuvPointers {
  const float *y, *u, *v;
};
struct RgbPointers {
  float *r, *g, *b;
};

/// Counts are multiples of kSampleGroup. Arrays with a Subcarrier begin at a multiple of four samples.
struct TelevisionKernels {
  /// Samples of y, u and v.
  void (*average_pixels)(const ConstYuvPointers& pixels, const PixelAreas& areas, const YuvPointers& samples);
  /// FIR filter: out[k] depends on samples[k + taps.first] and later ones.
  void (*filter)(const float* samples, const FilterTaps& taps, float* out, int count);
  /// y + u * carrier of U + v * carrier of V
  void (*modulate)(const ConstYuvPointers& line, const Subcarrier& carrier, float* out, int count);
  /// Colour differences of the chroma band.
  /// @param quadrature  the same band, filtered by quadrature_taps()
  void (*demodulate)(const float* band, const float* quadrature, const Subcarrier& carrier, float* u,
                     float* v, int count);
  void (*subtract)(const float* a, const float* b, float* out, int count);         ///< a - b
  void (*half_difference)(const float* a, const float* b, float* out, int count);  ///< (a - b) / 2
  void (*half_sum)(const float* a, const float* b, float* out, int count);         ///< (a + b) / 2
  void (*to_rgb)(const ConstYuvPointers& line, const RgbPointers& out, int count);
};

/// @param isa  one of available_isas()
TelevisionKernels television_kernels(InstructionSet isa);

}  // namespace tessera::detail
