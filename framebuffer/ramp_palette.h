// Palettes chosen for the colours that lit materials can have: ramps between given colours.
#pragma once

#include <vector>

#include "framebuffer/adaptive_palette.h"
#include "framebuffer/palette.h"

namespace tessera::detail {

/// A stored colour before it is clamped to 0 to 1.
struct RampColor {
  double r = 0, g = 0, b = 0;
  friend constexpr bool operator==(const RampColor&, const RampColor&) = default;
};
/// Corners of a polyline: stored values between corners are linear, and then clamped to 0 to 1.
using ColorRamp = std::vector<RampColor>;

/// A palette of ramps and single colours, dark to light.
/// - Single colours and the ends of ramps have entries. The others are at equal distances along all ramps, by
///   their lengths in OKLab, as close together as the number of entries permits.
/// - If there are more single colours and ends than entries, the adaptive palette of all colours is returned.
/// - Entries are distinct colours of the converter. Fewer than asked for: all colours of the ramps are there.
/// - Same entries on every machine. Throws std::bad_alloc only.
/// @param ramps  at least one, with one corner or more; a single colour is a ramp of one corner
std::vector<Rgb8> ramp_palette(const std::vector<ColorRamp>& ramps, const PaletteShape& shape,
                               InstructionSet isa);

}  // namespace tessera::detail
