// Interpolated values as stored, against perspective in long double through the snapped vertices: steep
// gradients, slivers, w ratios of 10^6, windows of 16,384 pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/case_renderer.h"
#include "tests/numerics/window_triangle.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::interpolation_test {
namespace {

struct Colored {
  WindowTriangle triangle;
  std::array<double, 3> w;
  std::array<std::array<float, 2>, 3> color;  // red and green; blue identifies the triangle of a pixel
};

struct Window {
  int width;
  int height;
  int frames;
};
constexpr Window kWindows[] = {{256, 256, 12}, {16384, 16, 2}, {16, 16384, 2}};

// Two bits each, so that products with window coordinates are exact floats.
double random_w(Rng& rng, int octaves) {
  return std::ldexp(rng.maybe() ? 1 : 1.5, static_cast<int>(rng.between(0, octaves)));
}

WindowTriangle somewhere(Rng& rng, WindowShape shape, const Window& window) {
  if (shape != WindowShape::small || rng.between(0, 3) == 0)
    return random_triangle(rng, shape, window.width, window.height);
  const int width = std::min(64, window.width), height = std::min(64, window.height);  // in the far corner
  WindowTriangle t = random_triangle(rng, shape, width, height);
  for (GridPoint& p : t.at)
    p = {p.x + (window.width - width) * kGrid, p.y + (window.height - height) * kGrid};
  return t;
}

using Colors = std::function<float(Rng&)>;

std::size_t triangles_per_frame(WindowShape shape) {
  switch (shape) {
    case WindowShape::any: return 8;
    case WindowShape::centers:
    case WindowShape::sliver: return 50;
    default: return 254;
  }
}

// Calls pixel(triangle, x, y, colour) for each visible pixel.
template <class Pixel>
void for_each_pixel(const MakeRenderer& make, WindowShape shape, int octaves, int rounds,
                    const Colors& colors, const Pixel& pixel) {
  Rng rng(80 + static_cast<std::uint32_t>(shape));
  std::size_t visible_pixels = 0;
  for (const Window& window : kWindows) {
    const auto renderer = make({.width = window.width, .height = window.height});
    const std::size_t count = triangles_per_frame(shape);
    for (int round = 0; round < rounds * window.frames; ++round) {
      std::vector<Colored> all;
      CaseDraw draw;
      for (std::size_t n = 0; n < count; ++n) {
        Colored t{.triangle = somewhere(rng, shape, window), .w = {}, .color = {}};
        for (std::size_t k = 0; k < 3; ++k) {
          t.w[k] = random_w(rng, octaves);
          for (const double c : {clip_x(t.triangle.at[k].x, window.width),
                                 clip_y(t.triangle.at[k].y, window.height), 0.0, 1.0})
            draw.positions.push_back(static_cast<float>(c * t.w[k]));
          for (float& c : t.color[k])
            c = k > 0 && rng.between(0, 3) == 0 ? t.color[0][static_cast<std::size_t>(&c - t.color[k].data())]
                                                : colors(rng);
          draw.colors.insert(draw.colors.end(),
                             {t.color[k][0], t.color[k][1], static_cast<float>(n + 1) / 255, 1});
        }
        all.push_back(t);
      }
      const CasePicture& picture = renderer->draw({draw});
      for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
          const std::array<float, 3>& color =
              picture.colors[static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) +
                             static_cast<std::size_t>(x)];
          const auto number = static_cast<std::size_t>(std::lround(color[2] * 255)) - 1;
          if (number >= all.size() || !all[number].triangle.contains(WindowTriangle::center(x, y))) continue;
          pixel(all[number], x, y, color);
          ++visible_pixels;
        }
    }
  }
  EXPECT_GT(visible_pixels, 50u);
}

long double level_of(float stored) { return std::floor(static_cast<long double>(stored) * 255 + 0.5L); }

const std::string kNames[] = {"small", "large", "on centres", "slivers", "needles"};
int rounds_of(bool is_tessera) { return is_tessera && long_tests() ? 40 : 1; }

TEST(Interpolation, ColorsAreWithinHalfALevelOfPerspective) {
  for (const int octaves : {0, 20})
    for (const WindowShape shape : kWindowShapes)
      expect_figure(
          "colours, triangles " + kNames[static_cast<std::size_t>(shape)] +
              (octaves == 0 ? "" : ", w apart by 10^6"),
          0.50059L, "levels", [&](const MakeRenderer& make, bool is_tessera) {
            long double worst = 0;
            for_each_pixel(
                make, shape, octaves, rounds_of(is_tessera),
                [](Rng& rng) { return static_cast<float>(rng.unit()); },
                [&](const Colored& t, int x, int y, const std::array<float, 3>& color) {
                  for (std::size_t c = 0; c < 2; ++c) {
                    long double sum = 0;
                    long double weights = 0;
                    for (std::size_t k = 0; k < 3; ++k) {
                      const long double weight =
                          static_cast<long double>(t.triangle.edge(k, WindowTriangle::center(x, y))) / t.w[k];
                      sum += weight * t.color[k][c];
                      weights += weight;
                    }
                    update_worst(worst, std::abs(level_of(color[c]) - 255 * sum / weights));
                  }
                });
            return worst;
          });
}

