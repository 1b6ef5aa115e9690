// Colour spaces of displays, television and photographs, and conversions between them. Belongs to the library
// tessera::display (libtessera-display), which needs neither the renderer nor the library tessera::tessera.
//
//   using namespace tessera;
//   const ColorValues hsv = hsv_from_rgb({0.5, 1, 1});                              // {180, 0.5, 1}
//   const ColorValues lab = convert_color({0.5, 1, 1}, find_color_space("rgb")->space,
//                                         find_color_space("lab")->space);
//
// Conventions:
// - Values are double, three per colour, in the order of the space's name. Angles are in degrees.
// - R'G'B' (`rgb` in names of functions) is a signal, 0 to 1, related to light by a TransferCurve. RGB light
//   is linear. XYZ and RGB light are relative: white has Y = 1.
// - Nothing is clamped or rounded, except where a function says so: colours outside a space's range keep
//   their values and convert back.
//
// Precondition of all functions: values are finite and at most 1e6 in magnitude.
// Results are the same bits on every machine. No function throws; any thread may call any function.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "display_export.h"
#include "rgb_primaries.hpp"
#include "transfer_curve.hpp"

namespace tessera {

// Hue, saturation and brightness of R'G'B'. M and m are the greatest and least component, C = M - m.
// Hexagonal hue [Smith, Color Gamut Transform Pairs, SIGGRAPH 1978]: 60 (G - B) / C if M is R,
// 60 (B - R) / C + 120 if M is G, 60 (R - G) / C + 240 if M is B; 0 to 360, and 0 if C = 0.

/// Hexagonal hue, saturation C / M (0 if M = 0), value M.
TESSERA_DISPLAY_API ColorValues hsv_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_hsv(const ColorValues& hsv);

/// Hexagonal hue, saturation C / (1 - |2 L - 1|) (0 for black and white), lightness L = (M + m) / 2.
TESSERA_DISPLAY_API ColorValues hsl_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_hsl(const ColorValues& hsl);

/// Circular hue atan2(sqrt(3) (G - B) / 2, R - (G + B) / 2), saturation 1 - m / I (0 if I = 0), intensity
/// I = (R + G + B) / 3.
TESSERA_DISPLAY_API ColorValues hsi_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_hsi(const ColorValues& hsi);

/// Hexagonal hue, value M, chroma C. Not the HVC of Munsell or Tektronix.
TESSERA_DISPLAY_API ColorValues hvc_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_hvc(const ColorValues& hvc);

// Luma and colour differences of R'G'B'.

/// Y', U, V [SMPTE 170M]: Y' = .299 R' + .587 G' + .114 B', U = .492111 (B' - Y'), V = .877283 (R' - Y').
/// |U| is at most .43601, |V| at most .61498.
TESSERA_DISPLAY_API ColorValues yuv_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_yuv(const ColorValues& yuv);

/// Y', I, Q [SMPTE 170M]: U and V rotated by 33 degrees. |I| is at most .59590, |Q| at most .52274.
TESSERA_DISPLAY_API ColorValues yiq_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_yiq(const ColorValues& yiq);

/// Y', I, Q with the two-digit coefficients of the FCC, 1953: Y' = .30 R' + .59 G' + .11 B',
/// I = -.27 (B' - Y') + .74 (R' - Y'), Q = .41 (B' - Y') + .48 (R' - Y').
TESSERA_DISPLAY_API ColorValues yiq_1953_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_yiq_1953(const ColorValues& yiq);

/// PhotoYCC of a Photo CD: Y as for YUV, C1 = B' - Y, C2 = R' - Y. R'G'B' is a signal with the primaries and
/// the curve of BT.709. Source: Kodak, Photo CD article 4.
TESSERA_DISPLAY_API ColorValues photo_ycc_from_rgb(const ColorValues& rgb);
TESSERA_DISPLAY_API ColorValues rgb_from_photo_ycc(const ColorValues& ycc);

/// PhotoYCC in 8 bits: 255 / 1.402 Y, 111.40 C1 + 156 and 135.64 C2 + 137, each rounded to the nearest
/// integer and clamped to 0 .. 255.
TESSERA_DISPLAY_API ColorValues photo_ycc_8bit_from_photo_ycc(const ColorValues& ycc);
/// Values between integers are not rounded.
TESSERA_DISPLAY_API ColorValues photo_ycc_from_photo_ycc_8bit(const ColorValues& code);

/// Levels of an 8-bit display, by the constants that Kodak gave for displays with head room above white:
/// white is level 247. These are 0.969 of the levels that rgb_from_photo_ycc() gives, so this is not the
/// inverse of PhotoYCC. Source: Kodak, as quoted by Ford and Roberts, Colour Space Conversions, 1998.
TESSERA_DISPLAY_API ColorValues photo_cd_display_levels(const ColorValues& code);

// Colorimetric spaces.

/// CIELAB (CIE 15): L 0 to 100, a, b. XYZ of the white has Y = 1.
TESSERA_DISPLAY_API ColorValues lab_from_xyz(const ColorValues& xyz, Chromaticity white);
TESSERA_DISPLAY_API ColorValues xyz_from_lab(const ColorValues& lab, Chromaticity white);

/// OKLab (Ottosson 2020): L 0 to 1, a, b. From RGB light with the primaries of BT.709.
TESSERA_DISPLAY_API ColorValues oklab_from_light(const ColorValues& light);
TESSERA_DISPLAY_API ColorValues light_from_oklab(const ColorValues& oklab);

// Conversions between any two spaces.

/// The three values of a colour.
enum class ColorModel : std::uint8_t {
  rgb,
  hsv,
  hsl,
  hsi,
  hvc,
  yuv,
  yiq,
  yiq_1953,
  photo_ycc,
  photo_ycc_8bit,
  xyz,
  lab,
  oklab
};

/// A colour space. Default: sRGB.
struct ColorSpace {
  ColorModel model = ColorModel::rgb;
  /// Primaries of R'G'B' for rgb and the models of R'G'B'. lab and xyz use the white alone. photo_ycc and
  /// oklab require kBt709Primaries.
  RgbPrimaries primaries = kBt709Primaries;
  /// Curve of R'G'B', with white = 1; xyz, lab and oklab ignore it. photo_ycc requires BT.709's.
  TransferCurve curve{};
  /// Adaptation of colours of another white to this space's, and back.
  ChromaticAdaptation adaptation = ChromaticAdaptation::none;
};

/// Converts a colour.
/// - Models of R'G'B' with equal primaries and curves are converted by their formulas alone. All other
///   conversions go through light.
/// - By default light stays the same: the white of a display of 9300 K is bluish in sRGB. If either space has
///   an adaptation and the whites differ, the white of `from` becomes the white of `to`.
/// - photo_ycc_8bit rounds and clamps.
TESSERA_DISPLAY_API ColorValues convert_color(const ColorValues& values, const ColorSpace& from,
                                              const ColorSpace& to);

/// One of the three values of a space.
struct ColorComponent {
  std::string_view name;    ///< "H"
  std::string_view unit;    ///< "degrees"; empty: a plain number
  double min = 0, max = 1;  ///< range that sRGB's colours take, or all colours of the space
};

/// A colour space with a name.
struct NamedColorSpace {
  std::string_view name;  ///< "hsv"
  ColorSpace space;
  std::array<ColorComponent, 3> components;
  std::string_view description;
  std::string_view source;
};

/// All named spaces. The table is constant.
TESSERA_DISPLAY_API std::span<const NamedColorSpace> color_spaces();

/// Returns the space of that name, or nothing.
TESSERA_DISPLAY_API std::optional<NamedColorSpace> find_color_space(std::string_view name);

}  // namespace tessera
