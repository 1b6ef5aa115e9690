#include "framebuffer/tessera/transfer_curve.hpp"

#include <algorithm>
#include <cmath>

#include "framebuffer/display/power.h"
#include "framebuffer/srgb.h"

namespace tessera {
namespace {

/// L = scale (V + lift)^exponent: a and b of BT.1886.
struct TubeParameters {
  double scale, lift;
};

// [ITU-R BT.1886, annex 1]
constexpr double kTubeExponent = 2.4;
TubeParameters tube_parameters(double white, double black) {
  const double white_root = detail::power(white, 1 / kTubeExponent);
  const double black_root = detail::power(black, 1 / kTubeExponent);
  return {detail::power(white_root - black_root, kTubeExponent), black_root / (white_root - black_root)};
}
double tube_light(const TubeParameters& tube, double signal) {
  return tube.scale * detail::power(signal + tube.lift, kTubeExponent);
}
double tube_signal(const TubeParameters& tube, double light) {
  return detail::power(light / tube.scale, 1 / kTubeExponent) - tube.lift;
}

// [ITU-R BT.1886, appendix 1]
constexpr double kBrightExponent = 2.6, kDarkExponent = 3.0, kDarkEnd = 0.35;

/// Light of signal 0 relative to that of signal 1, of a tube with the given lift.
double relative_black(double lift) {
  return detail::power(kDarkEnd + lift, kBrightExponent - kDarkExponent) *
         detail::power(lift, kDarkExponent) / detail::power(1 + lift, kBrightExponent);
}
/// The lift with that relative_black(), which increases. Bisection of lift / (1 + lift), 0 to 1.
double lift_of(double black) {
  if (black <= 0) return 0;
  double low = 0, high = 1;
  for (int step = 0; step < 53; ++step) {
    const double middle = (low + high) / 2;
    (relative_black(middle / (1 - middle)) < black ? low : high) = middle;
  }
  return low / (1 - low);
}
TubeParameters two_part_tube_parameters(double white, double black) {
  const double lift = lift_of(black / white);
  return {white / detail::power(1 + lift, kBrightExponent), lift};
}
double two_part_tube_light(const TubeParameters& tube, double signal) {
  const double lifted = signal + tube.lift;
  if (signal >= kDarkEnd) return tube.scale * detail::power(lifted, kBrightExponent);
  return tube.scale * detail::power(kDarkEnd + tube.lift, kBrightExponent - kDarkExponent) *
         detail::power(lifted, kDarkExponent);
}
double two_part_tube_signal(const TubeParameters& tube, double light) {
  const double bright = detail::power(light / tube.scale, 1 / kBrightExponent) - tube.lift;
  if (bright >= kDarkEnd) return bright;
  const double dark_scale = tube.scale * detail::power(kDarkEnd + tube.lift, kBrightExponent - kDarkExponent);
  return detail::power(light / dark_scale, 1 / kDarkExponent) - tube.lift;
}

// [ITU-R BT.709, 1.2]. Signals between 4.5 * 0.018 and 1.099 * 0.018^0.45 - 0.099 have no light.
constexpr double kCameraLinearEnd = 0.018;
double camera_signal(double light) {
  return light < kCameraLinearEnd ? 4.5 * light : 1.099 * detail::power(light, 0.45) - 0.099;
}
double camera_light(double signal) {
  const double linear = signal / 4.5;
  return linear < kCameraLinearEnd ? linear : detail::power((signal + 0.099) / 1.099, 1 / 0.45);
}

/// Light of a signal from 0 on, relative to white.
double relative_light(const TransferCurve& curve, double signal) {
  switch (curve.formula) {
    case CurveFormula::srgb: return detail::linear_from_srgb(signal);
    case CurveFormula::bt709: return camera_light(signal);
    default: return detail::power(signal, curve.exponent);
  }
}
double signal_of_relative_light(const TransferCurve& curve, double light) {
  switch (curve.formula) {
    case CurveFormula::srgb: return detail::srgb_from_linear(light);
    case CurveFormula::bt709: return camera_signal(light);
    default: return detail::power(light, 1 / curve.exponent);
  }
}

}  // namespace

double light_from_signal(const TransferCurve& curve, double signal) {
  if (curve.formula == CurveFormula::bt1886)
    return tube_light(tube_parameters(curve.white, curve.black), signal);
  if (curve.formula == CurveFormula::bt1886_appendix_1)
    return two_part_tube_light(two_part_tube_parameters(curve.white, curve.black), signal);
  return std::copysign(curve.white * relative_light(curve, std::abs(signal)), signal);
}

double signal_from_light(const TransferCurve& curve, double light) {
  if (curve.formula == CurveFormula::bt1886)
    return tube_signal(tube_parameters(curve.white, curve.black), light);
  if (curve.formula == CurveFormula::bt1886_appendix_1)
    return two_part_tube_signal(two_part_tube_parameters(curve.white, curve.black), light);
  return std::copysign(signal_of_relative_light(curve, std::abs(light) / curve.white), light);
}

}  // namespace tessera
