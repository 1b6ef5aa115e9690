// Encoder of NTSC and PAL: pixels -> luma and chroma on one wire or two.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/display/television_kernels.h"
#include "framebuffer/display/television_raster.h"

namespace tessera::detail {

/// The samples of a line that are computed. They begin before sample 0 of the picture and end after its last
/// one, because filters reach beyond both.
struct SampleRange {
  int first = 0;  ///< a negative multiple of four: the period of the subcarrier
  int count = 0;  ///< a multiple of kSampleGroup
};

/// The part of a line's signal that shows pixels, with what filters leave beyond its ends: black is 0, white
/// is 1. Element 0 is sample `SampleRange::first` of the picture.
struct WireLine {
  std::vector<float> luma;    ///< composite: luma and chroma
  std::vector<float> chroma;  ///< S-Video only
};

/// Pixels of 8 bits per component.
struct PixelRow {
  const std::uint8_t* rgb;
  int bytes_per_pixel;
};

/// Luma and both colour differences are averaged over samples, then limited in bandwidth:
/// - luma by a sinc filter of 2 * kLumaRadius + 1 taps,
/// - colour differences by a Gaussian, like the filters that BT.470 requires for PAL: -3 dB at 1.3 MHz and
///   less than -20 dB at 4 MHz. NTSC's I and Q have the same bandwidth, as in SMPTE 170M.
class TelevisionEncoder {
 public:
  static constexpr int kLumaRadius = 24;

  /// @param range  samples to encode, at least those of the picture
  TelevisionEncoder(const TelevisionSystem& system, const Television& television,
                    const TelevisionRaster& raster, const VideoMode& mode, const SampleRange& range,
                    const TelevisionKernels& kernels);

  /// Intermediate results, which calls reuse. One per thread.
  struct Scratch {
    std::vector<float> y_pixels, u_pixels, v_pixels;
    std::vector<float> y_samples, u_samples, v_samples;
    std::vector<float> y, u, v;
  };
  Scratch make_scratch() const;

  /// @param degrees  angle of the subcarrier at sample 0
  void encode(const PixelRow& pixels, double degrees, int v_sign, Scratch& scratch, WireLine& line) const;

 private:
  void read_pixels(const PixelRow& pixels, Scratch& scratch) const;

  TelevisionKernels kernels_;
  SampleRange range_;
  int width_;
  int margin_;  ///< samples that the filters need beyond both ends of the range
  PixelAreas areas_;
  FilterTaps luma_filter_, chroma_filter_;
  double phase_degrees_, gain_;
  bool is_composite_;
  std::vector<float> no_luma_;
};

}  // namespace tessera::detail
