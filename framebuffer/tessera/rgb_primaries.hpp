// Primaries and whites of RGB displays, and the matrices that follow from them. Part of the library
// tessera::display.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "display_export.h"

namespace tessera {

/// Three values of a colour; the space gives their meaning.
using ColorValues = std::array<double, 3>;

/// A 3 x 3 matrix for column vectors, in rows.
struct ColorMatrix {
  std::array<ColorValues, 3> rows{};
};

constexpr ColorValues operator*(const ColorMatrix& m, const ColorValues& v) {
  ColorValues product{};
  for (std::size_t i = 0; i < 3; ++i)
    product[i] = m.rows[i][0] * v[0] + m.rows[i][1] * v[1] + m.rows[i][2] * v[2];
  return product;
}
/// The matrix that applies `right` first.
constexpr ColorMatrix operator*(const ColorMatrix& left, const ColorMatrix& right) {
  ColorMatrix product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) product.rows[i][j] += left.rows[i][k] * right.rows[k][j];
  return product;
}
/// @pre the determinant is not 0
TESSERA_DISPLAY_API ColorMatrix inverse(const ColorMatrix& m);

/// Chromaticity coordinates of CIE 1931, y above 0.
struct Chromaticity {
  double x, y;
  friend constexpr bool operator==(const Chromaticity&, const Chromaticity&) = default;
};

inline constexpr Chromaticity kWhiteC{.310, .316};        ///< illuminant C, as in the FCC's rules of 1953
inline constexpr Chromaticity kWhiteD50{.3457, .3585};    ///< [CIE 15], the white of ICC profiles
inline constexpr Chromaticity kWhiteD65{.3127, .3290};    ///< [ITU-R BT.709]
inline constexpr Chromaticity kWhite9300K{.2831, .2971};  ///< default of computer monitors

/// Chromaticities of a display.
struct RgbPrimaries {
  Chromaticity red, green, blue, white;
  friend constexpr bool operator==(const RgbPrimaries&, const RgbPrimaries&) = default;
};

/// BT.709 and sRGB.
inline constexpr RgbPrimaries kBt709Primaries{{.640, .330}, {.300, .600}, {.150, .060}, kWhiteD65};
/// SMPTE C, SMPTE RP 145: North American television monitors.
inline constexpr RgbPrimaries kSmpteCPrimaries{{.630, .340}, {.310, .595}, {.155, .070}, kWhiteD65};
/// EBU Tech. 3213: European television monitors.
inline constexpr RgbPrimaries kEbuPrimaries{{.640, .330}, {.290, .600}, {.150, .060}, kWhiteD65};
/// FCC 1953: the first colour television receivers.
inline constexpr RgbPrimaries kNtsc1953Primaries{{.670, .330}, {.210, .710}, {.140, .080}, kWhiteC};
/// Trinitron monitor tube, within .03, measured on a Sony GDM-17SE1 [color.org]. The white is a setting:
/// kWhiteD65 or kWhite9300K.
inline constexpr RgbPrimaries kTrinitronPrimaries{{.621, .340}, {.281, .606}, {.152, .067}, kWhiteD65};
/// Hitachi CM2198 monitor tube, within .02 [color.org]. The white is a setting, as above.
inline constexpr RgbPrimaries kHitachiPrimaries{{.624, .339}, {.285, .604}, {.150, .065}, kWhiteD65};

/// XYZ of a chromaticity with Y = 1: (x / y, 1, (1 - x - y) / y).
TESSERA_DISPLAY_API ColorValues xyz_of(Chromaticity chromaticity);

/// Matrix from RGB light to XYZ; RGB (1, 1, 1) is the white with Y = 1. Source: SMPTE RP 177-1993.
TESSERA_DISPLAY_API ColorMatrix xyz_from_rgb_light(const RgbPrimaries& primaries);

/// How colours seen under one white become colours seen under another.
enum class ChromaticAdaptation : std::uint8_t {
  none,     ///< XYZ stays the same
  bradford  ///< Lam 1985, in the linear form of ICC.1 (annex E): cone responses scale with those of the
            ///< whites
};

/// Matrix from XYZ under the white `from` to XYZ under the white `to`.
TESSERA_DISPLAY_API ColorMatrix adaptation_matrix(Chromaticity from, Chromaticity to,
                                                  ChromaticAdaptation adaptation);

}  // namespace tessera
