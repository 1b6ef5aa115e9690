#include "framebuffer/ramp_palette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "framebuffer/converter_colors.h"
#include "framebuffer/oklab.h"

namespace tessera::detail {

namespace {

constexpr int kSamplesPerSegment = 64;
// Distances along ramps, in OKLab.
constexpr double kEndsOnly = 16;            // longer than every ramp of some corners
constexpr double kPixelSpacing = 0.05;      // weighted_picture()
constexpr double kMinSpacing = 1.0 / 1024;  // neighbours are less than a level of 255 apart
constexpr int kBisections = 24;

RampColor mix(const RampColor& a, const RampColor& b, double t) noexcept {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

RampColor clamped(const RampColor& c) noexcept {
  return {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
}

Rgb8 rounded(const RampColor& c) noexcept {
  const auto level = [](double v) { return static_cast<std::uint8_t>(v * 255 + 0.5); };
  return {level(c.r), level(c.g), level(c.b)};
}

/// A ramp by its length in OKLab.
class MeasuredRamp {
 public:
  explicit MeasuredRamp(const ColorRamp& corners) {
    add(clamped(corners.front()));
    for (std::size_t i = 1; i < corners.size(); ++i)
      for (int k = 1; k <= kSamplesPerSegment; ++k)
        add(clamped(mix(corners[i - 1], corners[i], static_cast<double>(k) / kSamplesPerSegment)));
  }

  double length() const noexcept { return lengths_.back(); }
  /// Colour at a distance from the start.
  RampColor at(double distance) const noexcept {
    const auto found = std::lower_bound(lengths_.begin() + 1, lengths_.end(), distance);
    if (found == lengths_.end()) return colors_.back();
    const auto i = static_cast<std::size_t>(found - lengths_.begin());
    const double step = lengths_[i] - lengths_[i - 1];
    return step > 0 ? mix(colors_[i - 1], colors_[i], (distance - lengths_[i - 1]) / step) : colors_[i];
  }

 private:
  void add(const RampColor& color) {
    const Oklab added = oklab_from_srgb(color.r, color.g, color.b);
    const double step = colors_.empty() ? 0 : std::sqrt(squared_distance(last_, added));
    lengths_.push_back(lengths_.empty() ? 0 : lengths_.back() + step);
    colors_.push_back(color);
    last_ = added;
  }
  Oklab last_;
  std::vector<RampColor> colors_;
  std::vector<double> lengths_;  ///< from the start to each colour
};

/// Colours of all ramps, at equal distances of at most `spacing`, ends included.
std::vector<Rgb8> spaced_colors(const std::vector<MeasuredRamp>& ramps, double spacing) {
  std::vector<Rgb8> colors;
  for (const MeasuredRamp& ramp : ramps) {
    const double steps = std::ceil(ramp.length() / spacing);
    if (steps == 0) colors.push_back(rounded(ramp.at(0)));
    else
      for (double k = 0; k <= steps; ++k) colors.push_back(rounded(ramp.at(ramp.length() * (k / steps))));
  }
  return colors;
}

/// Distinct colours of the converter, by packed value.
std::vector<Rgb8> distinct_shown(const ConverterColors& converter, const std::vector<Rgb8>& colors) {
  std::vector<Rgb8> shown;
  shown.reserve(colors.size());
  for (const Rgb8& color : colors) shown.push_back(converter.shown(converter.levels_of(color)));
  const auto packed = [](Rgb8 c) { return c.r << 16 | c.g << 8 | c.b; };
  std::sort(shown.begin(), shown.end(), [&](Rgb8 a, Rgb8 b) { return packed(a) < packed(b); });
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return shown;
}

ColorCounts picture_of(const std::vector<Rgb8>& colors) {
  std::vector<std::uint32_t> words;
  for (const Rgb8& c : colors) words.push_back(std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b);
  ColorCounts picture;
  picture.add(words);
  return picture;
}

/// Pixels in proportion to the lengths of the ramps. A single colour has as many as a ramp of length 1,
/// because it may be the background.
ColorCounts weighted_picture(const std::vector<MeasuredRamp>& ramps) {
  std::vector<Rgb8> colors = spaced_colors(ramps, kPixelSpacing);
  for (const MeasuredRamp& ramp : ramps)
    if (ramp.length() == 0)
      colors.insert(colors.end(), static_cast<std::size_t>(1 / kPixelSpacing), rounded(ramp.at(0)));
  return picture_of(colors);
}

}  // namespace

std::vector<Rgb8> ramp_palette(const std::vector<ColorRamp>& ramps, const PaletteShape& shape,
                               InstructionSet isa) {
  const ConverterColors converter(shape.component_bits);
  const std::vector<MeasuredRamp> measured(ramps.begin(), ramps.end());
  const auto colors_at = [&](double spacing) {
    return distinct_shown(converter, spaced_colors(measured, spacing));
  };
  std::vector<Rgb8> chosen = colors_at(kEndsOnly);
  if (chosen.size() > shape.entries) return adaptive_palette(weighted_picture(measured), shape, isa);
  // Bisection for the smallest spacing whose colours fit.
  double fits = kEndsOnly, too_close = 0;
  for (int i = 0; i < kBisections && fits > kMinSpacing; ++i) {
    const double spacing = (fits + too_close) / 2;
    std::vector<Rgb8> at_spacing = colors_at(spacing);
    if (at_spacing.size() > shape.entries) {
      too_close = spacing;
    } else {
      fits = spacing;
      chosen = std::move(at_spacing);
    }
  }
  return adaptive_palette(picture_of(chosen), shape, isa);
}

}  // namespace tessera::detail
