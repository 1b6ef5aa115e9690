// Rounding of colours to buffers of 1 to 24 bits: at every level, at every middle between two levels, and at
// the adjacent floats, for every source of colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <string>

#include "tests/numerics/bounds.h"
#include "tests/numerics/color_components.h"
#include "tests/numerics/exact.h"

namespace tessera::test::color_rounding_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Test components for b bits: levels, the middles between them, and the adjacent floats.
std::vector<float> telling_components(int bits) {
  std::vector<float> components{0, -0.0f, 1, std::numeric_limits<float>::denorm_min()};
  const int levels = (1 << bits) - 1;
  for (int half = 0; half <= 2 * levels; ++half) {
    const float at = static_cast<float>(static_cast<double>(half) / (2 * levels));
    for (const float c : {std::nextafter(at, -kInfinity), at, std::nextafter(at, kInfinity)})
      components.push_back(std::clamp(c, 0.0f, 1.0f));
  }
  return components;
}

/// A source of colours: draws or clears one pixel of the bottom row.
struct Source {
  const char* name;
  std::function<void(Frame&, int x, const Color&)> put;
};

Rect pixel(int x) { return {x, 0, 1, 1}; }

/// Owns borrowed meshes; must outlive the frame.
class Meshes {
 public:
  const MeshData& window(const Color& color) {
    MeshData& mesh = meshes_.emplace_back(whole_window());
    for (int v = 0; v < 4; ++v) mesh.colors.insert(mesh.colors.end(), {color.r, color.g, color.b, color.a});
    return mesh;
  }

 private:
  std::deque<MeshData> meshes_;
};

std::vector<Source> sources(Meshes& meshes) {
  static const MeshData all = whole_window();
  const auto unlit_at = [](int x, const Color& color) {
    DrawState state = unlit(color);
    state.scissor = pixel(x);
    return state;
  };
  const auto vertices = [&meshes, unlit_at](Frame& frame, int x, const Color& color,
                                            const std::function<void(DrawState&)>& change) {
    DrawState state = unlit_at(x, {});
    change(state);
    frame.draw(meshes.window(color).view(), state);
  };
  return {
      {"clear", [](Frame& f, int x, const Color& c) { f.clear({.color = c, .scissor = pixel(x)}); }},
      {"one colour", [=](Frame& f, int x, const Color& c) { f.draw(all.view(), unlit_at(x, c)); }},
      {"emission",
       [=](Frame& f, int x, const Color& c) {
         DrawState state = unlit_at(x, {0, 0, 0, c.a});
         state.lighting = true;
         state.material.ambient = {0, 0, 0, 1};
         state.material.emission = c;
         f.draw(all.view(), state);
       }},
      {"vertices, interpolated",
       [=](Frame& f, int x, const Color& c) { vertices(f, x, c, [](DrawState&) {}); }},
      {"vertices, flat",
       [=](Frame& f, int x, const Color& c) {
         vertices(f, x, c, [](DrawState& s) { s.shading = Shading::flat; });
       }},
      {"vertices, an operation that changes nothing",
       [=](Frame& f, int x, const Color& c) {
         vertices(f, x, c, [](DrawState& s) { s.alpha_test = AlphaTest{Compare::gequal, 0}; });
       }},
      {"material of the vertices, at each pixel",
       [=](Frame& f, int x, const Color& c) {
         vertices(f, x, c, [&c](DrawState& s) {
           s.lighting = true;
           s.shading = Shading::phong;
           s.color_material = ColorMaterial::emission;
           s.material.ambient = s.material.diffuse = {0, 0, 0, c.a};
         });
       }},
      {"blended",
       [=](Frame& f, int x, const Color& c) {
         DrawState state = unlit_at(x, c);
         state.blend =
             BlendState{.src = BlendFactor::one, .dst = BlendFactor::zero, .equation = BlendEquation::max};
         f.draw(all.view(), state);
       }},
      {"bitmap",
       [](Frame& f, int x, const Color& c) {
         static const std::uint8_t bit = 0x80;
         f.draw_bitmap({.bits = &bit, .width = 1, .height = 1, .x = static_cast<double>(x), .color = c});
       }},
  };
}

/// Calls check(source, colours, words) for every colour depth and sample count.
template <class Check>
void for_each_buffer(const std::function<std::vector<Color>(int)>& colors_of, int first_bits, int last_bits,
                     const Check& check) {
  for (int color_bits = first_bits; color_bits <= last_bits; ++color_bits)
    for (const int samples : {1, 4}) {
      const std::vector<Color> colors = colors_of(color_bits);
      const FrameBufferFormat format{.width = static_cast<int>(colors.size()),
                                     .height = 1,
                                     .color_bits = color_bits,
                                     .depth = DepthFormat::none,
                                     .alpha_bits = color_bits % 3 == 0 ? 8 : 0,
                                     .samples = samples};
      Renderer renderer({.threads = 1});
      Meshes meshes;
      for (const Source& source : sources(meshes)) {
        FrameBuffer buffer(format);
        Frame frame(buffer);
        for (std::size_t i = 0; i < colors.size(); ++i) source.put(frame, static_cast<int>(i), colors[i]);
        renderer.finish(frame);
        check(source.name, ComponentBits(format), colors, packed_colors(buffer));
        if (testing::Test::HasFatalFailure()) return;
      }
    }
}

