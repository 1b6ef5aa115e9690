#include "framebuffer/display/television_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tessera::detail {
namespace {

PixelAreas pixel_areas(int width, int samples, double samples_per_pixel) {
  PixelAreas areas;
  areas.count = rounded_up(samples, kSampleGroup);
  areas.taps = static_cast<int>(std::ceil(1 / samples_per_pixel)) + 1;
  const auto count = static_cast<std::size_t>(areas.count);
  areas.first.assign(count, 0);
  areas.weights.assign(count * static_cast<std::size_t>(areas.taps), 0);
  for (int k = 0; k < samples; ++k) {
    const double left = k / samples_per_pixel, right = (k + 1) / samples_per_pixel;
    const int first = std::min(static_cast<int>(left), width - 1);
    areas.first[static_cast<std::size_t>(k)] = first;
    for (int tap = 0; tap < areas.taps && first + tap < width; ++tap) {
      const double covered = std::min<double>(right, first + tap + 1) - std::max<double>(left, first + tap);
      areas.weights[static_cast<std::size_t>(tap) * count + static_cast<std::size_t>(k)] =
          static_cast<float>(std::max(0.0, covered) * samples_per_pixel);
    }
  }
  return areas;
}

}  // namespace

TelevisionEncoder::TelevisionEncoder(const TelevisionSystem& system, const Television& television,
                                     const TelevisionRaster& raster, const VideoMode& mode,
                                     const SampleRange& range, const TelevisionKernels& kernels)
    : kernels_(kernels),
      range_(range),
      width_(mode.width),
      areas_(pixel_areas(mode.width, raster.samples(), raster.samples_per_pixel())),
      phase_degrees_(television.phase_deg),
      gain_(television.gain),
      is_composite_(television.cable == VideoCable::composite),
      no_luma_(static_cast<std::size_t>(range.count)) {
  const double rate_mhz = 4e-6 * system.subcarrier_hz;
  const double luma_mhz = television.luma_mhz > 0 ? television.luma_mhz : system.luma_mhz;
  const double chroma_mhz = television.chroma_mhz > 0 ? television.chroma_mhz : system.chroma_mhz;
  const SymmetricFilter luma = sinc_low_pass(luma_mhz / rate_mhz, kLumaRadius);
  const SymmetricFilter chroma = gaussian_low_pass(chroma_mhz / rate_mhz);
  luma_filter_ = all_taps(luma);
  chroma_filter_ = all_taps(chroma);
  margin_ = std::max(luma.radius(), chroma.radius());
}

TelevisionEncoder::Scratch TelevisionEncoder::make_scratch() const {
  const auto pixels = static_cast<std::size_t>(width_ + areas_.taps);
  const auto samples = static_cast<std::size_t>(range_.count + 2 * margin_);
  const auto range = static_cast<std::size_t>(range_.count);
  Scratch scratch;
  for (auto* line : {&scratch.y_pixels, &scratch.u_pixels, &scratch.v_pixels}) line->resize(pixels);
  for (auto* line : {&scratch.y_samples, &scratch.u_samples, &scratch.v_samples}) line->resize(samples);
  for (auto* line : {&scratch.y, &scratch.u, &scratch.v}) line->resize(range);
  return scratch;
}

// In integers, so that greys have no chroma.
void TelevisionEncoder::read_pixels(const PixelRow& pixels, Scratch& scratch) const {
  constexpr int kRed = 299, kGreen = 587, kBlue = 114, kOne = 1000;
  static_assert(kRed + kGreen + kBlue == kOne && kLumaRed * kOne == kRed && kLumaBlue * kOne == kBlue);
  constexpr auto kY = static_cast<float>(1 / (255.0 * kOne));
  constexpr auto kU = static_cast<float>(kUScale / (255.0 * kOne));
  constexpr auto kV = static_cast<float>(kVScale / (255.0 * kOne));
  float* const y = scratch.y_pixels.data();
  float* const u = scratch.u_pixels.data();
  float* const v = scratch.v_pixels.data();
  const std::uint8_t* pixel = pixels.rgb;
  for (int x = 0; x < width_; ++x, pixel += pixels.bytes_per_pixel) {
    const int r = pixel[0], g = pixel[1], b = pixel[2];
    const int luma = kRed * r + kGreen * g + kBlue * b;
    y[x] = static_cast<float>(luma) * kY;
    u[x] = static_cast<float>(kOne * b - luma) * kU;
    v[x] = static_cast<float>(kOne * r - luma) * kV;
  }
}

void TelevisionEncoder::encode(const PixelRow& pixels, double degrees, int v_sign, Scratch& scratch,
                               WireLine& line) const {
  read_pixels(pixels, scratch);
  const int picture = margin_ - range_.first;  // sample 0
  kernels_.average_pixels({scratch.y_pixels.data(), scratch.u_pixels.data(), scratch.v_pixels.data()}, areas_,
                          {scratch.y_samples.data() + picture, scratch.u_samples.data() + picture,
                           scratch.v_samples.data() + picture});

  const int count = range_.count;
  kernels_.filter(scratch.y_samples.data() + margin_, luma_filter_, scratch.y.data(), count);
  kernels_.filter(scratch.u_samples.data() + margin_, chroma_filter_, scratch.u.data(), count);
  kernels_.filter(scratch.v_samples.data() + margin_, chroma_filter_, scratch.v.data(), count);

  // The receiver refers to the burst, which has the phase of the carrier without the error.
  const Subcarrier carrier = make_subcarrier(degrees + phase_degrees_, v_sign, gain_);
  line.luma.resize(static_cast<std::size_t>(count));
  if (is_composite_) {
    kernels_.modulate({scratch.y.data(), scratch.u.data(), scratch.v.data()}, carrier, line.luma.data(),
                      count);
  } else {
    line.chroma.resize(static_cast<std::size_t>(count));
    std::copy(scratch.y.begin(), scratch.y.end(), line.luma.begin());
    kernels_.modulate({no_luma_.data(), scratch.u.data(), scratch.v.data()}, carrier, line.chroma.data(),
                      count);
  }
}

}  // namespace tessera::detail
