#include "framebuffer/dither_pattern.h"

#include <algorithm>

#include "framebuffer/blue_noise.h"

namespace tessera::detail {
namespace {

int size_of(Dither kind) {
  switch (kind) {
    case Dither::bayer2: return 2;
    case Dither::bayer4:
    case Dither::pattern: return 4;
    case Dither::bayer8: return 8;
    case Dither::blue_noise: return kBlueNoiseSize;
    default: return 1;
  }
}

/// Element of M_n, n a power of two.
int bayer_rank(int x, int y, int n) {
  static constexpr int kQuarters[2][2] = {{0, 2}, {3, 1}};
  int rank = 0;
  // The lowest bits of x and y select the quarter of the innermost 2x2, which has the greatest weight.
  for (int bit = 1, weight = n * n / 4; bit < n; bit *= 2, weight /= 4)
    rank += weight * kQuarters[(y & bit) != 0][(x & bit) != 0];
  return rank;
}

int rank_of(Dither kind, int x, int y, int size) {
  if (kind != Dither::blue_noise) return bayer_rank(x, y, size);
  return blue_noise_ranks()[static_cast<std::size_t>(y * size + x)];
}

}  // namespace

DitherPattern::DitherPattern(Dither kind, int frame_height)
    : size_(size_of(kind)), columns_(std::max(size_, 4)) {
  thresholds_.reserve(static_cast<std::size_t>(size_ * columns_));
  for (int y = 0; y < size_; ++y) {
    const int from_below = (frame_height - 1 - y) & (size_ - 1);
    for (int x = 0; x < columns_; ++x) {
      const int rank = rank_of(kind, x & (size_ - 1), from_below, size_);
      thresholds_.push_back((static_cast<float>(rank) + 0.5f) / static_cast<float>(size_ * size_));
    }
  }
}

}  // namespace tessera::detail
