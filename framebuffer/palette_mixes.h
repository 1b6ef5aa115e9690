// Mixes of two palette entries, for Dither::pattern and for ordered dither in light.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "framebuffer/light_curve.h"
#include "framebuffer/palette.h"

namespace tessera::detail {

inline constexpr std::size_t kMaxMixedEntries = 256;

/// Two palette entries, the darker one first, and the share of the second in steps: 0 to PaletteMixes::steps.
struct PaletteMix {
  std::uint8_t first = 0, second = 0;
  std::uint16_t share = 0;
  friend bool operator==(const PaletteMix&, const PaletteMix&) = default;
};

/// Finds the mix that is nearest to a colour.
class PaletteMixes {
 public:
  /// Lists the pairs of entries: a few milliseconds for 256 entries. Throws std::bad_alloc only.
  /// @param light  mixes have the mean light of their entries; absent: the mean stored values
  /// @param steps  shares are multiples of 1 / steps, the number of a dither's thresholds; 1 to 4096
  /// @param reach  number of entries nearest to a colour that are mixed, at least 2; few make finer patterns
  /// @pre at most kMaxMixedEntries entries
  PaletteMixes(const Palette& palette, const std::optional<LightCurve>& light, int steps,
               std::size_t reach = kMaxMixedEntries);

  /// The mix nearest to a colour of 8 bits per component.
  /// - Distance: squared, of the components or their light.
  /// - Mixes within half a level of every component are equal to the colour. Of several, the pair with the
  ///   smallest distance of its entries is chosen, then the lowest indices: it shows the least noise.
  /// - Searches all pairs, about 20 us for 256 entries; a cache keeps the last colours. Thread-safe.
  PaletteMix nearest(Rgb8 color) const;
  /// Entry of a pixel. @param threshold  of its position: the lowest ones show the second entry
  std::uint32_t entry(float r, float g, float b, float threshold) const;

 private:
  struct Vector {
    float r, g, b;
    float dot(const Vector& o) const { return r * o.r + g * o.g + b * o.b; }
  };
  struct Pair {
    std::uint8_t first, second;  ///< positions in entries_
    Vector difference;           ///< second - first
    float length;                ///< length of the difference
    float inverse_square;        ///< 1 / length^2
  };
  struct Entry {
    Vector value;
    std::uint8_t index;  ///< in the palette
  };
  PaletteMix search(Rgb8 color) const;
  float reach_radius(const float* distances) const;

  float steps_;
  std::size_t reach_;
  std::vector<float> values_;       ///< values of the 256 levels
  std::vector<float> half_levels_;  ///< half of the distance of a level's neighbours
  std::vector<Entry> entries_;      ///< distinct colours, from dark to bright
  std::vector<Pair> pairs_;         ///< the closest ones first
  /// Colour << 32 | share << 16 | first << 8 | second, and bit 63 if set; by hash of the colour.
  std::unique_ptr<std::atomic<std::uint64_t>[]> cache_;
};

}  // namespace tessera::detail
