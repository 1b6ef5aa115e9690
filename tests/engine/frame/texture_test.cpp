// Textures through the public interface: refused images and draws, the texels shown, and mipmaps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "engine/record/texture_state.h"
#include "tests/engine/frame/texture_support.h"

namespace tessera::texture_test {
using namespace detail;
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string refused(const TextureImage& image, const TextureSampler& sampler = {}) {
  return error_of([&] { Texture texture(image, sampler); }).value_or("(no error)");
}

TEST(Texture, InvalidImagesAreRefused) {
  const Pixels pixels(4, 4, 4);
  TextureImage image = pixels.image();
  image.width = 0;
  EXPECT_EQ(refused(image), "Texture: the width is 0 texels, must be 1 to 16384");
  image.width = 4;
  image.height = -1;
  EXPECT_EQ(refused(image), "Texture: the height is -1 texels, must be 1 to 16384");
  image.height = kMaxTextureSize + 1;
  EXPECT_EQ(refused(image), "Texture: the height is 16385 texels, must be 1 to 16384");
  image.height = 4;
  image.channels = 5;
  EXPECT_EQ(refused(image), "Texture: the image has 5 channels, must be 1 to 4");
  image.channels = 0;
  EXPECT_EQ(refused(image), "Texture: the image has 0 channels, must be 1 to 4");
  image.channels = 4;
  image.pixels = nullptr;
  EXPECT_EQ(refused(image), "Texture: pixels is null, must point to 4x4 pixels");
  image = pixels.image();
  image.stride_bytes = 15;
  EXPECT_EQ(refused(image), "Texture: the rows are 15 bytes apart, but 16 bytes long");
  image.stride_bytes = -15;
  EXPECT_EQ(refused(image), "Texture: the rows are -15 bytes apart, but 16 bytes long");
  EXPECT_EQ(refused(pixels.image(), {.mag = TextureFilter::linear_mipmap_linear}),
            "Texture: mag is a filter with mipmaps, must be nearest or linear");
}

TEST(Texture, DrawsRefuseUnusableTextures) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  Texture texture(Pixels(2, 2, 3).image());
  MeshData mesh = textured_window();
  DrawState state = replacing(texture);
  state.texture_env_color.g = kNan;
  EXPECT_THAT(
      *error_of([&] { frame.draw(mesh.view(), state); }),
      AllOf(HasSubstr("Frame::draw: texture_env_color"), HasSubstr("nan"), HasSubstr("must be finite")));
  state.texture_env_color.g = 0;
  mesh.texcoords.pop_back();
  EXPECT_THAT(*error_of([&] { frame.draw(mesh.view(), state); }),
              HasSubstr("the mesh has 7 floats of texcoords, its 4 vertices need 8"));
  mesh = textured_window();
  const Texture moved = std::move(texture);
  EXPECT_EQ(*error_of([&] { frame.draw(mesh.view(), state); }), "Frame::draw: the texture was moved from");
  EXPECT_EQ(frame.draw_count(), 0u);
}

TEST(Texture, CanBeMovedBetweenDrawAndFinish) {
  const Pixels pixels(2, 2, 3);
  Texture texture(pixels.image(), kNearest);
  FrameBuffer buffer({.width = 2, .height = 2});
  Frame frame(buffer);
  const MeshData mesh = textured_window();
  frame.draw(mesh.view(), replacing(texture));
  const Texture moved = std::move(texture);
  EXPECT_EQ(moved.width(), 2);
  EXPECT_EQ(moved.channels(), 3);
  Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(packed_colors(buffer)[0] & 0xff, pixels.at(0, 0, 2));
}

TEST(Texture, NearestShowsEveryTexelForEveryNumberOfChannels) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Pixels pixels(9, 7, channels);
    const Texture texture(pixels.image(), kNearest);
    const std::vector<std::uint32_t> words =
        drawn(textured_window(), replacing(texture), {.width = 9, .height = 7, .alpha_bits = 8});
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) {
        const auto level = [&](int c) { return std::uint32_t{pixels.at(x, y, channels < 3 ? 0 : c)}; };
        std::uint32_t alpha = 255;
        if (channels == 2) alpha = pixels.at(x, y, 1);
        if (channels == 4) alpha = pixels.at(x, y, 3);
        EXPECT_EQ(words[static_cast<std::size_t>(9 * y + x)],
                  alpha << 24 | level(0) << 16 | level(1) << 8 | level(2))
            << channels << " channels, " << x << " " << y;
      }
  }
}

