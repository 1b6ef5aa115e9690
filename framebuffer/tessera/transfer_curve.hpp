// Curves between a signal and light. Part of the library tessera::display.
#pragma once

#include <cstdint>

#include "display_export.h"

namespace tessera {

/// Formulas of curves, V the signal, L the light. All but bt1886 and bt1886_appendix_1 are odd: V(-L) =
/// -V(L).
enum class CurveFormula : std::uint8_t {
  srgb,    ///< IEC 61966-2-1: L = V / 12.92 up to 0.04045, else ((V + 0.055) / 1.055)^2.4
  bt709,   ///< cameras, BT.709: V = 4.5 L below 0.018, else 1.099 L^0.45 - 0.099; no V is in .081 to .0812
  bt1886,  ///< tubes, BT.1886: L = a max(V + b, 0)^2.4
  /// BT.1886, appendix 1, nearer to real tubes: L = a (V + b)^2.6 for V from 0.35, below it
  /// L = a (0.35 + b)^-0.4 max(V + b, 0)^3. For both tubes, a and b follow from white and black.
  bt1886_appendix_1,
  power,  ///< L = V^exponent
};

/// A curve with its parameters. Default: sRGB's.
struct TransferCurve {
  CurveFormula formula = CurveFormula::srgb;
  double exponent = 2.2;  ///< power: 0.1 to 10; 1 is linear. Other formulas ignore it
  /// Light of signal 1, in any unit, cd/m^2 for example; the other curves scale with it. Above 0.
  double white = 1;
  /// Light of signal 0, in the same unit; bt1886 and bt1886_appendix_1 only. 0 up to but not including white.
  double black = 0;
  friend constexpr bool operator==(const TransferCurve&, const TransferCurve&) = default;
};

/// Light of a signal, in the unit of `white`.
/// - Relative error: below 1e-12.
/// - Cost: a tenth of a microsecond or two; bt1886_appendix_1 with black above 0 takes fifty times as long.
///   Tabulate it for pictures.
TESSERA_DISPLAY_API double light_from_signal(const TransferCurve& curve, double signal);

/// Signal of a light. The inverse of light_from_signal(), except that the BT.1886 curves give the largest
/// signal without light, -b, for light up to 0.
TESSERA_DISPLAY_API double signal_from_light(const TransferCurve& curve, double light);

}  // namespace tessera
