// The nearest mix of two palette entries, compared with a search over all mixes in double precision.
#include "framebuffer/palette_mixes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace tessera::detail::palette_mixes_test {
namespace {

using Vector = std::array<double, 3>;

double value_of(std::uint8_t level, const std::optional<LightCurve>& light) {
  return light ? light->light(level / 255.0) : level / 255.0;
}
Vector vector_of(Rgb8 c, const std::optional<LightCurve>& light) {
  return {value_of(c.r, light), value_of(c.g, light), value_of(c.b, light)};
}
double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
Vector mixed(const Vector& a, const Vector& b, int share, int steps) {
  Vector mix;
  for (std::size_t c = 0; c < 3; ++c) mix[c] = a[c] + (b[c] - a[c]) * share / steps;
  return mix;
}

Palette random_palette(std::mt19937& random, std::size_t entries) {
  Palette palette{.bits = 8, .entries = {}};
  const auto level = [&] { return static_cast<std::uint8_t>(random() >> 24); };
  for (std::size_t i = 0; i < entries; ++i) palette.entries.push_back({level(), level(), level()});
  return palette;
}

/// Whether a mix equals a color to half a level of each component.
bool is_equal(const Vector& mix, Rgb8 color, const std::optional<LightCurve>& light) {
  const std::uint8_t levels[] = {color.r, color.g, color.b};
  for (std::size_t c = 0; c < 3; ++c) {
    const int above = std::min(levels[c] + 1, 255), below = std::max(levels[c] - 1, 0);
    const double half = (value_of(static_cast<std::uint8_t>(above), light) -
                         value_of(static_cast<std::uint8_t>(below), light)) /
                        (2 * (above - below));
    if (std::abs(mix[c] - value_of(levels[c], light)) > half * (1 + 1e-5)) return false;
  }
  return true;
}

TEST(PaletteMixes, FindTheNearestMixOfAll) {
  std::mt19937 random(5);
  for (const std::optional<LightCurve>& light : {std::optional<LightCurve>{}, {LightCurve{}}})
    for (const std::size_t entries : {1u, 2u, 4u, 16u, 40u}) {
      const Palette palette = random_palette(random, entries);
      const int steps = entries > 16 ? 4 : 16;
      const PaletteMixes mixes(palette, light, steps);
      for (int round = 0; round < 200; ++round) {
        const Rgb8 color = random_palette(random, 1).entries[0];
        const Vector wanted = vector_of(color, light);
        double nearest = std::numeric_limits<double>::max(), closest_equal = nearest;
        for (const Rgb8 a : palette.entries)
          for (const Rgb8 b : palette.entries)
            for (int share = 0; share <= steps; ++share) {
              const Vector first = vector_of(a, light), second = vector_of(b, light);
              const Vector mix = mixed(first, second, share, steps);
              nearest = std::min(nearest, distance(mix, wanted));
              if (is_equal(mix, color, light))
                closest_equal = std::min(closest_equal, distance(first, second));
            }
        const PaletteMix found = mixes.nearest(color);
        const Vector first = vector_of(palette[found.first], light);
        const Vector second = vector_of(palette[found.second], light);
        const Vector mix = mixed(first, second, found.share, steps);
        if (is_equal(mix, color, light)) EXPECT_LE(distance(first, second), closest_equal + 1e-6);
        else EXPECT_LE(distance(mix, wanted), nearest + 1e-6);
        EXPECT_EQ(mixes.nearest(color), found) << "from the cache";
      }
    }
}

TEST(PaletteMixes, PlaceTheSecondEntryAtTheLowestRanks) {
  const Palette bw = default_palette_of(1);
  const PaletteMixes mixes(bw, std::nullopt, 16);
  for (int share = 0; share <= 16; ++share) {
    const float grey = static_cast<float>(share) / 16;
    int white = 0;
    for (int rank = 0; rank < 16; ++rank)
      white += mixes.entry(grey, grey, grey, (static_cast<float>(rank) + 0.5f) / 16) == 1;
    EXPECT_EQ(white, share);
  }
}

}  // namespace
}  // namespace tessera::detail::palette_mixes_test
