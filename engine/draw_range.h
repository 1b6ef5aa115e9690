// Work on several draws, cut into tasks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace tessera {

/// Vertices or elements [first, last) of a draw.
struct DrawRange {
  std::size_t draw, first, last;
};

/// The ranges that draws are cut into. Only whole draws are listed, not their ranges, which grow with the
/// scene: each is worked out when it is asked for.
class DrawRanges {
 public:
  /// Cuts `count(draw)` of each of so many draws into ranges of `each`; the last one of a draw may be
  /// shorter. Throws std::bad_alloc. @pre each > 0
  template <class Count>
  void cut(std::size_t draws, const Count& count, std::size_t each) {
    each_ = each;
    size_ = 0;
    cut_.clear();
    for (std::size_t draw = 0; draw < draws; ++draw) {
      const std::size_t n = count(draw);
      if (n == 0) continue;
      cut_.push_back({draw, n, size_});
      size_ += (n + each - 1) / each;
    }
  }
  std::size_t size() const { return size_; }
  /// @pre i < size()
  DrawRange operator[](std::size_t i) const {
    const Cut& cut = *std::prev(std::upper_bound(
        cut_.begin(), cut_.end(), i, [](std::size_t range, const Cut& c) { return range < c.first_range; }));
    const std::size_t first = (i - cut.first_range) * each_;
    return {cut.draw, first, std::min(cut.count, first + each_)};
  }

 private:
  struct Cut {
    std::size_t draw, count, first_range;
  };
  std::vector<Cut> cut_;  // draws of which there is something
  std::size_t each_ = 1, size_ = 0;
};

}  // namespace tessera
