// Frequency responses of the filters of television encoders and decoders.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framebuffer/display/low_pass.h"

namespace tessera::low_pass_test {
namespace {

using namespace detail;

TEST(LowPass, GaussianPasses3DecibelsLessAtItsBandwidth) {
  for (const double bandwidth : {.007, .035, .09, .12}) {
    const SymmetricFilter filter = gaussian_low_pass(bandwidth);
    EXPECT_NEAR(filter.response(0), 1, 1e-12);
    EXPECT_NEAR(filter.response(bandwidth), std::sqrt(.5), 1e-3);
    EXPECT_NEAR(filter.response(2 * bandwidth), .25, 1e-3);  // the exponent grows with the square
  }
}

TEST(LowPass, SincHasTheTransitionThatItPromises) {
  for (const double bandwidth : {.1, .29, .35}) {
    const SymmetricFilter filter = sinc_low_pass(bandwidth, 24);
    const double half_transition = 1.65 / 49;
    EXPECT_NEAR(filter.response(bandwidth), .5, .005);
    for (double f = 0; f < .5; f += .001) {
      if (f < bandwidth - half_transition) {
        EXPECT_NEAR(filter.response(f), 1, .01) << f;
      }
      if (f > bandwidth + half_transition) {
        EXPECT_NEAR(filter.response(f), 0, .01) << f;
      }
    }
  }
  EXPECT_EQ(sinc_low_pass(.5, 24).radius(), 0);
  EXPECT_EQ(sinc_low_pass(.6, 24).response(.4), 1);
}

TEST(LowPass, QuarterFrequenciesAreBlocked) {
  for (const double bandwidth : {.007, .035, .07, .2}) {
    const SymmetricFilter plain = gaussian_low_pass(bandwidth), filter = without_quarter_frequencies(plain);
    EXPECT_NEAR(filter.response(0), 1, 1e-12);
    EXPECT_NEAR(filter.response(.25), 0, 1e-12);
    EXPECT_NEAR(filter.response(.5), 0, 1e-12);
    if (bandwidth > .05) continue;
    EXPECT_NEAR(filter.response(bandwidth), plain.response(bandwidth), 2e-3);
  }
}

/// Sum of a filter with sparse taps for the input sin(360 f k + degrees) at k = 0.
double output(const FilterTaps& filter, double frequency, double degrees) {
  double sum = 0;
  int k = filter.first;
  for (const float tap : filter.taps) {
    sum += static_cast<double>(tap) *
           std::sin(2 * std::numbers::pi * frequency * k + degrees * std::numbers::pi / 180);
    k += filter.step;
  }
  return sum;
}

TEST(LowPass, BandPassesTheSubcarrierAndQuadratureDelaysItByAQuarter) {
  const SymmetricFilter filter = without_quarter_frequencies(gaussian_low_pass(.035));
  for (const double degrees : {0.0, 30.0, 90.0, 200.0}) {
    const double sine = std::sin(degrees * std::numbers::pi / 180),
                 cosine = std::cos(degrees * std::numbers::pi / 180);
    EXPECT_NEAR(output(band_pass_taps(filter), .25, degrees), sine, 1e-6);
    EXPECT_NEAR(output(quadrature_taps(filter), .25, degrees), cosine, 1e-6);
    EXPECT_NEAR(output(band_pass_taps(filter), 0, degrees), 0, 1e-6);
    EXPECT_NEAR(output(quadrature_taps(filter), 0, degrees), 0, 1e-6);
    EXPECT_NEAR(output(all_taps(filter), 0, degrees), sine, 1e-6);
  }
}

}  // namespace
}  // namespace tessera::low_pass_test