// Interpolation leaves the range of the vertices by at most 7 * 2^-24 of the largest value, here 256
// (interpolation_range_test.cpp). So a level beyond those of all vertices is stored only if a vertex is
// closer than that to the border between two levels.
constexpr float kHair = 0x1p-13f;
static_assert(7 * 0x1p-24 * 256 < kHair);

bool is_at_border(float color) {
  const float levels = std::fma(color, 255.0f, 0.5f);
  return levels - std::floor(levels) < kHair || levels - std::floor(levels) > 1 - kHair;
}
float off_borders(Rng& rng) {
  for (;;) {
    const float color = static_cast<float>(rng.unit());
    if (!is_at_border(color)) return color;
  }
}
// The smallest colour that stores as a level, or the float below it.
float at_border(Rng& rng) {
  const auto level = static_cast<float>(rng.between(1, 255));
  float c = (level - 0.5f) / 255;
  while (std::fma(c, 255.0f, 0.5f) < level) c = std::nextafter(c, 2.0f);
  while (std::fma(c, 255.0f, 0.5f) >= level) c = std::nextafter(c, 0.0f);
  return rng.maybe() ? c : std::nextafter(c, 2.0f);
}

TEST(Interpolation, ColorsStayInTheRangeOfTheVertices) {
  for (const bool borders : {false, true})
    for (const int octaves : {0, 20})
      expect_figure(
          std::string("colours") + (octaves == 0 ? "" : ", w apart by 10^6") +
              (borders ? ", of vertices between two levels" : "") + ", beyond the vertices' own",
          0, "levels", [&](const MakeRenderer& make, bool is_tessera) {
            long double worst = 0;
            for (const WindowShape shape : kWindowShapes)
              for_each_pixel(
                  make, shape, octaves, rounds_of(is_tessera), borders ? at_border : off_borders,
                  [&](const Colored& t, int, int, const std::array<float, 3>& color) {
                    for (std::size_t c = 0; c < 2; ++c) {
                      const auto [low, high] = std::minmax({t.color[0][c], t.color[1][c], t.color[2][c]});
                      const auto level = [](float each) {
                        return static_cast<long double>(std::floor(std::fma(each, 255.0f, 0.5f)));
                      };
                      update_worst(worst, level(low) - level_of(color[c]), level_of(color[c]) - level(high));
                    }
                  });
            return worst;
          });
}

// A texture of one row of 16 texels: the picture shows which texel was sampled, also at pixels whose centres
// lie on an edge or a vertex. Vertex coordinates lie exactly on texel borders, where the smallest error
// selects another texel, or 2^-20 inside, more than the 7 * 2^-24 of the roundings.
TEST(Interpolation, TextureCoordinatesSampleNoTexelOutsideTheRange) {
  constexpr int kTexels = 16;
  constexpr int kSide = 256;
  CaseFormat format{
      .width = kSide, .height = kSide, .texture_width = kTexels, .texture_height = 2, .nearest_texel = true};
  for (int i = 0; i < 2 * kTexels; ++i)
    format.texture.push_back(static_cast<std::uint8_t>(16 * (i % kTexels) + 8));
  for (const bool borders : {false, true})
    for (const int octaves : {0, 20})
      expect_figure(
          std::string("nearest texels") + (octaves == 0 ? "" : ", w apart by 10^6") +
              (borders ? ", of vertices on their borders" : "") + ", next to the range",
          0, "texels", [&](const MakeRenderer& make, bool is_tessera) {
            const auto renderer = make(format);
            Rng rng(90);
            long double worst = 0;
            long double visible_pixels = 0;
            for (int n = 0; n < (is_tessera && long_tests() ? 20000 : 300); ++n) {
              const WindowTriangle t = random_triangle(rng, WindowShape::centers, kSide, kSide);
              CaseDraw draw{.textured = true};
              std::array<std::int64_t, 3> texel{};
              for (std::size_t k = 0; k < 3; ++k) {
                texel[k] = k > 0 && rng.maybe() ? texel[k - 1] : rng.between(2, kTexels - 2);
                const double w = random_w(rng, octaves);
                for (const double c : {clip_x(t.at[k].x, kSide), clip_y(t.at[k].y, kSide), 0.0, 1.0})
                  draw.positions.push_back(static_cast<float>(c * w));
                draw.texcoords.insert(
                    draw.texcoords.end(),
                    {static_cast<float>(texel[k]) / kTexels + (borders ? 0 : 0x1p-20f), 0.25f});
              }
              const auto [low, high] = std::minmax({texel[0], texel[1], texel[2]});
              const CasePicture& picture = renderer->draw({draw});
              for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                  const float color = picture.colors[static_cast<std::size_t>(y * kSide + x)][0];
                  if (color == 0 || !t.contains(WindowTriangle::center(x, y))) continue;
                  const auto taken = static_cast<std::int64_t>(std::lround((color * 255 - 8) / 16));
                  update_worst(worst, low - taken, taken - high);
                  visible_pixels += 1;
                }
            }
            EXPECT_GT(visible_pixels, 1000);
            return worst;
          });
}

}  // namespace
}  // namespace tessera::test::interpolation_test
