#include "framebuffer/display/low_pass.h"

#include <cmath>
#include <numbers>

#include "framebuffer/exact_functions.h"
#include "framebuffer/trigonometry.h"

namespace tessera::detail {
namespace {

void normalize(SymmetricFilter& filter) {
  const double gain = filter.response(0);
  for (double& tap : filter.half) tap /= gain;
}

/// cos(90 j degrees)
int quarter_cosine(int j) {
  if (j % 2 != 0) return 0;
  return j % 4 == 0 ? 1 : -1;
}

}  // namespace

double SymmetricFilter::response(double frequency) const {
  double sum = half[0];
  for (int j = 1; j <= radius(); ++j) sum += 2 * tap(j) * sine_cosine(360 * frequency * j).cosine;
  return sum;
}

SymmetricFilter gaussian_low_pass(double bandwidth) {
  // exp(-2 pi^2 sigma^2 bandwidth^2) = sqrt(1/2)
  const double sigma = std::sqrt(std::numbers::ln2) / (2 * std::numbers::pi * bandwidth);
  SymmetricFilter filter;
  for (int j = 1; j <= static_cast<int>(std::ceil(4 * sigma)); ++j)
    filter.half.push_back(exponential(-j * j / (2 * sigma * sigma)));
  normalize(filter);
  return filter;
}

SymmetricFilter sinc_low_pass(double bandwidth, int radius) {
  if (bandwidth >= .5) return {};
  SymmetricFilter filter{{2 * bandwidth}};
  for (int j = 1; j <= radius; ++j) {
    const double sinc = sine_cosine(360 * bandwidth * j).sine / (std::numbers::pi * j);
    const double window = .54 + .46 * sine_cosine(180.0 * j / (radius + 1)).cosine;
    filter.half.push_back(sinc * window);
  }
  normalize(filter);
  return filter;
}

SymmetricFilter without_quarter_frequencies(const SymmetricFilter& filter) {
  // Responses of the sum filter + a (filter, shifted by +-1/4) + b (filter, shifted by 1/2) at 1/4 and 1/2,
  // as g1 = g(1/4), g2 = g(1/2) and g(0) = 1:
  //   0 = g1 + a (1 + g2) + b g1
  //   0 = g2 + a 2 g1 + b
  const double g1 = filter.response(.25), g2 = filter.response(.5);
  const double a = (g1 * g2 - g1) / (1 + g2 - 2 * g1 * g1);
  const double b = -g2 - 2 * a * g1;
  SymmetricFilter result = filter;
  for (int j = 0; j <= filter.radius(); ++j)
    result.half[static_cast<std::size_t>(j)] *= 1 + 2 * a * quarter_cosine(j) + (j % 2 == 0 ? b : -b);
  normalize(result);
  return result;
}

FilterTaps all_taps(const SymmetricFilter& filter) {
  FilterTaps result{.first = -filter.radius(), .step = 1};
  for (int j = -filter.radius(); j <= filter.radius(); ++j)
    result.taps.push_back(static_cast<float>(filter.tap(j)));
  return result;
}

FilterTaps band_pass_taps(const SymmetricFilter& low_pass) {
  const int reach = low_pass.radius() / 2 * 2;  // the last even tap
  FilterTaps result{.first = -reach, .step = 2};
  for (int j = -reach; j <= reach; j += 2)
    result.taps.push_back(static_cast<float>(2 * low_pass.tap(j) * quarter_cosine(j)));
  return result;
}

FilterTaps quadrature_taps(const SymmetricFilter& low_pass) {
  const int reach = (low_pass.radius() + 1) / 2 * 2 - 1;  // the last odd tap
  FilterTaps result{.first = -reach, .step = 2};
  for (int j = -reach; j <= reach; j += 2)
    result.taps.push_back(static_cast<float>(2 * low_pass.tap(j) * quarter_cosine(j - 1)));
  return result;
}

}  // namespace tessera::detail
