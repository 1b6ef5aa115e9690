// Layout of planes: bit 7 - x % 8 of byte x / 8 in a row of plane k is bit k of the pixel's stored value.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::frame_buffer_planes_test {
namespace {

using namespace test;

int bit_at(const PlaneView& plane, int x, int y) {
  return plane.bits[y * plane.stride_bytes + x / 8] >> (7 - x % 8) & 1;
}

// Plane bits equal the bits of the stored values; padding after a row's last pixel is 0.
void expect_literal_planes(const FrameBuffer& buffer, Buffer which, const std::vector<std::uint32_t>& words) {
  const int width = buffer.format().width, height = buffer.format().height;
  for (int k = 0; k < buffer.plane_count(which); ++k) {
    const PlaneView plane = buffer.plane(which, k);
    ASSERT_EQ(plane.width, width);
    ASSERT_EQ(plane.height, height);
    ASSERT_GE(plane.stride_bytes, (width + 7) / 8);
    int wrong = 0;
    int set_beyond = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < 8 * static_cast<int>(plane.stride_bytes); ++x) {
        if (x < width)
          wrong += bit_at(plane, x, y) !=
                   static_cast<int>(words[static_cast<std::size_t>(y * width + x)] >> k & 1);
        else set_beyond += bit_at(plane, x, y);
      }
    EXPECT_EQ(wrong, 0) << "plane " << k;
    EXPECT_EQ(set_beyond, 0) << "plane " << k;
  }
  EXPECT_LT(*std::max_element(words.begin(), words.end()), std::uint64_t{1} << buffer.plane_count(which));
}

void draw_random(FrameBuffer& buffer) {
  const RandomFrame random(buffer.format(), 200);
  Frame frame(buffer);
  random.record(frame);
  Renderer({.threads = 1}).finish(frame);
}

FrameBufferFormat format_of(ColorMode mode, int bits, DepthFormat depth = DepthFormat::none) {
  return {
      .width = 139, .height = 75, .color_mode = mode, .color_bits = bits, .depth = depth, .stencil_bits = 0};
}

TEST(FrameBufferPlanes, HoldTheBitsOfColorsAtEveryColorDepth) {
  for (int bits = 1; bits <= 24; ++bits) {
    SCOPED_TRACE(std::to_string(bits) + " bits");
    FrameBuffer buffer(format_of(ColorMode::rgb, bits));
    EXPECT_EQ(buffer.plane_count(Buffer::color), bits);
    draw_random(buffer);
    expect_literal_planes(buffer, Buffer::color, packed_colors(buffer));
  }
}

TEST(FrameBufferPlanes, HoldTheBitsOfIndicesInEveryIndexMode) {
  for (int bits = 1; bits <= 24; ++bits) {
    SCOPED_TRACE(std::to_string(bits) + " bits");
    FrameBuffer buffer(format_of(ColorMode::index, bits));
    draw_random(buffer);
    expect_literal_planes(buffer, Buffer::color, packed_colors(buffer));
  }
}

TEST(FrameBufferPlanes, HoldTheBitsOfDepthsInEveryFormat) {
  const std::pair<DepthFormat, int> formats[] = {{DepthFormat::none, 0},
                                                 {DepthFormat::unorm16, 16},
                                                 {DepthFormat::unorm24, 24},
                                                 {DepthFormat::unorm32, 32},
                                                 {DepthFormat::float32, 32}};
  for (const auto& [depth, bits] : formats) {
    SCOPED_TRACE(bits);
    FrameBuffer buffer(format_of(ColorMode::rgb, 24, depth));
    EXPECT_EQ(buffer.plane_count(Buffer::depth), bits);
    draw_random(buffer);
    if (depth == DepthFormat::none) continue;
    const std::vector<std::uint32_t> words = stored_depths(buffer);
    expect_literal_planes(buffer, Buffer::depth, words);
    std::vector<float> depths(words.size());
    buffer.read_depth(depths);
    const double levels = std::ldexp(1.0, bits) - 1;
    for (std::size_t i = 0; i < words.size(); ++i) {
      float expected = static_cast<float>(words[i] / levels);
      if (depth == DepthFormat::float32) std::memcpy(&expected, &words[i], sizeof expected);
      ASSERT_EQ(depths[i], expected) << i;
    }
    EXPECT_LT(*std::min_element(depths.begin(), depths.end()), 1.0f) << "something was drawn";
  }
}

TEST(FrameBufferPlanes, StencilPlanesHoldTheClearValue) {
  FrameBuffer buffer({.width = 21, .height = 9, .stencil_bits = 5});
  EXPECT_EQ(buffer.plane_count(Buffer::stencil), 5);
  Frame frame(buffer);
  frame.clear({.stencil = 21u});
  frame.clear({.stencil = 10u, .scissor = Rect{3, 2, 11, 4}});
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint8_t> values = stencil_values(buffer);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 21; ++x) {
      const int window_y = 8 - y;
      const bool inside = x >= 3 && x < 14 && window_y >= 2 && window_y < 6;
      EXPECT_EQ(values[static_cast<std::size_t>(21 * y + x)], inside ? 10 : 21) << x << ", " << y;
    }
  expect_literal_planes(buffer, Buffer::stencil, {values.begin(), values.end()});
}

