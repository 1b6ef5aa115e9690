// Rounding of colours to the levels or palette entries of a frame buffer, by an ordered dither.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "framebuffer/component_table.h"
#include "framebuffer/dither_pattern.h"
#include "framebuffer/format.h"
#include "framebuffer/light_curve.h"
#include "framebuffer/palette.h"
#include "framebuffer/palette_mixes.h"
#include "framebuffer/palette_search.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Values of the 256 display levels in the space of a dither: level / 255, or its light.
LevelValues level_values(const std::optional<LightCurve>& light);

/// Distance of the values between which a palette of N entries is dithered: 1 / max(1, cbrt(N) - 1).
float palette_spread(std::size_t entries);

class ColorDither {
 public:
  /// @param light    absent: DitherSpace::levels
  /// @param palette  index layouts
  ColorDither(Dither kind, const std::optional<LightCurve>& light, const ColorLayout& layout,
              const Palette& palette, int frame_height);

  const DitherPattern& pattern() const { return pattern_; }
  /// Index layouts: (threshold - 0.5) * spread is added to the components before the search.
  float spread() const { return spread_; }
  /// Replaces spread and search in index layouts with Dither::pattern, and in light with palettes of at most
  /// kMaxMixedEntries entries. Else null.
  const PaletteMixes* mixes() const { return mixes_ ? &*mixes_ : nullptr; }

  /// In light, the function of component c (0 red, 1 green, 2 blue; luminance: 0) that is applied before the
  /// threshold; null in levels.
  /// - RGB: between the levels v and v + 1, whose light is L_v and L_v+1, it is
  ///   (v + (light - L_v) / (L_v+1 - L_v)) / (2^b - 1): the threshold then decides by light.
  /// - Index, without mixes(): the light itself.
  const ComponentTable* table(std::size_t c) const { return tables_.empty() ? nullptr : &tables_[index_[c]]; }
  /// A component in the space of the threshold. @pre 0 <= value <= 1
  float component(std::size_t c, float value) const {
    return tables_.empty() ? value : tables_[index_[c]].at(value);
  }

 private:
  DitherPattern pattern_;
  float spread_ = 0;
  std::vector<ComponentTable> tables_;  ///< one for each number of bits
  std::array<std::size_t, 3> index_{};  ///< tables of red, green and blue
  std::optional<PaletteMixes> mixes_;
};

/// Palette entry of a pixel of colour r, g, b, 0 to 1.
/// @param search     of the palette, with half of spread() as margin and the level_values() of the dither
/// @param threshold  of the pixel
inline std::uint32_t dithered_entry(const ColorDither& dither, const PaletteSearch& search, float r, float g,
                                    float b, float threshold) {
  if (dither.mixes() != nullptr) return dither.mixes()->entry(r, g, b, threshold);
  const float offset = (threshold - 0.5f) * dither.spread();
  return search.nearest_unclamped(dither.component(0, r) + offset, dither.component(1, g) + offset,
                                  dither.component(2, b) + offset);
}

}  // namespace tessera::detail
