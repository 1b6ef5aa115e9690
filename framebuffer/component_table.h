// A function of a colour component as a table.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tessera::detail {

/// A function of a component 0..1, interpolated linearly between equidistant nodes.
class ComponentTable {
 public:
  /// @param function  called with the nodes 0, 1 / intervals, .. 1
  template <class Function>
  ComponentTable(int intervals, const Function& function) : intervals_(static_cast<float>(intervals)) {
    values_.reserve(static_cast<std::size_t>(intervals) + 2);
    for (int node = 0; node <= intervals; ++node)
      values_.push_back(static_cast<float>(function(static_cast<double>(node) / intervals)));
    values_.push_back(values_.back());  // right of the last node
  }

  /// Value at c, 0 to 1. The lanes of a kernel do the same.
  float at(float c) const {
    const float position = c * intervals_;
    const int node = static_cast<int>(position);
    const float left = values_[static_cast<std::size_t>(node)];
    const float right = values_[static_cast<std::size_t>(node) + 1];
    return std::fma(position - static_cast<float>(node), right - left, left);
  }

  float intervals() const { return intervals_; }
  const float* values() const { return values_.data(); }

 private:
  float intervals_;
  std::vector<float> values_;
};

}  // namespace tessera::detail
