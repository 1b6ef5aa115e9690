#include "framebuffer/display/tube_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "framebuffer/display/display_color.h"
#include "framebuffer/display/line_times.h"
#include "framebuffer/display/television_signal.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kBlock = kBlockRows;

bool is_television(const Display& display) {
  return display.kind == DisplayKind::ntsc || display.kind == DisplayKind::pal;
}

/// Samples of light per sample of the signal. The beam must span 0.6 samples, so that a sum over samples
/// equals the integral within 0.1 %: exp(-2 pi^2 0.6^2) = 0.0008. From 4 on, harmonics of pixels that alias
/// to the finest grating are 2 % of it: the 7th, of which the amplifier passes less than 1/7.
int subsamples(double sigma_in_signal_samples) {
  return static_cast<int>(std::clamp(std::ceil(0.6 / sigma_in_signal_samples), 4.0, double{kMaxSubsamples}));
}

/// Time constant 1 / (2 pi B) of the video amplifier, in seconds. Without a given bandwidth, that of a
/// monitor is half the pixel clock, and that of a television only that of its signal: 0.
double amplifier_seconds(const Display& display, const VideoMode& mode) {
  double hz = display.crt.bandwidth_mhz * 1e6;
  if (hz == 0 && is_television(display)) return 0;
  if (hz == 0) hz = frame_scan(mode, display.crt).pixel_clock_hz / 2;
  return 1 / (2 * std::numbers::pi * hz);
}

class TubeSource : public LightSource {
 public:
  TubeSource(const Display& display, const VideoMode& mode, const TubeSamples& samples, InstructionSet isa)
      : LightSource(colors_of(display) * (display.crt.beam_growth > 0 ? 2 : 1), samples.count),
        colors_(static_cast<std::size_t>(colors_of(display))),
        width_(static_cast<std::size_t>(mode.width)),
        height_(static_cast<std::size_t>(mode.height)),
        light_table_(tube_light(display.crt.gamma, display.crt.black)),
        to_light_(signal_to_light_for(isa)) {
    if (is_television(display))
      television_ = std::make_unique<TelevisionSignal>(display.kind, display.television, mode, isa);
    signal_samples_ = television_ ? static_cast<std::size_t>(television_->samples()) : width_;
    const double samples_per_pixel = television_ ? television_->samples_per_pixel() : 1;
    const double pixel_hz = frame_scan(mode, display.crt).pixel_clock_hz;
    response_ =
        signal_response(samples.count / static_cast<int>(signal_samples_),
                        amplifier_seconds(display, mode) * pixel_hz * samples_per_pixel, light_table_);
  }

  void begin(const ShownPicture& picture) override { picture_ = picture; }

  void emit(int block, float* light) override {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock;
    const std::size_t rows = std::min(kBlock, height_ - first);
    std::vector<float> signal(colors_ * signal_samples_ * kBlock, 0.0f);  // [color][sample][row]
    if (television_) receive(first, rows, signal);
    else convert_levels(first, rows, signal);
    const std::size_t plane_values = static_cast<std::size_t>(samples()) * kBlock;
    for (std::size_t color = 0; color < colors_; ++color)
      to_light_(signal.data() + color * signal_samples_ * kBlock, static_cast<int>(signal_samples_),
                response_, light + color * plane_values);
    if (static_cast<std::size_t>(planes()) > colors_) split_by_current(light, colors_ * plane_values);
  }

 private:
  static int colors_of(const Display& display) { return is_monochrome(display.crt.phosphor) ? 1 : 3; }

  void convert_levels(std::size_t first, std::size_t rows, std::vector<float>& signal) const {
    for (std::size_t row = 0; row < rows; ++row) {
      const std::uint8_t* level = picture_.levels + 3 * width_ * (first + row);
      float* out = signal.data() + row;
      for (std::size_t x = 0; x < width_; ++x, level += 3, out += kBlock)
        store_colors({level[0] / 255.0f, level[1] / 255.0f, level[2] / 255.0f}, out);
    }
  }

  void receive(std::size_t first, std::size_t rows, std::vector<float>& signal) const {
    std::vector<float> received(3 * signal_samples_ * rows);  // [row][color][sample]
    television_->decode_rows(picture_.levels, static_cast<std::ptrdiff_t>(3 * width_), 3, picture_.frame,
                             static_cast<int>(first), static_cast<int>(first + rows), received.data());
    for (std::size_t row = 0; row < rows; ++row) {
      const float* in = received.data() + 3 * signal_samples_ * row;
      float* out = signal.data() + row;
      for (std::size_t k = 0; k < signal_samples_; ++k, ++in, out += kBlock)
        store_colors({in[0], in[signal_samples_], in[2 * signal_samples_]}, out);
    }
  }

  /// @param out  of red or luma; the other colours follow at the distance of a plane
  void store_colors(const std::array<float, 3>& rgb, float* out) const {
    if (colors_ == 1) {
      out[0] = static_cast<float>(kLuma[0]) * rgb[0] + static_cast<float>(kLuma[1]) * rgb[1] +
               static_cast<float>(kLuma[2]) * rgb[2];
      return;
    }
    for (std::size_t color = 0; color < 3; ++color) out[color * signal_samples_ * kBlock] = rgb[color];
  }

  /// The beam widens with its current: a share of the light that equals the light itself, 0 to 1, has the
  /// widest profile, the rest the narrowest.
  static void split_by_current(float* light, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const float wide = light[i] * std::min(light[i], 1.0f);
      light[count + i] = wide;
      light[i] -= wide;
    }
  }

  std::size_t colors_, width_, height_, signal_samples_ = 0;
  LightTable light_table_;
  SignalResponse response_;
  SignalToLightFn* to_light_;
  std::unique_ptr<TelevisionSignal> television_;
  ShownPicture picture_{};
};

}  // namespace

TubeSamples tube_samples(const Display& display, const VideoMode& mode, double sigma_px) {
  int signal_samples = mode.width;
  double samples_per_pixel = 1;
  if (is_television(display)) {
    const TelevisionSignal signal(display.kind, display.television, mode, InstructionSet::scalar);
    signal_samples = signal.samples();
    samples_per_pixel = signal.samples_per_pixel();
  }
  const int k = subsamples(sigma_px * samples_per_pixel);
  const double pixel_hz = frame_scan(mode, display.crt).pixel_clock_hz;
  return {signal_samples * k, samples_per_pixel * k, amplifier_seconds(display, mode) * pixel_hz};
}

std::unique_ptr<LightSource> make_tube_source(const Display& display, const VideoMode& mode, double sigma_px,
                                              InstructionSet isa) {
  return std::make_unique<TubeSource>(display, mode, tube_samples(display, mode, sigma_px), isa);
}

}  // namespace tessera::detail