// The component times the level count, plus a half, is below 2^bits and is rounded to float once before its
// fraction is cut off.
long double beyond_half(int bits) { return std::ldexp(1.0L, bits - 25); }

TEST(ColorRounding, RoundsEachComponentToTheNearestLevel) {
  std::array<long double, 9> worst{};
  const auto colors = [](int color_bits) {
    const ComponentBits split(color_bits, 8);
    std::vector<Color> all;
    std::array<std::vector<float>, 4> c;
    for (std::size_t k = 0; k < 4; ++k) c[k] = telling_components(split.bits[k]);
    for (std::size_t i = 0;
         i < std::max({c[0].size(), c[1].size(), c[2].size(), color_bits % 3 == 0 ? c[3].size() : 0}); ++i)
      all.push_back(
          {c[0][i % c[0].size()], c[1][i % c[1].size()], c[2][i % c[2].size()], c[3][i % c[3].size()]});
    return all;
  };
  for_each_buffer(colors, 3, 24,
                  [&](const char* source, const ComponentBits& split, const std::vector<Color>& found,
                      const std::vector<std::uint32_t>& words) {
                    for (std::size_t i = 0; i < words.size(); ++i) {
                      const float components[] = {found[i].r, found[i].g, found[i].b, found[i].a};
                      for (std::size_t c = 0; c < 4; ++c) {
                        if (split.bits[c] == 0) continue;
                        const std::int64_t level = split.level(words[i], c);
                        // 24 + 8 bits: exact.
                        const double exact = static_cast<double>(components[c]) * split.levels(c);
                        const long double off = std::abs(static_cast<long double>(level) - exact);
                        ASSERT_LE(off, 0.5L + beyond_half(split.bits[c]))
                            << source << ": " << components[c] << " of component " << c << " is level "
                            << level << " of " << split.levels(c);
                        update_worst(worst[static_cast<std::size_t>(split.bits[c])], off);
                      }
                    }
                  });
  for (const int bits : {1, 5, 8})
    expect_within("colour of " + std::to_string(bits) + " bits a component, beyond half a level",
                  std::max(0.0L, worst[static_cast<std::size_t>(bits)] - 0.5L), beyond_half(bits), "levels");
}

// 0.30 R + 0.59 G + 0.11 B. Errors: the float weights (at most 2^-26, 2^-25 and 2^-28), the product for blue
// (2^-28), two sums up to 1 (2^-25 each), and the final rounding above. In total 1.875 * 2^-24 of 1.0.
TEST(ColorRounding, RoundsLuminanceToTheNearestGrey) {
  for (const int color_bits : {1, 2}) {
    const long double bound = ((1 << color_bits) - 1) * 1.875L * 0x1p-24L + beyond_half(color_bits);
    long double worst = 0;
    const auto colors = [](int bits) {
      Random random(static_cast<std::uint64_t>(bits));
      std::vector<Color> all;
      const int levels = (1 << bits) - 1;
      for (int half = 0; half <= 2 * levels; ++half)
        for (int i = 0; i < 200; ++i) {
          // Greys, and colours whose luminance is close to `half` half levels, on either side.
          const double wanted = static_cast<double>(half) / (2 * levels);
          const float gray = static_cast<float>(wanted);
          const float r = random.between(0, 1);
          const float b = random.between(0, 1);
          const float g = static_cast<float>((wanted - 0.30 * r - 0.11 * b) / 0.59 +
                                             (i % 9 - 4) * (i % 2 == 0 ? 0x1p-25 : 0x1p-23));
          if (i < 3) all.push_back({gray, gray, gray, 1});
          else if (g >= 0 && g <= 1) all.push_back({r, g, b, 1});
        }
      return all;
    };
    for_each_buffer(colors, color_bits, color_bits,
                    [&](const char* source, const ComponentBits& split, const std::vector<Color>& found,
                        const std::vector<std::uint32_t>& words) {
                      for (std::size_t i = 0; i < words.size(); ++i) {
                        const Color& c = found[i];
                        const long double exact = split.levels(0) * (0.30L * c.r + 0.59L * c.g + 0.11L * c.b);
                        const long double off =
                            std::abs(static_cast<long double>(split.level(words[i], 0)) - exact);
                        ASSERT_LE(off, 0.5L + bound) << source << ": " << c.r << ", " << c.g << ", " << c.b;
                        update_worst(worst, off);
                      }
                    });
    expect_within("luminance of " + std::to_string(color_bits) + (color_bits > 1 ? " bits" : " bit") +
                      ", beyond half a level",
                  std::max(0.0L, worst - 0.5L), bound, "levels");
  }
}

