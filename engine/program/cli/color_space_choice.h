// Colour spaces as `tessera color` names them: a name, for R'G'B' with parameters of its curve.
#pragma once

#include <string>
#include <string_view>

#include "framebuffer/tessera/color.hpp"

namespace tessera::program::cli {

/// Reads "NAME" or "NAME:KEY=VALUE,...".
/// - Keys, for spaces of R'G'B' and light: `curve` srgb, bt709, bt1886, bt1886-1, linear or an exponent from
///   0.1 to 10; `black` 0 to 0.99, the light of signal 0 over that of signal 1, for the BT.1886 curves.
/// @throws Error for other names, keys and values, with the nearest name
NamedColorSpace parse_color_space(std::string_view text);

/// The names of all spaces, separated by ", ".
std::string color_space_names();

/// The values of a space with their ranges and units, "H 0..360 degrees, S 0..1, V 0..1".
std::string components_text(const NamedColorSpace& named);

/// The formula and parameters of a curve, "sRGB" or "power 2.2".
std::string curve_text(const TransferCurve& curve);

}  // namespace tessera::program::cli
