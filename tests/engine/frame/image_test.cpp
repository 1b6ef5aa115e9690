// Images with zoom: the texel of each sample by an independent integer rule, and fragment operations that
// match those of triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::image_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 140, kHeight = 100;
// Units per pixel: samples, positions and zooms are multiples of 1/256.
constexpr std::int64_t kUnit = 256;

struct OwnImage {
  int width;
  int height;
  int channels;
  std::vector<std::uint8_t> levels;  // row by row from the lower left, without gaps
  std::vector<std::uint8_t> memory;
  PixelImage image;

  OwnImage(Random& random, int w, int h, int c) : width(w), height(h), channels(c) {
    const std::ptrdiff_t row = std::ptrdiff_t{w} * c;
    const std::ptrdiff_t pitch = row + below(random, 4);
    memory.assign(static_cast<std::size_t>(pitch * h), 0x55);
    const bool upwards = random.next() % 2 == 0;
    const std::ptrdiff_t top = upwards ? pitch * (h - 1) : 0;
    for (std::ptrdiff_t y = 0; y < h; ++y)
      for (std::ptrdiff_t i = 0; i < row; ++i) {
        levels.push_back(static_cast<std::uint8_t>(random.next()));
        memory[static_cast<std::size_t>(upwards ? pitch * y + i : pitch * (h - 1 - y) + i)] = levels.back();
      }
    image = {.pixels = memory.data() + top,
             .width = w,
             .height = h,
             .channels = c,
             .stride_bytes = upwards ? -pitch : pitch};
  }
  // r g b a
  std::array<std::uint8_t, 4> texel(std::int64_t x, std::int64_t y) const {
    const std::uint8_t* const at = &levels[static_cast<std::size_t>((y * width + x) * channels)];
    switch (channels) {
      case 1: return {at[0], at[0], at[0], 255};
      case 2: return {at[0], at[0], at[0], at[1]};
      case 3: return {at[0], at[1], at[2], 255};
      default: return {at[0], at[1], at[2], at[3]};
    }
  }
};

// Index of the texel that contains `place`; -1 if there is none. Texels begin at `start` and are |zoom| wide;
// they include the lower border and exclude the upper one.
std::int64_t texel_of(std::int64_t start, std::int64_t zoom, int count, std::int64_t place) {
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t a = start + zoom * n;
    const std::int64_t b = start + zoom * (n + 1);
    if (std::min(a, b) <= place && place < std::max(a, b)) return n;
  }
  return -1;
}

