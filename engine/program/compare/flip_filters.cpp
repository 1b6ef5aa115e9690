#include "engine/program/compare/flip_filters.h"

#include <cmath>
#include <numbers>

#include "framebuffer/exact_functions.h"

namespace tessera::program {
namespace {

constexpr double kPi = std::numbers::pi;

/// A term a exp(-b f^2) of a contrast sensitivity function; f in cycles per degree.
struct SensitivityTerm {
  double a, b;
};
constexpr SensitivityTerm kLuminanceTerm{1, 0.0047};
constexpr SensitivityTerm kRedGreenTerm{1, 0.0053};
constexpr SensitivityTerm kBlueYellowWide{34.1, 0.04};
constexpr SensitivityTerm kBlueYellowNarrow{13.5, 0.025};

/// Width of an edge or point that the eye detects, in degrees.
constexpr double kFeatureWidth = 0.082;

/// Samples the term's Gaussian in space, a sqrt(pi / b) exp(-pi^2 r^2 / b) with r^2 = x^2 + y^2 in degrees,
/// which is the product of two of these.
std::vector<double> separated(const SensitivityTerm& term, int radius, double pixels_per_degree) {
  std::vector<double> weights;
  for (int i = 0; i <= radius; ++i) {
    const double x = i / pixels_per_degree;
    weights.push_back(std::sqrt(term.a * std::sqrt(kPi / term.b)) *
                      detail::exponential(-kPi * kPi * x * x / term.b));
  }
  return weights;
}

/// Sum of an even filter over its offsets -radius .. radius.
double sum_of(const std::vector<double>& weights) {
  double sum = weights[0];
  for (std::size_t i = 1; i < weights.size(); ++i) sum += 2 * weights[i];
  return sum;
}

void divide(std::vector<double>& weights, double divisor) {
  for (double& weight : weights) weight /= divisor;
}

SymmetricFilter sensitivity_filter(const SensitivityTerm& term, int radius, double pixels_per_degree) {
  std::vector<double> weights = separated(term, radius, pixels_per_degree);
  divide(weights, sum_of(weights));
  return {weights};
}

void set_blue_yellow(FlipFilters& filters, int radius, double pixels_per_degree) {
  std::vector<double> narrow = separated(kBlueYellowNarrow, radius, pixels_per_degree);
  std::vector<double> wide = separated(kBlueYellowWide, radius, pixels_per_degree);
  // The weights of the sum of both two-dimensional filters sum to 1.
  const double total = std::sqrt(sum_of(narrow) * sum_of(narrow) + sum_of(wide) * sum_of(wide));
  divide(narrow, total);
  divide(wide, total);
  filters.blue_yellow_narrow = {narrow};
  filters.blue_yellow_wide = {wide};
}

/// A Gaussian and its derivatives. The positive and the negative weights of each derivative sum to 1 and -1.
void set_feature_filters(FlipFilters& filters, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> smooth, first, second;
  double first_sum = 0, second_positive = 0, second_negative = 0;
  for (int i = 0; i <= radius; ++i) {
    const double gaussian = detail::exponential(-(i * i) / (2 * sigma * sigma));
    smooth.push_back(gaussian);
    first.push_back(-i * gaussian);
    second.push_back((i * i / (sigma * sigma) - 1) * gaussian);
    first_sum += i * gaussian;
    (second[static_cast<std::size_t>(i)] > 0 ? second_positive : second_negative) +=
        (i == 0 ? 1 : 2) * std::abs(second[static_cast<std::size_t>(i)]);
  }
  divide(smooth, sum_of(smooth));
  divide(first, first_sum);
  for (double& weight : second) weight /= weight > 0 ? second_positive : second_negative;
  filters.smooth = {smooth};
  filters.first_derivative = {first, true};
  filters.second_derivative = {second};
}

/// The compiler turns the loops over a block into vector operations. kSign is 1 for even filters, -1 for odd.
template <int kSign>
void convolve_blocks(const std::vector<double>& weights, const double* in, std::ptrdiff_t step, double* out,
                     int count) {
  const auto radius = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  for (int x = 0; x < count; x += kFilterBlock) {
    const double* const at = in + x;
    double sum[kFilterBlock];
    for (int i = 0; i < kFilterBlock; ++i) sum[i] = weights[0] * at[i];
    for (std::ptrdiff_t k = 1; k <= radius; ++k) {
      const double weight = weights[static_cast<std::size_t>(k)];
      const double* const after = at + k * step;
      const double* const before = at - k * step;
      for (int i = 0; i < kFilterBlock; ++i) sum[i] += weight * (after[i] + kSign * before[i]);
    }
    for (int i = 0; i < kFilterBlock; ++i) out[x + i] = sum[i];
  }
}

}  // namespace

FlipFilters flip_filters(double pixels_per_degree) {
  FlipFilters filters;
  // Three standard deviations of the widest Gaussian.
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellowWide.b / (2 * kPi * kPi)) * pixels_per_degree));
  filters.luminance = sensitivity_filter(kLuminanceTerm, radius, pixels_per_degree);
  filters.red_green = sensitivity_filter(kRedGreenTerm, radius, pixels_per_degree);
  set_blue_yellow(filters, radius, pixels_per_degree);
  set_feature_filters(filters, pixels_per_degree);
  return filters;
}

void convolve(const SymmetricFilter& filter, const double* in, std::ptrdiff_t step, double* out, int count) {
  if (filter.odd) convolve_blocks<-1>(filter.weights, in, step, out, count);
  else convolve_blocks<1>(filter.weights, in, step, out, count);
}

}  // namespace tessera::program
