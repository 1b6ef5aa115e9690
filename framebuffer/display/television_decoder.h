// Receivers of NTSC and PAL: wires -> luma and colour differences.
#pragma once

#include <vector>

#include "framebuffer/display/television_encoder.h"
#include "framebuffer/display/television_kernels.h"
#include "framebuffer/display/television_raster.h"

namespace tessera::detail {

/// A decoded line: samples of the picture, and some more up to a multiple of kSampleGroup.
struct YuvLine {
  std::vector<float> y, u, v;
};

/// Splits composite lines into luma and chroma, and demodulates chroma. All filters are symmetric, so luma
/// and chroma coincide, and pass flat areas unchanged.
/// - Chroma: the band of a Gaussian around the subcarrier, demodulated with the phase of the burst.
/// - Luma of a composite line: the line less a band around the subcarrier. With the notch, it is the band of
///   chroma. With the comb, it is 2 * kCombMhz wide, of half the difference of two lines on which the
///   subcarrier has opposite signs: luma that both have in common stays.
class TelevisionDecoder {
 public:
  static constexpr double kCombMhz = 2.0;
  static constexpr int kCombRadius = 24;

  TelevisionDecoder(const TelevisionSystem& system, const Television& television,
                    const TelevisionRaster& raster, const TelevisionKernels& kernels);

  /// Samples beyond both ends of a line that the filters need.
  int reach() const { return reach_; }
  /// Distance of the lines that the comb compares; 0 without comb. The comb needs a subcarrier that changes
  /// its sign over this distance: broadcast lines, but not CGA's, which have whole cycles.
  int comb_distance() const { return comb_distance_; }
  /// PAL's delay line: the picture has the mean of the colour differences of a line and the one before it.
  bool averages_lines() const { return averages_lines_; }

  /// Intermediate results, which calls reuse. One per thread.
  struct Scratch {
    std::vector<float> difference, band, quadrature, luma_band;
  };

  /// @param range    of the wires' samples
  /// @param before   the line comb_distance() before; null without comb
  /// @param degrees  angle of the subcarrier at sample 0, as the burst tells
  void decode(const SampleRange& range, const WireLine& wires, const WireLine* before, double degrees,
              int v_sign, Scratch& scratch, YuvLine& line) const;

 private:
  TelevisionKernels kernels_;
  int count_;  ///< samples of a decoded line
  int reach_ = 0;
  int comb_distance_ = 0;
  double comb_lag_degrees_ = 0;  ///< angle from the subcarrier to that of half the difference of two lines
  bool averages_lines_;
  bool is_composite_;
  FilterTaps band_, quadrature_, comb_band_;
};

}  // namespace tessera::detail