// In 1/16 pixel from the centre, y down.
std::vector<std::array<std::int64_t, 2>> pattern(int samples) {
  if (samples == 1) return {{0, 0}};
  if (samples == 4) return {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
  return {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
}

std::int64_t random_zoom(Random& random) {
  static constexpr std::int64_t kZooms[] = {256, 256, 512, 768, -256, -512,     128,       64,  -128,
                                            640, 333, -77, 1,   25,   256 * 40, -256 * 23, 257, 255};
  return kZooms[random.next() % std::size(kZooms)];
}

class Images : public testing::TestWithParam<int> {};

TEST_P(Images, ShowTheTexelsOfAnExactRule) {
  const int samples = GetParam();
  for (const int tile_size : {32, 64, 128})
    for (const InstructionSet set : available_instruction_sets()) {
      Random random(70 + static_cast<std::uint64_t>(samples));
      Renderer renderer({.threads = 2, .tile_size = tile_size, .instruction_set = set});
      FrameBuffer buffer({.width = kWidth, .height = kHeight, .samples = samples});
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      const auto offsets = pattern(samples);
      std::vector<std::array<std::uint8_t, 4>> stored(pixel_count(buffer) * offsets.size());
      std::vector<OwnImage> images;
      images.reserve(40);
      std::size_t differing = 0;
      for (int i = 0; i < 40; ++i) {
        OwnImage& own = images.emplace_back(random, 1 + static_cast<int>(below(random, 30)),
                                            1 + static_cast<int>(below(random, 30)), 1 + i % 4);
        const std::int64_t zoom_x = random_zoom(random), zoom_y = i % 3 == 0 ? zoom_x : random_zoom(random);
        const bool whole = i % 4 == 0;  // borders at whole and half pixels, on pixel centres
        const std::int64_t x =
            whole ? 128 * below(random, 2 * kWidth) : below(random, kUnit * (kWidth + 40)) - kUnit * 20;
        const std::int64_t y =
            whole ? 128 * below(random, 2 * kHeight) : below(random, kUnit * (kHeight + 40)) - kUnit * 20;
        own.image.x = static_cast<double>(x) / kUnit;
        own.image.y = static_cast<double>(y) / kUnit;
        own.image.zoom_x = static_cast<double>(zoom_x) / kUnit;
        own.image.zoom_y = static_cast<double>(zoom_y) / kUnit;
        frame.draw_image(own.image, {.depth = {.enabled = false}});
        for (std::int64_t row = 0; row < kHeight; ++row)
          for (std::size_t s = 0; s < offsets.size(); ++s) {
            const std::int64_t m =
                texel_of(y, zoom_y, own.height, kUnit * (kHeight - 1 - row) + 128 - 16 * offsets[s][1]);
            if (m < 0) continue;
            for (std::int64_t column = 0; column < kWidth; ++column) {
              const std::int64_t n =
                  texel_of(x, zoom_x, own.width, kUnit * column + 128 + 16 * offsets[s][0]);
              if (n >= 0)
                stored[static_cast<std::size_t>(row * kWidth + column) * offsets.size() + s] =
                    own.texel(n, m);
            }
          }
      }
      renderer.finish(frame);
      const std::vector<std::uint32_t> words = packed_colors(buffer);
      for (std::size_t i = 0; i < words.size(); ++i) {
        std::uint32_t expected = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          std::uint32_t sum = 0;
          for (std::size_t s = 0; s < offsets.size(); ++s) sum += stored[i * offsets.size() + s][c];
          const auto n = static_cast<std::uint32_t>(offsets.size());
          expected = expected << 8 | (2 * sum + n) / (2 * n);
        }
        for (std::size_t s = 1; s < offsets.size(); ++s)
          differing += stored[i * offsets.size() + s] == stored[i * offsets.size()] ? 0 : 1;
        ASSERT_EQ(words[i], expected) << i % kWidth << ' ' << i / kWidth << ", " << samples
                                      << " samples, tiles of " << tile_size << ", " << name(set);
      }
      if (samples > 1) {
        EXPECT_GT(differing, 1000u) << "samples of one pixel show different texels";
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, Images, testing::Values(1, 4, 8));

// Zooms and positions outside the integer rule: neighbouring texels share their border, however it is
// rounded.
TEST(Image, CoversEveryPixelExactlyOnce) {
  Random random(9);
  for (int turn = 0; turn < 300; ++turn) {
    const int width = 1 + static_cast<int>(below(random, 300));
    const int height = 1 + static_cast<int>(below(random, 3));
    const std::vector<std::uint8_t> ones(static_cast<std::size_t>(width * height), 1);
    PixelImage image{.pixels = ones.data(), .width = width, .height = height, .channels = 1};
    image.zoom_x = random.between(-1, 1) * std::pow(10.0, below(random, 6) - 3.0);
    image.zoom_y = 37.7;
    image.x = random.between(-20, kWidth);
    image.y = random.between(-9, 9);
    FrameBuffer buffer({.width = kWidth, .height = 8});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}});
    frame.draw_image(image, {.depth = {.enabled = false},
                             .blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one}});
    Renderer({.threads = 1}).finish(frame);
    const double a = image.x;
    const double b = image.x + image.zoom_x * width;
    const double bottom = image.y;
    const double top = image.y + image.zoom_y * height;
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const double x = column + 0.5, y = 7 - row + 0.5;
        const bool inside = std::min(a, b) <= x && x < std::max(a, b) && bottom <= y && y < top;
        ASSERT_EQ(words[static_cast<std::size_t>(row * kWidth + column)], inside ? 0x010101u : 0u)
            << turn << ": " << column << ' ' << row;
      }
  }
}