// Texels and image pixels of 8 bits per component involve no earlier rounding: exactly the nearest level.
// None of them lies in the middle between two levels, since 255 (2 k + 1) is odd.
TEST(ColorRounding, RoundsImagesExactly) {
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 256; ++i)
    for (int c = 0; c < 4; ++c) texels.push_back(static_cast<std::uint8_t>((i * (2 * c + 1)) & 255));
  for (int color_bits = 3; color_bits <= 24; ++color_bits) {
    const FrameBufferFormat format{.width = 256, .height = 1, .color_bits = color_bits, .alpha_bits = 8};
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.draw_image({.pixels = texels.data(), .width = 256, .height = 1});
    Renderer({.threads = 1}).finish(frame);
    const auto words = packed_colors(buffer);
    const ComponentBits split(format);
    for (std::size_t i = 0; i < 256; ++i)
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_EQ(split.level(words[i], c),
                  static_cast<std::int64_t>(
                      (Ratio{std::int64_t{texels[4 * i + c]} * split.levels(c), 255}.rounded())))
            << color_bits;
  }
}

// Displayed byte of a stored level: round(255 v / (2^b - 1)).
TEST(ColorRounding, DisplaysLevelsExactly) {
  for (int color_bits = 1; color_bits <= 24; ++color_bits) {
    const ComponentBits split(color_bits, 0);
    const int width = 256;
    FrameBuffer buffer({.width = width, .height = 1, .color_bits = color_bits});
    Frame frame(buffer);
    for (int x = 0; x < width; ++x) {
      const float level = static_cast<float>(x % (split.levels(1) + 1)) / static_cast<float>(split.levels(1));
      frame.clear({.color = Color{level, level, level, 1}, .scissor = pixel(x)});
    }
    Renderer({.threads = 1}).finish(frame);
    const auto words = packed_colors(buffer);
    Image image(buffer);
    buffer.read_color(image.target());
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(image.bytes[4 * i + c],
                  static_cast<int>((Ratio{255 * split.level(words[i], c), split.levels(c)}.rounded())))
            << color_bits << " bits, word " << words[i];
  }
}

// Colour indices are rounded to the nearest integer, halves up, and wrap at 2^bits. This is exact for
// non-negative indices. For negative ones the sum with the modulus is first rounded to a 24-bit float.
TEST(ColorRounding, RoundsColorIndicesExactly) {
  double worst = 0;
  for (int bits = 1; bits <= 24; ++bits) {
    std::vector<float> indices{0,
                               -0.0f,
                               std::numeric_limits<float>::denorm_min(),
                               -std::numeric_limits<float>::denorm_min(),
                               1e9f,
                               -1e9f,
                               3e38f,
                               -3e38f};
    Random random(static_cast<std::uint64_t>(bits));
    for (int i = 0; i < 400; ++i) {
      const float whole =
          static_cast<float>(random.next() % (2u << bits)) - static_cast<float>(i % 4 == 3 ? 1u << bits : 0u);
      const float at = whole + (i % 2 == 0 ? 0.5f : 0.0f);
      indices.insert(indices.end(), {std::nextafter(at, -kInfinity), at, std::nextafter(at, kInfinity)});
    }
    for (const Shading shading : {Shading::flat, Shading::gouraud}) {
      FrameBuffer buffer({.width = static_cast<int>(indices.size()),
                          .height = 1,
                          .color_mode = ColorMode::index,
                          .color_bits = bits});
      Frame frame(buffer);
      std::deque<MeshData> meshes;
      for (std::size_t i = 0; i < indices.size(); ++i) {
        MeshData& mesh = meshes.emplace_back(whole_window());
        mesh.color_indices.assign(4, indices[i]);
        DrawState state = unlit({});
        state.shading = shading;
        state.depth.enabled = false;
        state.scissor = pixel(static_cast<int>(i));
        frame.draw(mesh.view(), state);
      }
      Renderer({.threads = 1}).finish(frame);
      const auto words = packed_colors(buffer);
      for (std::size_t i = 0; i < indices.size(); ++i) {
        const double index = static_cast<double>(indices[i]);
        const double modulus = std::ldexp(1.0, bits);
        if (index >= 0) {
          ASSERT_EQ(words[i], std::fmod(std::floor(index + 0.5), modulus))
              << indices[i] << " in " << bits << " bits";
          continue;
        }
        // Sums below 2^28 of terms above 2^-25: exact.
        const double off = std::abs(std::remainder(words[i] - index, modulus));
        ASSERT_LE(off, 0.5 + std::ldexp(1.0, bits - 25)) << indices[i] << " in " << bits << " bits";
        update_worst(worst, off - 0.5);
      }
    }
  }
  expect_within("indices below 0 in buffers of 1 to 24 bits, beyond half an index", worst, 0.5, "indices");
}

}  // namespace
}  // namespace tessera::test::color_rounding_test
