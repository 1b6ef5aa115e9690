// Thresholds of ordered dither.
#pragma once

#include <cstddef>
#include <vector>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

inline constexpr int kMaxDitherSize = 64;  ///< pixels: the largest period of a pattern

/// Thresholds by position. A component c of b bits is stored as floor(c (2^b - 1) + threshold).
/// - bayer2, bayer4, bayer8, and pattern (4):
///     M_1 = [0],  M_2n = [[4 M_n, 4 M_n + 2], [4 M_n + 3, 4 M_n + 1]]
///     threshold = (M_n[y mod n][x mod n] + 0.5) / n^2
/// - blue_noise: (rank[y mod 64][x mod 64] + 0.5) / 64^2, see blue_noise.h.
/// - Others: 0.5, which rounds to nearest.
/// Rows y are counted from the lower edge of the window.
class DitherPattern {
 public:
  DitherPattern(Dither kind, int frame_height);

  int size() const { return size_; }        ///< period in pixels, a power of two; 1: no dither
  int columns() const { return columns_; }  ///< stored columns: size(), or 4 if that is more
  /// Threshold of a pixel, rows counted from the top.
  float at(int x, int y) const { return *four_from(x, y); }
  /// Thresholds of x to x + 3. @pre x is a multiple of 4; only the first is read otherwise
  const float* four_from(int x, int y) const {
    return &thresholds_[static_cast<std::size_t>((y & (size_ - 1)) * columns_ + (x & (columns_ - 1)))];
  }

 private:
  int size_;
  int columns_;                    ///< size_, or 4 if that is more
  std::vector<float> thresholds_;  ///< rows from the top of the frame
};

}  // namespace tessera::detail