TEST(Image, SingleTexelPassesThroughEveryOperationLikeTriangles) {
  for (const FrameBufferFormat& format : operation_formats())
    for (int turn = 0; turn < 60; ++turn) {
      Random random(500 + static_cast<std::uint64_t>(turn));
      const Rect place = random_rect(random);
      std::uint8_t texel[4];
      for (std::uint8_t& level : texel) level = static_cast<std::uint8_t>(random.next());
      const double depth = static_cast<double>(below(random, 257)) / 256;
      const FragmentState state = random_fragment_state(random, format, turn);
      FrameBuffer by_image(format);
      FrameBuffer by_triangles(format);
      Frame image(by_image);
      Frame triangles(by_triangles);
      draw_background(image, format);
      draw_background(triangles, format);
      PixelImage pixel{.pixels = texel, .width = 1, .height = 1, .depth = depth};
      pixel.x = place.x;
      pixel.y = place.y;
      pixel.zoom_x = place.width;
      pixel.zoom_y = place.height;
      image.draw_image(pixel, state);
      const MeshData whole = whole_window(static_cast<float>(2 * depth - 1));
      DrawState same = draw_state(state);
      same.lighting = false;
      const auto component = [&](int c) { return static_cast<float>(texel[c]) / 255.0f; };
      same.material.diffuse = {component(0), component(1), component(2), component(3)};
      same.scissor = state.scissor ? intersection(*state.scissor, place) : place;
      triangles.draw(whole.view(), same);
      Renderer renderer({.threads = 1, .tile_size = 32});
      renderer.finish(image);
      renderer.finish(triangles);
      EXPECT_EQ(fingerprint(by_image), fingerprint(by_triangles))
          << "turn " << turn << ", " << describe(format);
    }
}

// Blending, alpha test and stored alpha use the texel of each pixel.
TEST(Image, UsesTheAlphaOfEachTexel) {
  Random random(3);
  OwnImage own(random, 37, 21, 4);
  FrameBuffer buffer({.width = 40, .height = 24, .alpha_bits = 8});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 0}, .depth = 1.0});
  own.image.x = 2;
  own.image.y = 1;
  frame.draw_image(own.image, {.alpha_test = AlphaTest{Compare::gequal, 128.0f / 255.0f}});
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  for (std::int64_t y = 0; y < 24; ++y)
    for (std::int64_t x = 0; x < 40; ++x) {
      const bool inside = x >= 2 && x < 39 && y >= 1 && y < 22;
      const auto t = inside ? own.texel(x - 2, y - 1) : std::array<std::uint8_t, 4>{};
      const std::uint32_t expected = t[3] >= 128 ? std::uint32_t{t[3]} << 24 | std::uint32_t{t[0]} << 16 |
                                                       std::uint32_t{t[1]} << 8 | t[2]
                                                 : 0;
      EXPECT_EQ(words[static_cast<std::size_t>((23 - y) * 40 + x)], expected) << x << ' ' << y;
    }
}

TEST(Image, StoresTheNearestPaletteEntries) {
  const std::vector<Color> palette{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 1, 1}};
  FrameBuffer buffer(
      {.width = 8, .height = 8, .color_mode = ColorMode::index, .color_bits = 4, .palette = palette});
  const std::uint8_t pixels[] = {250, 10, 20, 30, 200, 40, 90, 80, 70, 240, 250, 230};
  Frame frame(buffer);
  frame.clear({.index = 9u, .depth = 1.0});
  frame.draw_image({.pixels = pixels, .width = 4, .height = 1, .channels = 3, .x = 1, .y = 2});
  Renderer({.threads = 1}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  EXPECT_EQ(std::vector<std::uint32_t>(words.begin() + 5 * 8, words.begin() + 6 * 8),
            (std::vector<std::uint32_t>{9, 1, 2, 0, 3, 9, 9, 9}));
}

TEST(Image, CountsAsADrawInCapturesExplanationsAndStatistics) {
  const std::vector<std::uint8_t> gray(16, 200);
  for (const bool with_operations : {false, true}) {
    FrameBuffer buffer({.width = 40, .height = 40, .samples = with_operations ? 4 : 1});
    Frame frame(buffer);
    const MeshData whole = whole_window(0.5f);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw(whole.view(), {});
    FragmentState state;
    if (with_operations) state.alpha_test = AlphaTest{Compare::greater, 0.5f};
    frame.draw_image({.pixels = gray.data(),
                      .width = 4,
                      .height = 4,
                      .channels = 1,
                      .x = 10,
                      .y = 20,
                      .zoom_x = 2,
                      .zoom_y = 2},
                     state);
    frame.draw_image({.pixels = gray.data(), .width = 4, .height = 4, .channels = 1, .zoom_x = 0}, state);
    EXPECT_THAT(frame.explain(1),
                AllOf(HasSubstr("image: 4 x 4, 1 channel, one colour per texel"), HasSubstr("depth test")));
    EXPECT_THAT(frame.explain(2), HasSubstr("draw: skipped, it can change no pixel"));
    std::vector<std::uint32_t> draw_ids(pixel_count(buffer)), primitive_ids(draw_ids.size());
    std::vector<float> normals(3 * draw_ids.size());
    frame.capture({.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals});
    const FrameStats stats = Renderer({.threads = 1, .debug = {.count_fragments = true}}).finish(frame);
    EXPECT_EQ(stats.fragments, 40u * 40 + 64);
    for (std::size_t y = 0; y < 40; ++y)
      for (std::size_t x = 0; x < 40; ++x) {
        const bool image = x >= 10 && x < 18 && y >= 12 && y < 20;
        ASSERT_EQ(draw_ids[40 * y + x], image ? 1u : 0u) << x << ' ' << y;
        ASSERT_EQ(normals[3 * (40 * y + x) + 2], image ? 0.0f : 1.0f) << x << ' ' << y;
        if (image) {
          ASSERT_EQ(primitive_ids[40 * y + x], 0u);
        }
      }
  }
}

