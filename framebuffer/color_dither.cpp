#include "framebuffer/color_dither.h"

#include <algorithm>

namespace tessera::detail {
namespace {

constexpr int kTableIntervals = 4096;
constexpr std::size_t kMixedNeighbours = 16;  ///< by thresholds in light

/// Moves components between two levels of b bits in proportion to their light.
ComponentTable levels_by_light(const LightCurve& curve, int bits) {
  const int levels = (1 << bits) - 1;
  const int each = std::max(kTableIntervals / levels, 1);  // intervals between two levels
  return {levels * each, [&](double c) {
            const int level = std::min(static_cast<int>(c * levels + 0.5 / each), levels - 1);
            const double low = curve.light(static_cast<double>(level) / levels);
            const double high = curve.light(static_cast<double>(level + 1) / levels);
            return (level + (curve.light(c) - low) / (high - low)) / levels;
          }};
}

}  // namespace

LevelValues level_values(const std::optional<LightCurve>& light) {
  LevelValues values = stored_values();
  if (!light) return values;
  for (std::size_t level = 0; level < values.size(); ++level)
    values[level] = static_cast<float>(light->light(static_cast<double>(level) / 255));
  return values;
}

float palette_spread(std::size_t entries) {
  if (entries < 8) return 1;  // cbrt(8) - 1
  return static_cast<float>(1 / (nth_root<3>(static_cast<double>(entries)) - 1));
}

ColorDither::ColorDither(Dither kind, const std::optional<LightCurve>& light, const ColorLayout& layout,
                         const Palette& palette, int frame_height)
    : pattern_(kind, frame_height) {
  if (layout.index) {
    spread_ = palette_spread(palette.entries.size());
    // Thresholds of light on top of a dark colour would reach beyond black: in light, entries are mixed.
    const bool is_mixed = kind == Dither::pattern || (light && palette.entries.size() <= kMaxMixedEntries);
    const std::size_t reach = kind == Dither::pattern ? kMaxMixedEntries : kMixedNeighbours;
    if (is_mixed) mixes_.emplace(palette, light, pattern_.size() * pattern_.size(), reach);
    else if (light) tables_.emplace_back(kTableIntervals, [&](double c) { return light->light(c); });
    return;
  }
  if (!light) return;
  const std::array<int, 3> bits = layout.luminance ? std::array{layout.bits, layout.bits, layout.bits}
                                                   : std::array{layout.r_bits, layout.g_bits, layout.b_bits};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto same = std::find(bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(c), bits[c]);
    const auto first = static_cast<std::size_t>(same - bits.begin());
    if (first < c) {
      index_[c] = index_[first];
    } else {
      index_[c] = tables_.size();
      tables_.push_back(levels_by_light(*light, bits[c]));
    }
  }
}

}  // namespace tessera::detail
