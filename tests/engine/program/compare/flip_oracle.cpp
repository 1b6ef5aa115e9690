#include "tests/engine/program/compare/flip_oracle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace tessera::program {
namespace {

constexpr double kPi = std::numbers::pi;

struct Triple {
  double x, y, z;
};

constexpr Triple kWhite{0.950428545377181, 1, 1.088900370798128};

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

Triple xyz_of(const Triple& rgb) {
  return {(10135552 * rgb.x + 8788810 * rgb.y + 4435075 * rgb.z) / 24577794,
          (2613072 * rgb.x + 8788810 * rgb.y + 887015 * rgb.z) / 12288897,
          (1425312 * rgb.x + 8788810 * rgb.y + 70074185 * rgb.z) / 73733382};
}

/// Solves xyz_of(rgb) = xyz by Gauss-Jordan elimination.
Triple rgb_of(const Triple& xyz) {
  double m[3][4];
  const Triple columns[3] = {xyz_of({1, 0, 0}), xyz_of({0, 1, 0}), xyz_of({0, 0, 1})};
  for (int j = 0; j < 3; ++j) {
    m[0][j] = columns[j].x;
    m[1][j] = columns[j].y;
    m[2][j] = columns[j].z;
  }
  m[0][3] = xyz.x;
  m[1][3] = xyz.y;
  m[2][3] = xyz.z;
  for (int pivot = 0; pivot < 3; ++pivot)
    for (int row = 0; row < 3; ++row) {
      if (row == pivot) continue;
      const double factor = m[row][pivot] / m[pivot][pivot];
      for (int j = 0; j < 4; ++j) m[row][j] -= factor * m[pivot][j];
    }
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

Triple ycxcz_of(const Triple& rgb) {
  const Triple xyz = xyz_of(rgb);
  const double x = xyz.x / kWhite.x, y = xyz.y / kWhite.y, z = xyz.z / kWhite.z;
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Triple hunt_lab_of(const Triple& rgb) {
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const Triple xyz = xyz_of(rgb);
  const double fx = f(xyz.x / kWhite.x), fy = f(xyz.y / kWhite.y), fz = f(xyz.z / kWhite.z);
  const double lightness = 116 * fy - 16;
  return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

double distance(const Triple& a, const Triple& b) {
  return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
}

/// Sum of weight(dx, dy) * value(x + dx, y + dy) over the square of the radius; positive weights are divided
/// by their sum, negative ones by the magnitude of theirs.
double filtered(const std::function<double(int, int)>& weight, int radius,
                const std::function<double(int, int)>& value, int x, int y) {
  double positive = 0, negative = 0, positive_sum = 0, negative_sum = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const double w = weight(dx, dy);
      (w > 0 ? positive_sum : negative_sum) += std::abs(w);
      (w > 0 ? positive : negative) += w * value(x + dx, y + dy);
    }
  return positive / positive_sum + (negative_sum > 0 ? negative / negative_sum : 0);
}

/// FLIP's view of one picture.
class Oracle {
 public:
  Oracle(const RgbPicture& picture, double ppd) : width_(picture.width), height_(picture.height), ppd_(ppd) {
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
      pixels_.push_back(ycxcz_of({linear(picture.rgb[i] / 255.0), linear(picture.rgb[i + 1] / 255.0),
                                  linear(picture.rgb[i + 2] / 255.0)}));
  }

  Triple color(int x, int y) const {
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd_));
    const auto gaussian = [this](double a, double b, int dx, int dy) {
      const double r2 = (dx * dx + dy * dy) / (ppd_ * ppd_);
      return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * r2 / b);
    };
    const Triple ycxcz{
        filtered([&](int dx, int dy) { return gaussian(1, 0.0047, dx, dy); }, radius,
                 [this](int px, int py) { return at(px, py).x; }, x, y),
        filtered([&](int dx, int dy) { return gaussian(1, 0.0053, dx, dy); }, radius,
                 [this](int px, int py) { return at(px, py).y; }, x, y),
        filtered([&](int dx, int dy) { return gaussian(34.1, 0.04, dx, dy) + gaussian(13.5, 0.025, dx, dy); },
                 radius, [this](int px, int py) { return at(px, py).z; }, x, y)};
    const double yy = (ycxcz.x + 16) / 116;
    const Triple rgb = rgb_of({(ycxcz.y / 500 + yy) * kWhite.x, yy, (yy - ycxcz.z / 200) * kWhite.z});
    return hunt_lab_of(
        {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
  }

  double edge(int x, int y) const {
    return magnitude([](double u, double) { return -u; }, x, y);
  }
  double point(int x, int y) const {
    return magnitude([](double u, double sigma) { return u * u / (sigma * sigma) - 1; }, x, y);
  }

 private:
  /// Pixels outside the picture repeat its border.
  const Triple& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(std::clamp(y, 0, height_ - 1)) *
                       static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(std::clamp(x, 0, width_ - 1))];
  }
  /// Norm of a derivative along x and along y.
  double magnitude(const std::function<double(double, double)>& derivative, int x, int y) const {
    const double sigma = 0.5 * 0.082 * ppd_;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto along = [&](bool vertical) {
      return filtered(
          [&](int dx, int dy) {
            return derivative(vertical ? dy : dx, sigma) *
                   std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
          },
          radius, [this](int px, int py) { return (at(px, py).x + 16) / 116; }, x, y);
    };
    return std::hypot(along(false), along(true));
  }

  int width_, height_;
  double ppd_;
  std::vector<Triple> pixels_;
};

}  // namespace

std::vector<double> flip_oracle(const RgbPicture& picture, const RgbPicture& reference,
                                double pixels_per_degree) {
  const Oracle a(picture, pixels_per_degree);
  const Oracle b(reference, pixels_per_degree);
  const double largest = distance(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1}));
  std::vector<double> errors;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double d = distance(a.color(x, y), b.color(x, y));
      const double color = d < 0.4 * largest ? d * 0.95 / (0.4 * largest)
                                             : 0.95 + 0.05 * (d - 0.4 * largest) / (largest - 0.4 * largest);
      const double feature =
          std::sqrt(std::max(std::abs(a.edge(x, y) - b.edge(x, y)), std::abs(a.point(x, y) - b.point(x, y))) /
                    std::sqrt(2.0));
      errors.push_back(std::pow(color, 1 - feature));
    }
  return errors;
}

}  // namespace tessera::program
