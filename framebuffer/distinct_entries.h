// Rounding of palette entries to the colours of a converter, so that no two become equal.
#pragma once

#include <vector>

#include "framebuffer/color_counts.h"
#include "framebuffer/color_points.h"
#include "framebuffer/converter_colors.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Rounds centres to distinct colours of a converter.
/// - A centre whose colour is taken by an earlier one is replaced by the rounded colour of the picture whose
///   error is largest; if the picture has no more colours, it is dropped.
/// @param colors  of the picture
/// @param points  the same colours
std::vector<Rgb8> distinct_entries(const ConverterColors& converter, const std::vector<Oklab>& centers,
                                   const std::vector<WeightedColor>& colors, const ColorPoints& points,
                                   InstructionSet isa);

/// The distinct colours of a picture with components rounded to the levels of a converter, in a fixed order.
std::vector<Rgb8> rounded_colors(const ConverterColors& converter, const std::vector<WeightedColor>& colors);

}  // namespace tessera::detail
