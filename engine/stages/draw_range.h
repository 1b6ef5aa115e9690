// Tasks over the vertices or elements of several draws.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace tessera::detail {

/// Vertices or elements [first, last) of a draw.
struct DrawRange {
  std::size_t draw;
  std::size_t first, last;
};

/// Splits draws into ranges. Ranges are computed on access, not stored.
class DrawRanges {
 public:
  /// Splits count(draw) items of each draw into ranges of `range_size`; the last range of a draw may be
  /// shorter. Throws std::bad_alloc.
  /// @pre range_size > 0
  template <class Count>
  void split(std::size_t draws, const Count& count, std::size_t range_size) {
    range_size_ = range_size;
    size_ = 0;
    split_draws_.clear();
    for (std::size_t draw = 0; draw < draws; ++draw) {
      const std::size_t n = count(draw);
      if (n == 0) continue;
      split_draws_.push_back({draw, n, size_});
      size_ += (n + range_size - 1) / range_size;
    }
  }
  std::size_t size() const { return size_; }
  /// @pre i < size()
  DrawRange operator[](std::size_t i) const {
    const SplitDraw& split = *std::prev(
        std::upper_bound(split_draws_.begin(), split_draws_.end(), i,
                         [](std::size_t range, const SplitDraw& s) { return range < s.first_range; }));
    const std::size_t first = (i - split.first_range) * range_size_;
    return {split.draw, first, std::min(split.count, first + range_size_)};
  }

 private:
  struct SplitDraw {
    std::size_t draw;
    std::size_t count;  // items
    std::size_t first_range;
  };
  std::vector<SplitDraw> split_draws_;  // draws with at least one item
  std::size_t range_size_ = 1;
  std::size_t size_ = 0;
};

}  // namespace tessera::detail
