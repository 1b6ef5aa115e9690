// Exact nearest-entry search in a palette.
//
// The colour cube is divided into cells; each cell keeps the entries that can be nearest to one of its
// points. Cells with many of them are divided further. A search compares only these few entries and finds the
// same one as a search over all. Twin: palette_search_reference.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framebuffer/palette.h"

namespace tessera::detail {

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
  /// Builds the cells, a few milliseconds for 256 entries. The palette need not outlive the call. Throws
  /// std::bad_alloc only.
  /// @param margin  components of searched colours range from -margin to 1 + margin; at most 0.5
  explicit PaletteSearch(const Palette& palette, float margin = 0,
                         const LevelValues& values = stored_values());

  /// Index of the nearest entry that the palette defines. Undefined entries are never chosen.
  /// - Distance: squared, of components 0..1 and the values of the entries. Ties go to the lowest index.
  /// - Components are clamped to 0..1, NaN counts as 0.
  /// - Equals nearest_reference() bit for bit. Thread-safe, never fails.
  std::uint32_t nearest(float r, float g, float b) const noexcept;
  /// Nearest entry of a dithered colour, which may lie outside the cube; clamping it first could change the
  /// result. @pre components within the margin
  std::uint32_t nearest_unclamped(float r, float g, float b) const noexcept;

 private:
  struct Entry {
    float r, g, b;
    std::uint32_t index;  ///< palette index
    float squared_distance(float red, float green, float blue) const {
      const float dr = red - r, dg = green - g, db = blue - b;
      return dr * dr + dg * dg + db * db;
    }
  };
  /// A cube of the cell table. Undivided: its candidates. Divided: the place of its kParts^3 parts.
  struct Cell {
    std::uint32_t first;  ///< in candidates_, or in cells_
    std::uint32_t count;  ///< number of candidates, or kDivided
  };
  struct Box {
    float low[3];
    float size;  ///< edge of the cube
  };
  using Positions = std::vector<std::uint32_t>;  ///< in entries_, ascending
  static constexpr std::uint32_t kDivided = 0xffffffffu;
  static constexpr int kParts = 4;  ///< per axis

  [[gnu::always_inline]] inline std::uint32_t search(float r, float g, float b) const noexcept;
  void append_cells(std::uint32_t place, const Box& box, int cells, const Positions& among, int divisions);
  void append_cell(std::uint32_t place, const Box& box, const Positions& among, int divisions);
  Positions candidates_of(const Box& box, const Positions& among) const;

  float low_ = 0, high_ = 1;    ///< range of the searched components
  int cells_per_axis_ = 1;      ///< a power of two
  float scale_ = 1;             ///< cells per unit of a component
  std::vector<Entry> entries_;  ///< distinct colours, ordered by index
  std::vector<Cell> cells_;     ///< cells_per_axis_^3, then the parts of divided cells
  Positions candidates_;
};

}  // namespace tessera::detail
