#include "framebuffer/median_cut.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

namespace tessera::detail {

namespace {

using Vector = std::array<double, 3>;

/// Weighted sums over points.
struct Moments {
  double weight = 0;
  Vector sum{};
  double squares = 0;

  void add(const Vector& p, double w) noexcept {
    weight += w;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += w * p[i];
      squares += w * p[i] * p[i];
    }
  }
  double squared_sum_over_weight() const noexcept {
    return (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / weight;
  }
  /// Sum of squared distances to the mean.
  double spread() const noexcept { return squares - squared_sum_over_weight(); }
  Vector mean() const noexcept { return {sum[0] / weight, sum[1] / weight, sum[2] / weight}; }
};

/// Coordinates in which distances are taken.
Vector point_at(const ColorPoints& points, std::uint32_t i) noexcept {
  return {points.l[i], points.a[i], points.b[i]};
}

/// A group of points: a range of the order.
struct Box {
  std::size_t begin = 0, end = 0;
  Moments moments;
  double spread = 0;
};

class Cutter {
 public:
  explicit Cutter(const ColorPoints& points) : points_(points), order_(points.count), keys_(points.count) {
    std::iota(order_.begin(), order_.end(), 0u);
    boxes_.push_back(box_of(0, points.count));
  }

  const std::vector<Box>& boxes() const noexcept { return boxes_; }

  /// Splits the box with the largest spread. Returns false if none has two points.
  bool split() {
    Box* widest = nullptr;
    for (Box& box : boxes_)
      if (box.end - box.begin > 1 && (!widest || box.spread > widest->spread)) widest = &box;
    if (!widest) return false;
    const Box box = *widest;
    sort_along(principal_axis(box), box);
    const std::size_t cut = best_cut(box);
    *widest = box_of(box.begin, cut);
    boxes_.push_back(box_of(cut, box.end));
    return true;
  }

 private:
  Box box_of(std::size_t begin, std::size_t end) const {
    Box box{.begin = begin, .end = end, .moments = {}};
    for (std::size_t i = begin; i < end; ++i)
      box.moments.add(point_at(points_, order_[i]), points_.weight[order_[i]]);
    box.spread = box.moments.spread();
    return box;
  }

  /// Direction of the largest variance, by power iteration on the covariances. Any length.
  Vector principal_axis(const Box& box) const {
    std::array<Vector, 3> covariance{};
    const Vector mean = box.moments.mean();
    for (std::size_t k = box.begin; k < box.end; ++k) {
      const Vector p = point_at(points_, order_[k]);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          covariance[i][j] += points_.weight[order_[k]] * (p[i] - mean[i]) * (p[j] - mean[j]);
    }
    std::size_t widest = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (covariance[i][i] > covariance[widest][widest]) widest = i;
    Vector axis = covariance[widest];
    constexpr int kSteps = 8;
    for (int step = 0; step < kSteps; ++step) {
      const double largest = std::max({axis[0], -axis[0], axis[1], -axis[1], axis[2], -axis[2]});
      if (!(largest > 0)) return {1, 0, 0};  // all points are equal
      for (double& component : axis) component /= largest;
      Vector next{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) next[i] += covariance[i][j] * axis[j];
      axis = next;
    }
    return axis;
  }

  void sort_along(const Vector& axis, const Box& box) {
    for (std::size_t i = box.begin; i < box.end; ++i) {
      const Vector p = point_at(points_, order_[i]);
      keys_[order_[i]] = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    }
    const auto position = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::sort(position(box.begin), position(box.end), [this](std::uint32_t i, std::uint32_t j) {
      return keys_[i] < keys_[j] || (keys_[i] == keys_[j] && i < j);
    });
  }

  /// First element of the second part, for which the sum of both spreads is smallest.
  std::size_t best_cut(const Box& box) const {
    Moments left;
    std::size_t best = box.begin + 1;
    double best_gain = -1;
    for (std::size_t i = box.begin; i + 1 < box.end; ++i) {
      left.add(point_at(points_, order_[i]), points_.weight[order_[i]]);
      Moments right{.weight = box.moments.weight - left.weight};
      for (std::size_t k = 0; k < 3; ++k) right.sum[k] = box.moments.sum[k] - left.sum[k];
      const double gain = left.squared_sum_over_weight() + right.squared_sum_over_weight();
      if (gain > best_gain) {
        best_gain = gain;
        best = i + 1;
      }
    }
    return best;
  }

  const ColorPoints& points_;
  std::vector<std::uint32_t> order_;
  std::vector<double> keys_;  ///< positions along the axis, by point
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<Oklab> median_cut(const ColorPoints& points, std::size_t count) {
  Cutter cutter(points);
  while (cutter.boxes().size() < count && cutter.split()) {}
  std::vector<Oklab> means;
  for (const Box& box : cutter.boxes()) {
    const Vector mean = box.moments.mean();
    means.push_back({mean[0], mean[1] / kChromaScale, mean[2] / kChromaScale});
  }
  return means;
}

}  // namespace tessera::detail
