#include "engine/buffers/view_depth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/record/checks.h"

namespace tessera::detail {

ViewDepth::ViewDepth(const Camera& camera, float background, const char* function)
    : reversed_(camera.reversed), background_(background) {
  require_finite({function, ": projection"}, camera.projection);
  const auto& m = camera.projection.m;
  const auto row = [&](std::size_t first) {
    std::string numbers = format_number(m[first]);
    for (std::size_t i = first + 1; i < first + 4; ++i) numbers += ", " + format_number(m[i]);
    return numbers;
  };
  const auto refuse = [&](const std::string& needed) {
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": projection's rows of z and w are " +
                                                 row(8) + " and " + row(12) + ", they must " + needed);
  };
  const bool z_depends_on_xy = m[8] != 0 || m[9] != 0;
  const bool w_depends_on_xy = m[12] != 0 || m[13] != 0;
  if (z_depends_on_xy || w_depends_on_xy) refuse("have 0 for x and y, or distinct depths have one distance");
  // Divide by the largest coefficient, so that products are finite; quotients do not change.
  const double largest = std::max({std::abs(m[10]), std::abs(m[11]), std::abs(m[14]), std::abs(m[15])});
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  const auto scaled = [&](double element) { return std::scalbn(element, exponent); };
  a_ = scaled(m[10]);
  b_ = scaled(m[11]);
  c_ = scaled(m[14]);
  e_ = scaled(m[15]);
  // If the products differ by more than their rounding (2^-53), no z yields 0/0.
  if (!(std::abs(a_ * e_ - b_ * c_) > 0x1p-50 * (std::abs(a_ * e_) + std::abs(b_ * c_))))
    refuse("not be multiples of each other, or all depths are the same");
}

float ViewDepth::at(double stored) const noexcept {
  if (stored == (reversed_ ? 0 : 1)) return background_;
  const double z_ndc = reversed_ ? stored : 2 * stored - 1;
  return static_cast<float>((e_ * z_ndc - b_) / (c_ * z_ndc - a_));
}

}  // namespace tessera::detail
