#include "framebuffer/display/panel_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "framebuffer/display/display_color.h"
#include "framebuffer/display/power.h"
#include "framebuffer/srgb.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kBlock = kBlockRows;
constexpr int kDitherFrames = 4;

/// Light of a signal, 0 to 1: `black` and a power on top.
double panel_light(double signal, double gamma, double black) {
  return black + (1 - black) * power(signal, gamma);
}

/// Common part: the levels of a picture, and the order of values.
class PanelSource : public LightSource {
 public:
  PanelSource(const VideoMode& mode, int planes)
      : LightSource(planes, mode.width),
        width_(static_cast<std::size_t>(mode.width)),
        height_(static_cast<std::size_t>(mode.height)) {}

  void begin(const ShownPicture& picture) override { picture_ = picture; }

 protected:
  std::size_t values_per_block() const { return static_cast<std::size_t>(planes()) * width_ * kBlock; }
  std::size_t blocks() const { return (height_ + kBlock - 1) / kBlock; }

  /// Calls visit(pixel's levels, x, y, index of its first value in the block).
  template <class Visit>
  void for_each_pixel(int block, const Visit& visit) const {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock;
    const std::size_t rows = std::min(kBlock, height_ - first);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t x = 0; x < width_; ++x)
        visit(picture_.levels + 3 * (width_ * (first + row) + x), x, first + row, x * kBlock + row);
  }

  std::size_t width_, height_;
  ShownPicture picture_{};
};

class LcdSource : public PanelSource {
 public:
  LcdSource(const LcdPanel& panel, const VideoMode& mode, double frame_ms)
      : PanelSource(mode, 3), is_dithered_(panel.bits == 6), frame_ms_(frame_ms) {
    for (int phase = 0; phase < (is_dithered_ ? kDitherFrames : 1); ++phase)
      light_.push_back(lcd_light(panel, phase));
    // The time from 10 to 90 % of an exponential is ln 9 time constants.
    time_constant_ms_ = panel.response_ms / natural_log(9);
    if (time_constant_ms_ > 0) {
      state_.assign(blocks() * values_per_block(), 0.0f);
      target_ = state_;
    }
  }

  void emit(int block, float* light) override {
    for_each_pixel(block, [&](const std::uint8_t* level, std::size_t x, std::size_t y, std::size_t index) {
      const std::vector<float>& table = light_[is_dithered_ ? phase(x, y) : 0];
      for (std::size_t color = 0; color < 3; ++color)
        light[index + color * width_ * kBlock] = table[level[color]];
    });
    if (time_constant_ms_ > 0) respond(static_cast<std::size_t>(block), light);
  }

 private:
  /// Threshold of the temporal dither. Neighbours of a 2x2 square run in different phases, so that areas do
  /// not flicker.
  std::size_t phase(std::size_t x, std::size_t y) const {
    constexpr std::size_t kOrder[kDitherFrames] = {0, 2, 1, 3};
    return kOrder[(static_cast<std::size_t>(picture_.frame) + (x & 1) + 2 * (y & 1)) % kDitherFrames];
  }

  /// Crystals follow the picture before until now, and this one from now on. The light is the mean over a
  /// frame: target + (state - target) (1 - e^(-T / tau)) tau / T.
  void respond(std::size_t block, float* light) {
    const double frames = frame_ms_ / time_constant_ms_;
    const auto kept = static_cast<float>(exponential(-picture_.since_last_ms / time_constant_ms_));
    const auto mean_share = static_cast<float>((1 - exponential(-frames)) / frames);
    float* state = state_.data() + block * values_per_block();
    float* target = target_.data() + block * values_per_block();
    for (std::size_t i = 0; i < values_per_block(); ++i) {
      state[i] = picture_.is_first ? light[i] : target[i] + (state[i] - target[i]) * kept;
      target[i] = light[i];
      light[i] = target[i] + (state[i] - target[i]) * mean_share;
    }
  }

  bool is_dithered_;
  double frame_ms_, time_constant_ms_ = 0;
  std::vector<std::vector<float>> light_;  ///< per phase: light of the levels
  std::vector<float> state_, target_;      ///< light at the last call, and that of its picture
};

class PlasmaSource : public PanelSource {
 public:
  PlasmaSource(const PlasmaPanel& panel, const VideoMode& mode, double frame_ms)
      : PanelSource(mode, 3), panel_(panel), frame_ms_(frame_ms), light_(plasma_light(panel, 0, 1)) {}

  void begin(const ShownPicture& picture) override {
    PanelSource::begin(picture);
    if (panel_.exposure_ms == 0) return;
    const double from = picture.phase_ms / frame_ms_, to = from + panel_.exposure_ms / frame_ms_;
    light_ = plasma_light(panel_, from, to);
    const std::vector<float> next = plasma_light(panel_, from - 1, to - 1);  // the frame after this one
    for (std::size_t level = 0; level < light_.size(); ++level) light_[level] += next[level];
  }

  void emit(int block, float* light) override {
    for_each_pixel(block, [&](const std::uint8_t* level, std::size_t, std::size_t, std::size_t index) {
      for (std::size_t color = 0; color < 3; ++color)
        light[index + color * width_ * kBlock] = light_[level[color]];
    });
  }

 private:
  PlasmaPanel panel_;
  double frame_ms_;
  std::vector<float> light_;
};

