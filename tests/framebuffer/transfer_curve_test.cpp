// Transfer curves: published values, long double, inverses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framebuffer/tessera/transfer_curve.hpp"

namespace tessera::transfer_curve_test {
namespace {

constexpr TransferCurve kTube{.formula = CurveFormula::bt1886, .white = 100, .black = .1};
constexpr TransferCurve kTwoPartTube{.formula = CurveFormula::bt1886_appendix_1, .white = 100, .black = .1};

double light_in_long_double(const TransferCurve& curve, long double v) {
  const auto power = [](long double x, long double e) { return x > 0 ? std::pow(x, e) : 0.0L; };
  long double light = 0;
  switch (curve.formula) {
    case CurveFormula::srgb: light = v <= .04045L ? v / 12.92L : power((v + .055L) / 1.055L, 2.4L); break;
    case CurveFormula::bt709: light = v < .081L ? v / 4.5L : power((v + .099L) / 1.099L, 1 / .45L); break;
    case CurveFormula::bt1886: {
      const long double white = power(curve.white, 1 / 2.4L), black = power(curve.black, 1 / 2.4L);
      return static_cast<double>(power(white - black, 2.4L) * power(v + black / (white - black), 2.4L));
    }
    default: light = power(v, curve.exponent);
  }
  return static_cast<double>(curve.white * light);
}

TEST(TransferCurve, SrgbHasItsKnownValues) {
  EXPECT_NEAR(light_from_signal({}, 128 / 255.0), .215861, .5001e-6);
  EXPECT_NEAR(light_from_signal({}, 188 / 255.0), .502886, .5001e-6);
}

TEST(TransferCurve, Bt1886HasItsKnownValues) {
  const double kSignals[] = {0, .1, .25, .5, .75, 1};
  const double kLights[] = {.1, 1.06379, 5.2185, 21.60491, 52.42083, 100};
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    EXPECT_NEAR(light_from_signal(kTube, kSignals[i]), kLights[i], .5001e-5);
    EXPECT_NEAR(signal_from_light(kTube, kLights[i]), kSignals[i], 1e-5);
  }
  EXPECT_NEAR(light_from_signal({.formula = CurveFormula::bt1886}, .5), std::pow(.5, 2.4), 1e-14);
}

TEST(TransferCurve, AgreesWithLongDouble) {
  const TransferCurve kCurves[] = {{},
                                   {.formula = CurveFormula::bt709},
                                   {.formula = CurveFormula::bt709, .white = 250},
                                   kTube,
                                   {.formula = CurveFormula::power, .exponent = 2.8},
                                   {.formula = CurveFormula::power, .exponent = 1}};
  for (const TransferCurve& curve : kCurves)
    for (int i = 0; i <= 4000; ++i) {
      const double signal = i / 3200.0;  // up to 1.25
      const double expected = light_in_long_double(curve, signal);
      ASSERT_NEAR(light_from_signal(curve, signal), expected, 1e-12 * expected) << signal;
    }
}

TEST(TransferCurve, TwoPartTubeHasItsExponentsAndLevels) {
  EXPECT_NEAR(light_from_signal(kTwoPartTube, 0), .1, 1e-13);
  EXPECT_NEAR(light_from_signal(kTwoPartTube, 1), 100, 1e-10);
  // Continuous where the exponent changes, and steeper below: with black 0, V^2.6 and V^3 0.35^-0.4.
  const TransferCurve without_black{.formula = CurveFormula::bt1886_appendix_1};
  for (const TransferCurve& curve : {kTwoPartTube, without_black})
    EXPECT_NEAR(light_from_signal(curve, std::nextafter(.35, 0)) / light_from_signal(curve, .35), 1, 1e-12);
  EXPECT_NEAR(light_from_signal(without_black, .7), std::pow(.7, 2.6), 1e-14);
  EXPECT_NEAR(light_from_signal(without_black, .2), std::pow(.2, 3.0) * std::pow(.35, -.4), 1e-14);
  // Logarithmic slopes with the lift b of black: 2.6 above, 3 below.
  const auto slope = [](double a, double b, double lift) {
    return std::log(light_from_signal(kTwoPartTube, b) / light_from_signal(kTwoPartTube, a)) /
           std::log((b + lift) / (a + lift));
  };
  const double lift = -signal_from_light(kTwoPartTube, 0);
  EXPECT_NEAR(slope(.5, .9, lift), 2.6, 1e-9);
  EXPECT_NEAR(slope(.1, .3, lift), 3, 1e-9);
}

TEST(TransferCurve, SignalsAreTheInverseOfLight) {
  const TransferCurve kCurves[] = {{},
                                   {.formula = CurveFormula::bt709},
                                   kTube,
                                   kTwoPartTube,
                                   {.formula = CurveFormula::bt1886},
                                   {.formula = CurveFormula::bt1886_appendix_1},
                                   {.formula = CurveFormula::power, .exponent = 2.2, .white = 80}};
  for (const TransferCurve& curve : kCurves)
    for (int i = 1; i <= 2000; ++i) {
      const double light = curve.white * i / 1600 + curve.black;
      const double back = light_from_signal(curve, signal_from_light(curve, light));
      // The two constants of sRGB's linear part, 0.04045 and 0.0031308, differ by 2e-8 of light.
      ASSERT_NEAR(back, light, 1e-11 * light + 3e-8 * curve.white) << light;
    }
}

TEST(TransferCurve, ContinuesBelowZero) {
  for (const CurveFormula formula : {CurveFormula::srgb, CurveFormula::bt709, CurveFormula::power})
    for (const double signal : {.01, .3, 1.2}) {
      const TransferCurve curve{.formula = formula};
      EXPECT_EQ(light_from_signal(curve, -signal), -light_from_signal(curve, signal));
      EXPECT_EQ(signal_from_light(curve, -signal), -signal_from_light(curve, signal));
    }
  EXPECT_EQ(light_from_signal(kTube, -1), 0);
  EXPECT_EQ(light_from_signal(kTwoPartTube, -1), 0);
  EXPECT_LT(signal_from_light(kTube, 0), 0);
  EXPECT_EQ(signal_from_light(kTube, -5), signal_from_light(kTube, 0));
}

}  // namespace
}  // namespace tessera::transfer_curve_test
