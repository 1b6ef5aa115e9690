// Palettes chosen for a picture: variance-based median cut, then k-means, in OKLab.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/color_counts.h"
#include "framebuffer/color_points.h"
#include "framebuffer/palette.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Size and colours of a palette that is to be chosen.
struct PaletteShape {
  std::size_t entries = 256;  ///< at least 1
  int component_bits = 8;     ///< bits of the converter, 1 to 8
};

/// Maximum number of colours that go into the choice of `entries` entries; see ColorCounts::at_most().
std::size_t palette_color_limit(std::size_t entries) noexcept;

/// The palette of a picture, dark to light.
/// - All entries are colours of the converter. No two are equal. There are fewer than asked for only if the
///   picture, with its components rounded to the converter's levels, has fewer colours; then they are these.
/// - The error of the clustering (k_means.h) is never above that of median cut alone.
/// - Same entries for every instruction set. Throws std::bad_alloc only.
/// @param picture  not empty
std::vector<Rgb8> adaptive_palette(const ColorCounts& picture, const PaletteShape& shape, InstructionSet isa);

}  // namespace tessera::detail