class PaperSource : public PanelSource {
 public:
  PaperSource(const EinkPanel& panel, const VideoMode& mode)
      : PanelSource(mode, 1),
        ghost_(panel.update == EinkUpdate::fast ? static_cast<float>(panel.ghost) : 0),
        light_(paper_light(panel)) {
    if (ghost_ > 0) shown_.assign(blocks() * values_per_block(), 0.0f);
  }

  void emit(int block, float* light) override {
    for_each_pixel(block, [&](const std::uint8_t* level, std::size_t, std::size_t, std::size_t index) {
      light[index] =
          light_[static_cast<std::size_t>((299 * level[0] + 587 * level[1] + 114 * level[2] + 500) / 1000)];
    });
    if (ghost_ == 0) return;
    float* shown = shown_.data() + static_cast<std::size_t>(block) * values_per_block();
    for (std::size_t i = 0; i < values_per_block(); ++i) {
      if (!picture_.is_first) light[i] += (shown[i] - light[i]) * ghost_;
      shown[i] = light[i];
    }
  }

 private:
  float ghost_;
  std::vector<float> light_, shown_;
};

/// Sums of all subsets of weights, ascending, each with its subset: bit k is subfield k.
struct SubfieldSum {
  double light;
  unsigned subset;
};
std::vector<SubfieldSum> subfield_sums(const std::vector<double>& weights) {
  std::vector<SubfieldSum> sums;
  for (unsigned subset = 0; subset < 1u << weights.size(); ++subset) {
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += (subset >> k & 1) != 0 ? weights[k] : 0;
    sums.push_back({sum, subset});
  }
  std::ranges::stable_sort(sums, {}, &SubfieldSum::light);
  return sums;
}

const SubfieldSum& nearest_sum(const std::vector<SubfieldSum>& sums, double light) {
  const auto above = std::ranges::lower_bound(sums, light, {}, &SubfieldSum::light);
  if (above == sums.begin()) return *above;
  if (above == sums.end()) return sums.back();
  return above->light - light < light - std::prev(above)->light ? *above : *std::prev(above);
}

/// Share of each subfield's light that is emitted between two times of the frame. Each subfield takes the
/// same time to be addressed, half of the frame in all, and then emits for a time in proportion to its
/// weight.
std::vector<double> collected(const std::vector<double>& weights, double total, double from, double to) {
  constexpr double kAddressing = 0.5;  // share of the frame; a default without a source
  std::vector<double> shares;
  double time = 0;
  for (const double weight : weights) {
    time += kAddressing / static_cast<double>(weights.size());
    const double duration = (1 - kAddressing) * weight / total;
    const double seen = std::min(to, time + duration) - std::max(from, time);
    shares.push_back(std::clamp(seen / duration, 0.0, 1.0));
    time += duration;
  }
  return shares;
}

}  // namespace

std::vector<float> lcd_light(const LcdPanel& panel, int phase) {
  std::vector<float> light;
  for (int level = 0; level < 256; ++level) {
    // Six bits: the lower two bits of a level are the number of frames, of four, in which the next one shows.
    const double signal =
        panel.bits == 6 ? std::min((level >> 2) + ((level & 3) > phase), 63) / 63.0 : level / 255.0;
    light.push_back(static_cast<float>(panel_light(signal, panel.gamma, panel.black)));
  }
  return light;
}

std::vector<float> plasma_light(const PlasmaPanel& panel, double from_share, double to_share) {
  double total = 0;
  for (const double weight : panel.subfields) total += weight;
  const std::vector<SubfieldSum> sums = subfield_sums(panel.subfields);
  const std::vector<double> shares = collected(panel.subfields, total, from_share, to_share);
  std::vector<float> light;
  for (int level = 0; level < 256; ++level) {
    const SubfieldSum& chosen = nearest_sum(sums, power(level / 255.0, panel.gamma) * total);
    double sum = 0;
    for (std::size_t k = 0; k < shares.size(); ++k)
      if ((chosen.subset >> k & 1) != 0) sum += panel.subfields[k] * shares[k];
    const double priming = panel.black * std::max(std::min(to_share, 1.0) - std::max(from_share, 0.0), 0.0);
    light.push_back(static_cast<float>(priming + (1 - panel.black) * sum / total));
  }
  return light;
}

std::vector<float> paper_light(const EinkPanel& panel) {
  const double black = panel.black / panel.white;
  std::vector<float> light;
  for (int level = 0; level < 256; ++level) {
    // The nearest grey; greys are evenly spaced in sRGB.
    const int gray = (level * (panel.levels - 1) * 2 + 255) / 510;
    const double value = linear_from_srgb(static_cast<double>(gray) / (panel.levels - 1));
    light.push_back(static_cast<float>(black + (1 - black) * value));
  }
  return light;
}

std::unique_ptr<LightSource> make_panel_source(const Display& display, const VideoMode& mode,
                                               double frame_ms) {
  switch (display.kind) {
    case DisplayKind::plasma: return std::make_unique<PlasmaSource>(display.plasma, mode, frame_ms);
    case DisplayKind::eink: return std::make_unique<PaperSource>(display.eink, mode);
    default: return std::make_unique<LcdSource>(display.lcd, mode, frame_ms);
  }
}

}  // namespace tessera::detail