TEST(FrameBufferPlanes, NewBufferHoldsColor0Depth1Stencil0) {
  for (const DepthFormat depth :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32}) {
    const FrameBuffer buffer({.width = 33, .height = 5, .depth = depth});
    std::vector<float> depths(33 * 5);
    buffer.read_depth(depths);
    for (const float d : depths) EXPECT_EQ(d, 1.0f);
    for (const std::uint32_t word : packed_colors(buffer)) EXPECT_EQ(word, 0u);
    for (const std::uint8_t value : stencil_values(buffer)) EXPECT_EQ(value, 0);
    expect_literal_planes(buffer, Buffer::color, packed_colors(buffer));
    expect_literal_planes(buffer, Buffer::depth, stored_depths(buffer));
  }
}

// Independent copy of the bit split and the rounding.
std::uint32_t level(double c, int bits) {
  return static_cast<std::uint32_t>(std::floor(c * ((1 << bits) - 1) + 0.5));
}
std::uint32_t expected_word(const Color& c, int bits) {
  const double r = c.r, g = c.g, b = c.b;
  if (bits <= 2) return level(0.30 * r + 0.59 * g + 0.11 * b, bits);
  const int each = bits / 3;
  const int g_bits = each + (bits % 3 > 0);
  const int r_bits = each + (bits % 3 > 1);
  return level(r, r_bits) << (g_bits + each) | level(g, g_bits) << each | level(b, each);
}
std::uint8_t expected_shown(std::uint32_t level, int bits) {
  return static_cast<std::uint8_t>(std::lround(255.0 * level / ((1 << bits) - 1)));
}

TEST(FrameBufferColors, SplitAndRoundAlikeInClearsDrawsAndScanOut) {
  Renderer renderer({.threads = 1});
  const MeshData all = whole_window();
  Random random(3);
  for (int bits = 1; bits <= 24; ++bits)
    for (int sample = 0; sample < 12; ++sample) {
      const Color color{random.between(0, 1), random.between(0, 1), random.between(0, 1), 1};
      const std::uint32_t expected = expected_word(color, bits);
      SCOPED_TRACE(std::to_string(bits) + " bits");
      FrameBuffer buffer({.width = 9, .height = 2, .color_bits = bits});
      Frame frame(buffer);
      frame.clear({.color = color});
      renderer.finish(frame);
      EXPECT_EQ(packed_colors(buffer), std::vector<std::uint32_t>(18, expected)) << "cleared";
      frame.clear({.color = Color{}});
      frame.draw(all.view(), unlit(color));
      renderer.finish(frame);
      EXPECT_EQ(packed_colors(buffer), std::vector<std::uint32_t>(18, expected)) << "drawn";

      Image image(buffer);
      buffer.read_color(image.target());
      const int each = bits / 3;
      const int g_bits = each + (bits % 3 > 0);
      const int r_bits = each + (bits % 3 > 1);
      std::uint8_t shown[4] = {0, 0, 0, 255};
      if (bits <= 2) {
        std::fill_n(shown, 3, expected_shown(expected, bits));
      } else {
        shown[0] = expected_shown(expected >> (g_bits + each), r_bits);
        shown[1] = expected_shown(expected >> each & ((1u << g_bits) - 1), g_bits);
        shown[2] = expected_shown(expected & ((1u << each) - 1), each);
      }
      for (std::size_t i = 0; i < image.bytes.size(); ++i) ASSERT_EQ(image.bytes[i], shown[i % 4]) << i;
    }
}

TEST(FrameBufferColors, IndexBufferStoresTheNearestEntryAndShowsUnsetEntriesBlack) {
  FrameBuffer buffer({.width = 4,
                      .height = 3,
                      .color_mode = ColorMode::index,
                      .color_bits = 3,
                      .palette = {{1, 1, 1, 1}, {1, 0, 0, 1}, {0, 0, 0.6f, 1}, {1, 0, 0, 1}}});
  Renderer renderer({.threads = 1});
  Frame frame(buffer);
  const auto word_of_clear = [&](const Clear& clear) {
    frame.clear(clear);
    renderer.finish(frame);
    return packed_colors(buffer)[0];
  };
  EXPECT_EQ(word_of_clear({.color = Color{0.9f, 0.8f, 0.9f, 1}}), 0u);
  EXPECT_EQ(word_of_clear({.color = Color{0.9f, 0.1f, 0.1f, 1}}), 1u) << "ties go to the lowest index";
  EXPECT_EQ(word_of_clear({.color = Color{0.1f, 0.1f, 0.5f, 1}}), 2u);
  EXPECT_EQ(word_of_clear({.color = Color{0, 0.1f, 0, 1}}), 2u)
      << "unset entries show black but are never chosen";
  EXPECT_EQ(word_of_clear({.index = 7u}), 7u);
  Image image(buffer);
  buffer.read_color(image.target());
  for (std::size_t i = 0; i < image.bytes.size(); ++i) EXPECT_EQ(image.bytes[i], i % 4 == 3 ? 255 : 0);
  frame.clear({.index = 2u});
  renderer.finish(frame);
  buffer.read_color(image.target());
  EXPECT_EQ(image.bytes[2], 153);
}

}  // namespace
}  // namespace tessera::frame_buffer_planes_test