TEST(Image, AnyPositionAndSizeIsAccepted) {
  const std::uint8_t white = 255;
  const double huge = std::numeric_limits<double>::max();
  const double tiny = std::numeric_limits<double>::denorm_min();
  struct Case {
    double x, y, zoom_x, zoom_y;
    bool everywhere;
  };
  const Case cases[] = {{-1e6, -1e6, 1e7, 1e7, true},
                        {huge, 0, -huge, 50, true},
                        {-huge, 0, huge, 50, false},
                        {-1e9, -1e9, huge, huge, true},
                        {0, 0, 0, 50, false},
                        {0, 0, 50, -0.0, false},
                        {0, 0, tiny, tiny, false},
                        {0, 0, -huge, 50, false},
                        {50, 50, -huge, -huge, true},
                        {1e300, 1e300, 9, 9, false},
                        {-1e300, -1e300, 1e305, 1e305, true}};
  for (const Case& c : cases) {
    FrameBuffer buffer({.width = 33, .height = 20});
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.draw_image({.pixels = &white,
                      .width = 1,
                      .height = 1,
                      .channels = 1,
                      .x = c.x,
                      .y = c.y,
                      .zoom_x = c.zoom_x,
                      .zoom_y = c.zoom_y});
    Renderer({.threads = 1}).finish(frame);
    EXPECT_THAT(packed_colors(buffer), testing::Each(c.everywhere ? 0xffffffu : 0u))
        << c.x << ' ' << c.y << ' ' << c.zoom_x << ' ' << c.zoom_y;
  }
}

TEST(Image, InvalidImagesAreRefused) {
  const std::vector<std::uint8_t> bytes(64, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  FrameBuffer buffer({.width = 16, .height = 16});
  const auto of = [&](const auto& change) {
    PixelImage image{.pixels = bytes.data(), .width = 4, .height = 4};
    change(image);
    Frame frame(buffer);
    return error_of([&] { frame.draw_image(image); }).value_or("(no error)");
  };
  EXPECT_EQ(of([](PixelImage&) {}), "(no error)");
  EXPECT_THAT(of([](PixelImage& i) { i.pixels = nullptr; }), HasSubstr("Frame::draw_image: pixels is null"));
  EXPECT_THAT(of([](PixelImage& i) { i.width = 0; }),
              HasSubstr("Frame::draw_image: width is 0, must be 1 to 16384"));
  EXPECT_THAT(of([](PixelImage& i) { i.height = 20000; }), HasSubstr("height is 20000, must be 1 to 16384"));
  EXPECT_THAT(of([](PixelImage& i) { i.channels = 5; }), HasSubstr("channels is 5, must be 1 to 4"));
  EXPECT_THAT(of([](PixelImage& i) { i.channels = 0; }), HasSubstr("channels is 0, must be 1 to 4"));
  EXPECT_THAT(of([](PixelImage& i) { i.stride_bytes = 15; }),
              HasSubstr("stride_bytes is 15, a row takes 16 bytes"));
  EXPECT_THAT(of([&](PixelImage& i) { i.x = infinity; }), HasSubstr("position holds inf, must be finite"));
  EXPECT_THAT(of([&](PixelImage& i) { i.zoom_x = nan; }),
              HasSubstr("Frame::draw_image: zoom holds nan, must be finite"));
  EXPECT_THAT(of([&](PixelImage& i) { i.zoom_y = -infinity; }), HasSubstr("zoom holds -inf, must be finite"));
  EXPECT_THAT(of([](PixelImage& i) { i.depth = -0.1; }), HasSubstr("depth is -0.1, must be 0 to 1"));
}

}  // namespace
}  // namespace tessera::image_test
