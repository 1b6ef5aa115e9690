#include "framebuffer/display/television_decoder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/check.h"

namespace tessera::detail {
namespace {

/// Deviation of the cycles of `distance` lines from half a cycle, -1/2 to 1/2.
double deviation_from_half(double cycles_per_line, int distance) {
  const double cycles = cycles_per_line * distance;
  return cycles - std::floor(cycles) - .5;
}

}  // namespace

TelevisionDecoder::TelevisionDecoder(const TelevisionSystem& system, const Television& television,
                                     const TelevisionRaster& raster, const TelevisionKernels& kernels)
    : kernels_(kernels),
      count_(rounded_up(raster.samples(), kSampleGroup)),
      is_composite_(television.cable == VideoCable::composite) {
  const bool is_pal = system.alternates_v;
  const VideoDecoder usual = is_pal ? VideoDecoder::delay_line : VideoDecoder::notch;
  const VideoDecoder decoder = television.decoder == VideoDecoder::automatic ? usual : television.decoder;
  averages_lines_ = is_pal && decoder == VideoDecoder::delay_line;

  const double rate_mhz = 4e-6 * system.subcarrier_hz;
  const double receiver_mhz = television.receiver_mhz > 0 ? television.receiver_mhz : system.receiver_mhz;
  const SymmetricFilter low_pass = without_quarter_frequencies(gaussian_low_pass(receiver_mhz / rate_mhz));
  band_ = band_pass_taps(low_pass);
  quadrature_ = quadrature_taps(low_pass);
  reach_ = low_pass.radius();

  // PAL's V has the same sign on every second line.
  const int distance = is_pal ? 2 : 1;
  const double deviation = deviation_from_half(raster.cycles_per_line(), distance);
  constexpr double kTolerance = .01;  // in cycles; PAL deviates by 0.0032
  if (is_composite_ && decoder == VideoDecoder::comb && std::abs(deviation) <= kTolerance) {
    comb_distance_ = distance;
    comb_lag_degrees_ = -180 * deviation;
    const SymmetricFilter comb = without_quarter_frequencies(sinc_low_pass(kCombMhz / rate_mhz, kCombRadius));
    comb_band_ = band_pass_taps(comb);
    reach_ = std::max(reach_, comb.radius());
  }
}

void TelevisionDecoder::decode(const SampleRange& range, const WireLine& wires, const WireLine* before,
                               double degrees, int v_sign, Scratch& scratch, YuvLine& line) const {
  TESSERA_ASSERT((comb_distance_ > 0) == (before != nullptr));
  const auto size = static_cast<std::size_t>(count_);
  for (auto* part : {&scratch.band, &scratch.quadrature, &scratch.luma_band, &line.y, &line.u, &line.v})
    part->resize(size);

  const float* chroma = is_composite_ ? wires.luma.data() : wires.chroma.data();
  if (before != nullptr) {
    scratch.difference.resize(static_cast<std::size_t>(range.count));
    kernels_.half_difference(wires.luma.data(), before->luma.data(), scratch.difference.data(), range.count);
    chroma = scratch.difference.data();
    degrees += comb_lag_degrees_;
  }
  chroma -= range.first;  // sample 0
  kernels_.filter(chroma, band_, scratch.band.data(), count_);
  kernels_.filter(chroma, quadrature_, scratch.quadrature.data(), count_);
  kernels_.demodulate(scratch.band.data(), scratch.quadrature.data(), make_subcarrier(degrees, v_sign),
                      line.u.data(), line.v.data(), count_);

  const float* luma = wires.luma.data() - range.first;
  if (before != nullptr) {
    kernels_.filter(chroma, comb_band_, scratch.luma_band.data(), count_);
    kernels_.subtract(luma, scratch.luma_band.data(), line.y.data(), count_);
  } else if (is_composite_) {
    kernels_.subtract(luma, scratch.band.data(), line.y.data(), count_);
  } else {
    std::copy(luma, luma + count_, line.y.begin());
  }
}

}  // namespace tessera::detail
