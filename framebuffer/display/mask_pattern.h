// Patterns of the phosphors of colour tubes, drawn without moire.
#pragma once

#include "framebuffer/display/light_pattern.h"
#include "framebuffer/display/resample_table.h"
#include "framebuffer/tessera/display.hpp"

namespace tessera::detail {

/// Height of a slot with its bridge over the pitch, if not given. A default without a source.
inline constexpr double kDefaultSlotHeight = 2.5;

/// The pattern of one colour repeats in cells of width X and height Y that hold two phosphors: one at the
/// corner, one in the middle. Colours are shifted horizontally.
struct MaskCell {
  double width_mm, height_mm;
  double color_shift_mm;  ///< from red to green, and from green to blue
  double triad_mm;        ///< horizontal distance of columns of triads
};

/// @param mask  not none
MaskCell mask_cell(const CrtTube& tube);

/// Draws the pattern of a tube, its centre at (0, 0).
/// - The Fourier series of the pattern up to half of the sampling rate f = 1 / pixel_mm, with Fejer's weights
///   (1 - 2 |fx| / f)(1 - 2 |fy| / f): nothing aliases in pixels of that size, and values are never negative.
PatternTables mask_tables(const CrtTube& tube, const PixelGrid& columns, const PixelGrid& rows,
                          double pixel_mm);

}  // namespace tessera::detail
