#include "engine/program/compare/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "framebuffer/exact_functions.h"

namespace tessera::program {

std::uint64_t PictureErrors::pixels_over(int levels) const {
  std::uint64_t count = 0;
  for (std::size_t error = static_cast<std::size_t>(levels) + 1; error < pixels_by_error.size(); ++error)
    count += pixels_by_error[error];
  return count;
}

double PictureErrors::share_over(int levels) const {
  return static_cast<double>(pixels_over(levels)) / static_cast<double>(pixels);
}

PictureErrors picture_errors(const PixelView& picture, const PixelView& reference) {
  require_same_size(picture, reference);
  PictureErrors errors;
  errors.pixels = picture.pixel_count();
  std::uint64_t squares = 0;  // at most 3 * 255^2 * 2^28
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* const a = picture.pixel(x, y);
      const std::uint8_t* const b = reference.pixel(x, y);
      int worst = 0;
      for (int c = 0; c < 3; ++c) {
        const int difference = std::abs(int{a[c]} - int{b[c]});
        worst = std::max(worst, difference);
        squares += static_cast<std::uint64_t>(difference * difference);
      }
      ++errors.pixels_by_error[static_cast<std::size_t>(worst)];
      errors.largest = std::max(errors.largest, worst);
    }
  const double mean_square = static_cast<double>(squares) / (3 * static_cast<double>(errors.pixels));
  errors.rms = std::sqrt(mean_square);
  errors.psnr_db = squares == 0 ? std::numeric_limits<double>::infinity()
                                : 10 / std::numbers::ln10 * detail::natural_log(255.0 * 255.0 / mean_square);
  return errors;
}

UnroundedErrors unrounded_errors(const PixelView& picture, std::span<const float> reference) {
  if (reference.size() != 3 * picture.pixel_count())
    throw Error("the reference has " + std::to_string(reference.size()) + " components, the picture " +
                std::to_string(3 * picture.pixel_count()) + "; both must have the same number");
  UnroundedErrors errors;
  double squares = 0;
  auto expected = reference.begin();
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double difference = std::abs(picture.pixel(x, y)[c] - 255.0 * static_cast<double>(*expected++));
        errors.largest = std::max(errors.largest, difference);
        squares += difference * difference;
      }
  errors.rms = std::sqrt(squares / static_cast<double>(reference.size()));
  return errors;
}

}  // namespace tessera::program
