#include "perf/accuracy/enlarge.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tessera::accuracy {
namespace {

constexpr std::size_t kChannels = 4;

/// Position of a large pixel's centre between the centres of two small ones: at `first` plus weight / scale.
struct Place {
  int first;   ///< -1 before the first centre
  int weight;  ///< share of the pixel after `first`, in 1 / scale
};

// The centre of large pixel k is at (k + 1/2) / factor - 1/2 small pixels: (2 k + 1 - factor) / (2 factor).
Place place_of(int k, int factor) {
  const int scale = 2 * factor;
  const int position = 2 * k + 1 - factor + scale;  // plus one pixel, to divide a positive number
  return {position / scale - 1, position % scale};
}

/// Mixes two rows of a small picture: sums of weights `scale`.
void mix_rows(const program::Picture& small, Place place, int scale, std::vector<std::uint16_t>& mixed) {
  const std::size_t stride = kChannels * static_cast<std::size_t>(small.width);
  const auto row = [&](int y) {
    return &small.rgba[static_cast<std::size_t>(std::clamp(y, 0, small.height - 1)) * stride];
  };
  const std::uint8_t* const a = row(place.first);
  const std::uint8_t* const b = row(place.first + 1);
  for (std::size_t i = 0; i < stride; ++i)
    mixed[i] = static_cast<std::uint16_t>(a[i] * (scale - place.weight) + b[i] * place.weight);
}

}  // namespace

void enlarge(const program::Picture& small, int factor, program::Picture& large) {
  const int scale = 2 * factor;
  const unsigned half = static_cast<unsigned>(scale * scale) / 2;
  const unsigned shift = factor == 2 ? 4 : 6;  // log2(scale * scale)
  std::vector<std::uint16_t> mixed(kChannels * static_cast<std::size_t>(small.width));
  std::uint8_t* out = large.rgba.data();
  for (int y = 0; y < large.height; ++y) {
    mix_rows(small, place_of(y, factor), scale, mixed);
    for (int x = 0; x < large.width; ++x) {
      const Place place = place_of(x, factor);
      const auto a = kChannels * static_cast<std::size_t>(std::max(place.first, 0));
      const auto b = kChannels * static_cast<std::size_t>(std::min(place.first + 1, small.width - 1));
      const auto wb = static_cast<unsigned>(place.weight);
      const unsigned wa = static_cast<unsigned>(scale) - wb;
      for (std::size_t c = 0; c < kChannels; ++c)
        *out++ = static_cast<std::uint8_t>((mixed[a + c] * wa + mixed[b + c] * wb + half) >> shift);
    }
  }
}

}  // namespace tessera::accuracy