TEST(Texture, RowsMayHaveAnyOrderAndGaps) {
  const Pixels pixels(5, 6, 3);
  const Texture plain(pixels.image(), kNearest);
  const std::vector<std::uint32_t> expected =
      drawn(textured_window(), replacing(plain), {.width = 5, .height = 6});
  std::vector<std::uint8_t> spaced(6 * 20, 77);
  std::vector<std::uint8_t> upwards(6 * 20, 77);
  for (int y = 0; y < 6; ++y)
    for (int i = 0; i < 15; ++i)
      spaced[static_cast<std::size_t>(20 * y + i)] = upwards[static_cast<std::size_t>(20 * (5 - y) + i)] =
          pixels.bytes[static_cast<std::size_t>(15 * y + i)];
  TextureImage image{.pixels = spaced.data(), .width = 5, .height = 6, .channels = 3, .stride_bytes = 20};
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
  image.pixels = upwards.data();
  image.bottom_row_first = true;
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
  image.pixels = upwards.data() + 100;
  image.stride_bytes = -20;
  image.bottom_row_first = false;
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
}

// A texel of the next mipmap, by definition: the mean of the texels that it covers. In units of 1 / (w
// next_w) by 1 / (h next_h) of the image, texels of both sizes have integer borders.
std::uint32_t mean_of_cover(const std::vector<std::uint32_t>& from, std::int64_t w, std::int64_t h,
                            std::int64_t next_w, std::int64_t next_h, std::int64_t i, std::int64_t j) {
  std::uint32_t word = 0;
  for (int c = 0; c < 4; ++c) {
    std::int64_t sum = 0;
    for (std::int64_t y = 0; y < h; ++y)
      for (std::int64_t x = 0; x < w; ++x) {
        const std::int64_t across =
            std::max<std::int64_t>(0, std::min((i + 1) * w, (x + 1) * next_w) - std::max(i * w, x * next_w));
        const std::int64_t up =
            std::max<std::int64_t>(0, std::min((j + 1) * h, (y + 1) * next_h) - std::max(j * h, y * next_h));
        sum += across * up * (from[static_cast<std::size_t>(y * w + x)] >> (8 * c) & 0xff);
      }
    word |=
        static_cast<std::uint32_t>(std::floor(static_cast<double>(sum) / static_cast<double>(w * h) + 0.5))
        << (8 * c);
  }
  return word;
}

// Each level is shown by a draw in which one of its texels covers one pixel.
TEST(Texture, MipmapsAreMeansOfTheCoveredTexelsForAnySize) {
  constexpr int kSizes[][2] = {{16, 8}, {7, 5}, {33, 17}, {6, 1}, {1, 9}, {12, 10}, {3, 3}};
  for (const auto& [width, height] : kSizes) {
    const Pixels pixels(width, height, 4, 3);
    const Texture texture(pixels.image(),
                          {.mag = TextureFilter::nearest, .min = TextureFilter::nearest_mipmap_nearest});
    std::vector<std::uint32_t> level;  // rows from the bottom
    for (int y = height - 1; y >= 0; --y)
      for (int x = 0; x < width; ++x)
        level.push_back(static_cast<std::uint32_t>(pixels.at(x, y, 0) << 16 | pixels.at(x, y, 1) << 8 |
                                                   pixels.at(x, y, 2)) |
                        static_cast<std::uint32_t>(pixels.at(x, y, 3)) << 24);
    for (int w = width, h = height; w > 1 || h > 1;) {
      const int next_w = std::max(w / 2, 1);
      const int next_h = std::max(h / 2, 1);
      std::vector<std::uint32_t> next;
      for (int j = 0; j < next_h; ++j)
        for (int i = 0; i < next_w; ++i) next.push_back(mean_of_cover(level, w, h, next_w, next_h, i, j));
      level = next;
      w = next_w;
      h = next_h;
      // The level of detail must round to this level.
      const double detail = std::log2(
          std::max(static_cast<double>(width) / w, height > 1 ? static_cast<double>(height) / h : 0.0));
      int wanted = 0;
      for (int size = std::max(width, height); size > std::max(w, h); size /= 2) ++wanted;
      if (std::abs(detail - wanted) > 0.45) continue;
      const std::vector<std::uint32_t> words =
          drawn(textured_window(), replacing(texture), {.width = w, .height = h, .alpha_bits = 8});
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          EXPECT_EQ(words[static_cast<std::size_t>(y * w + x)],
                    level[static_cast<std::size_t>((h - 1 - y) * w + x)])
              << width << "x" << height << " as " << w << "x" << h << ", " << x << " " << y;
    }
  }
}

TEST(Texture, OneRowIgnoresT) {
  const Pixels pixels(8, 1, 3);
  for (const TextureFilter filter :
       {TextureFilter::nearest, TextureFilter::linear, TextureFilter::linear_mipmap_linear}) {
    const Texture texture(
        pixels.image(),
        {.mag = filter == TextureFilter::nearest ? filter : TextureFilter::linear, .min = filter});
    EXPECT_EQ(drawn(textured_window(1, 40), replacing(texture), {.width = 16, .height = 16}),
              drawn(textured_window(1, 0), replacing(texture), {.width = 16, .height = 16}));
  }
}

}  // namespace
}  // namespace tessera::texture_test
