// Exact nearest-entry search in a palette.
//
// The colour cube is divided into cells; each cell keeps the entries that can be nearest to one of its
// points. A search compares only these few entries and finds the same one as a search over all. Twin:
// palette_search_reference.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framebuffer/palette.h"

namespace tessera::detail {

/// Range of the components of searched colours.
enum class PaletteSearchRange : std::uint8_t {
  unit,     ///< 0 to 1
  dithered  ///< -0.5 to 1.5
};

/// Values of the 256 display levels by which colours are compared, 0 to 1, increasing.
using LevelValues = std::array<float, 256>;
/// The stored values, level / 255.
constexpr LevelValues stored_values() {
  LevelValues values{};
  for (std::size_t level = 0; level < values.size(); ++level)
    values[level] = static_cast<float>(level) / 255.0f;
  return values;
}

class PaletteSearch {
 public:
  /// Builds the cells, about 1 ms for 256 entries. The palette need not outlive the call. Throws
  /// std::bad_alloc only.
  explicit PaletteSearch(const Palette& palette, PaletteSearchRange range = PaletteSearchRange::unit,
                         const LevelValues& values = stored_values());

  /// Index of the nearest entry that the palette defines. Undefined entries are never chosen.
  /// - Distance: squared, of components 0..1 and the values of the entries. Ties go to the lowest index.
  /// - Components are clamped to 0..1, NaN counts as 0.
  /// - Equals nearest_reference() bit for bit. Thread-safe, never fails.
  std::uint32_t nearest(float r, float g, float b) const noexcept;
  /// Nearest entry of a dithered colour, which may lie outside the cube; clamping it first could change the
  /// result. @pre PaletteSearchRange::dithered
  std::uint32_t nearest_unclamped(float r, float g, float b) const noexcept;

 private:
  [[gnu::always_inline]] inline std::uint32_t search(float r, float g, float b) const noexcept;
  struct Entry {
    float r, g, b;
    std::uint32_t index;  ///< palette index
    float squared_distance(float red, float green, float blue) const {
      const float dr = red - r, dg = green - g, db = blue - b;
      return dr * dr + dg * dg + db * db;
    }
  };
  float low_ = 0, high_ = 1;               ///< range of the searched components
  int cells_ = 1;                          ///< cells per axis; a power of two
  float scale_ = 1;                        ///< cells per unit of a component
  std::vector<Entry> entries_;             ///< distinct colours, ordered by index
  std::vector<std::uint32_t> cell_begin_;  ///< cells_^3 + 1 positions in candidates_
  std::vector<std::uint32_t> candidates_;  ///< positions in entries_, ascending in each cell
};

}  // namespace tessera::detail
