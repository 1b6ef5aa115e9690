// The nearest entry of a palette, exactly.
//
// The cube of colours that are looked up is cut into cells; each cell keeps the entries that can be nearest
// to any point of it, so that a search looks at a handful of entries and still answers as if it had looked at
// all. Twin: palette_search_reference.h.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/palette.h"

namespace tessera::detail {

class PaletteSearch {
 public:
  /// Builds the cells. Throws std::bad_alloc only. The palette need not outlive the call. 256 entries: about
  /// 1 ms.
  /// @param dithered  colours from -0.5 to 1.5 will be looked up
  explicit PaletteSearch(const Palette& palette, bool dithered = false);

  /// Index of the entry that was given (what is not set shows black, and nobody chose it) whose stored colour
  /// is nearest: the smallest squared distance of components 0..1 (stored value / 255), ties to the lowest
  /// index. Components are clamped to 0..1, a NaN counts as 0. Equals nearest_reference() bit for bit. Never
  /// fails; thread-safe.
  std::uint32_t nearest(float r, float g, float b) const noexcept;
  /// The same without clamping to 0..1: the colour that dither looks up may lie beyond, where other entries
  /// are nearest than to the cube's border. @pre the search is for dithered colours, and these are within its
  /// bounds
  std::uint32_t nearest_unclamped(float r, float g, float b) const noexcept;

 private:
  [[gnu::always_inline]] inline std::uint32_t search(float r, float g, float b) const noexcept;
  struct Entry {
    float r, g, b;
    std::uint32_t index;  ///< in the palette
    float squared_distance(float red, float green, float blue) const {
      const float dr = red - r, dg = green - g, db = blue - b;
      return dr * dr + dg * dg + db * db;
    }
  };
  float low_ = 0, high_ = 1;               ///< of the components that are looked up
  int cells_ = 1;                          ///< in each direction; a power of two
  float scale_ = 1;                        ///< cells for each 1 of a component
  std::vector<Entry> entries_;             ///< distinct colours, by index
  std::vector<std::uint32_t> cell_begin_;  ///< cells_^3 + 1 positions in candidates_
  std::vector<std::uint32_t> candidates_;  ///< positions in entries_, ascending in each cell
};

}  // namespace tessera::detail
