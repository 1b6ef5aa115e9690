// The pixels, and the bits of them, that a frame may change: scissors, viewports, colour masks, plane masks,
// and clears between draws.
#include <gtest/gtest.h>

#include <functional>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::frame_masks_test {
namespace {

using namespace test;

const FrameBufferFormat kFormat{.width = 70, .height = 45};
const Color kBlue{0, 0, 1, 1};
const Color kRed{1, 0, 0, 1};
const Color kGreen{0, 1, 0, 1};
constexpr std::uint32_t kBlueWord = 0x0000ff;
constexpr std::uint32_t kRedWord = 0xff0000;
constexpr std::uint32_t kGreenWord = 0x00ff00;

bool inside(const Rect& rect, int x, int window_y) {
  return x >= rect.x && x - rect.x < rect.width && window_y >= rect.y && window_y - rect.y < rect.height;
}

using Record = std::function<void(Frame&)>;
std::vector<std::uint32_t> words_of(const FrameBufferFormat& format, const Record& record,
                                    RendererOptions options = {.threads = 1, .tile_size = 32}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  Renderer(options).finish(frame);
  return packed_colors(buffer);
}

// `expected` gets window coordinates: row 0 is the lowest.
void expect_words(const FrameBufferFormat& format, const std::vector<std::uint32_t>& words,
                  const std::function<std::uint32_t(int, int)>& expected) {
  int wrong = 0;
  for (int y = 0; y < format.height; ++y)
    for (int x = 0; x < format.width; ++x) {
      const std::uint32_t word = words[static_cast<std::size_t>(y * format.width + x)];
      const std::uint32_t wanted = expected(x, format.height - 1 - y);
      if (word != wanted && wrong++ == 0)
        ADD_FAILURE() << "pixel " << x << ", " << format.height - 1 - y << " is " << std::hex << word
                      << ", not " << wanted;
    }
  EXPECT_EQ(wrong, 0);
}

const Rect kRects[] = {{0, 0, 70, 45},
                       {3, 5, 31, 17},
                       {69, 44, 1, 1},
                       {-20, -20, 30, 40},
                       {50, 30, 500, 500},
                       {10, 10, 0, 9},
                       {100, 3, 5, 5},
                       {-2000000000, -2000000000, 2147483647, 2147483647},
                       {31, 31, 2, 2},
                       {0, 20, 70, 1},
                       {-5, -5, 2000000000, 2000000000}};

TEST(Scissor, LimitsDraws) {
  const MeshData all = whole_window();
  for (const Rect& rect : kRects) {
    SCOPED_TRACE(testing::Message() << rect.x << ", " << rect.y << ", " << rect.width << " x "
                                    << rect.height);
    const auto words = words_of(kFormat, [&](Frame& frame) {
      frame.clear({.color = kBlue});
      DrawState state = unlit(kRed);
      state.scissor = rect;
      frame.draw(all.view(), state);
    });
    expect_words(kFormat, words, [&](int x, int y) { return inside(rect, x, y) ? kRedWord : kBlueWord; });
  }
}

TEST(Scissor, LimitsClearsBeforeBetweenAndAfterDraws) {
  const MeshData all = whole_window();
  const MeshData left = rectangle(-1, -1, 0, 1, -0.5f);
  for (const Rect& rect : kRects) {
    SCOPED_TRACE(testing::Message() << rect.x << ", " << rect.y << ", " << rect.width << " x "
                                    << rect.height);
    const Record first = [&](Frame& frame) {
      frame.clear({.color = kBlue});
      frame.clear({.color = kGreen, .scissor = rect});
    };
    expect_words(kFormat, words_of(kFormat, first),
                 [&](int x, int y) { return inside(rect, x, y) ? kGreenWord : kBlueWord; });
    const Record between = [&](Frame& frame) {
      frame.clear({.color = kBlue});
      frame.draw(all.view(), unlit(kRed));
      frame.clear({.color = kGreen, .depth = 1.0, .scissor = rect});
      frame.draw(left.view(), unlit({1, 1, 1, 1}));
    };
    expect_words(kFormat, words_of(kFormat, between), [&](int x, int y) {
      if (x < 35) return 0xffffffu;
      return inside(rect, x, y) ? kGreenWord : kRedWord;
    });
    const Record last = [&](Frame& frame) {
      frame.draw(all.view(), unlit(kRed));
      frame.clear({.color = kGreen, .scissor = rect});
    };
    expect_words(kFormat, words_of(kFormat, last),
                 [&](int x, int y) { return inside(rect, x, y) ? kGreenWord : kRedWord; });
  }
}

TEST(Clears, DepthClearBetweenDrawsLetsFartherDrawsPass) {
  const MeshData near = whole_window(-0.5f);
  const MeshData far = whole_window(0.5f);
  const Rect hole{10, 5, 30, 22};
  const auto words = words_of(kFormat, [&](Frame& frame) {
    frame.draw(near.view(), unlit(kRed));
    frame.clear({.depth = 1.0, .scissor = hole});
    frame.draw(far.view(), unlit(kGreen));
  });
  expect_words(kFormat, words, [&](int x, int y) { return inside(hole, x, y) ? kGreenWord : kRedWord; });
}

TEST(Clears, GoThroughFullMasksAndKeepTheirOrder) {
  const MeshData all = whole_window();
  const auto words = words_of(kFormat, [&](Frame& frame) {
    frame.clear({.color = kGreen});
    frame.clear({.color = kBlue});
    DrawState masked = unlit({1, 1, 1, 1});
    masked.plane_mask = 0x0f0000;
    frame.draw(all.view(), masked);
    frame.clear({.color = kRed, .scissor = Rect{0, 0, 35, 45}});
  });
  expect_words(kFormat, words, [&](int x, int) { return x < 35 ? kRedWord : 0x0f00ffu; });
}

TEST(PlaneMask, SelectsEachBitAlone) {
  const MeshData part = rectangle(-0.8f, -0.7f, 0.6f, 0.9f);
  for (const ColorMode mode : {ColorMode::rgb, ColorMode::index})
    for (const int bits : {1, 2, 8, 16, 24}) {
      if (mode == ColorMode::index && bits > 8) continue;
      const FrameBufferFormat format{.width = 70, .height = 45, .color_mode = mode, .color_bits = bits};
      const auto words = [&](std::uint32_t mask, Shading shading) {
        return words_of(format, [&](Frame& frame) {
          if (mode == ColorMode::rgb)
            frame.clear({.color = bits <= 2 ? Color{0, 0, 0, 1} : Color{0.3f, 0.7f, 0.4f, 1}});
          if (mode == ColorMode::index) frame.clear({.index = bits == 2 ? 1u : 0x5au & ((1u << bits) - 1)});
          DrawState state;
          state.shading = shading;
          state.material.diffuse = {0.9f, 0.2f, 0.8f, 1};
          state.plane_mask = mask;
          frame.draw(part.view(), state);
        });
      };
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        const auto none = words(0, shading);
        const auto all = words(0xffffffffu, shading);
        EXPECT_NE(none, all);
        for (int k = 0; k <= bits; ++k) {  // bit `bits` does not exist: no change
          const std::uint32_t mask = 1u << k;
          std::vector<std::uint32_t> expected(none);
          for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = (none[i] & ~mask) | (all[i] & mask);
          EXPECT_EQ(words(mask, shading), expected) << bits << " bits, plane " << k;
        }
      }
    }
}

TEST(ColorMask, SelectsTheBitsOfItsComponents) {
  const MeshData part = rectangle(-0.8f, -0.7f, 0.6f, 0.9f);
  for (int bits = 3; bits <= 24; ++bits) {
    const int each = bits / 3;
    const int g_bits = each + (bits % 3 > 0);
    const std::uint32_t b = (1u << each) - 1;
    const std::uint32_t g = ((1u << g_bits) - 1) << each;
    const std::uint32_t r = ((1u << bits) - 1) & ~(g | b);
    const FrameBufferFormat format{.width = 70, .height = 45, .color_bits = bits};
    for (int set = 0; set < 16; ++set) {
      const auto words = [&](bool masked) {
        return words_of(format, [&](Frame& frame) {
          frame.clear({.color = Color{0.3f, 0.7f, 0.4f, 1}});
          DrawState state = unlit({0.9f, 0.2f, 0.8f, 1});
          if (masked) state.color_mask = {(set & 1) != 0, (set & 2) != 0, (set & 4) != 0, (set & 8) != 0};
          frame.draw(part.view(), state);
        });
      };
      const std::uint32_t mask = (set & 1 ? r : 0) | (set & 2 ? g : 0) | (set & 4 ? b : 0);
      const auto all = words(false);
      const auto got = words(true);
      const std::uint32_t before = all[0];  // the corner is not covered
      for (std::size_t i = 0; i < got.size(); ++i)
        ASSERT_EQ(got[i], (before & ~mask) | (all[i] & mask)) << bits << " bits, set " << set;
    }
  }
}

TEST(Viewport, PlacesTheWindowAndClipsToIt) {
  const MeshData all = whole_window();
  const MeshData beyond = rectangle(-3, -3, 3, 3);
  for (const Rect& viewport : {Rect{0, 0, 70, 45}, Rect{10, 5, 20, 30}, Rect{-15, -7, 40, 22},
                               Rect{60, 40, 30, 30}, Rect{-100, -100, 1000, 900}, Rect{200, 0, 10, 10}})
    for (const MeshData* mesh : {&all, &beyond}) {
      SCOPED_TRACE(testing::Message()
                   << viewport.x << ", " << viewport.y << ", " << viewport.width << " x " << viewport.height);
      const auto words = words_of(kFormat, [&](Frame& frame) {
        frame.clear({.color = kBlue});
        DrawState state = unlit(kRed);
        state.viewport = viewport;
        frame.draw(mesh->view(), state);
      });
      expect_words(kFormat, words,
                   [&](int x, int y) { return inside(viewport, x, y) ? kRedWord : kBlueWord; });
    }
}

TEST(Sizes, OddSizesAreDrawnCompletely) {
  const std::pair<int, int> sizes[] = {{1, 1},   {17, 3},    {1, 16384}, {16384, 1},
                                       {513, 2}, {127, 129}, {3, 4097}};
  const MeshData left = rectangle(-1, -1, 0, 1);
  const MeshData all = whole_window(0.5f);
  for (const auto& [width, height] : sizes)
    for (const int tile_size : {32, 64, 128}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", tiles of " << tile_size);
      const FrameBufferFormat format{.width = width, .height = height};
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.draw(left.view(), unlit(kRed));
      frame.draw(all.view(), unlit(kBlue));
      Renderer(RendererOptions{.threads = 2, .tile_size = tile_size}).finish(frame);
      // A pixel belongs to the left half if its centre does; a centre on the edge belongs to the right half.
      const int half = width / 2;
      expect_words(format, packed_colors(buffer),
                   [&](int x, int) { return x < half ? kRedWord : kBlueWord; });
      std::vector<float> depth(pixel_count(buffer));
      buffer.read_depth(depth);
      EXPECT_NEAR(depth.back(), 0.75, 1e-6);
      Image image(buffer);
      buffer.read_color(image.target());
      EXPECT_EQ(image.bytes[image.bytes.size() - 2], 255) << "blue of the last pixel";
    }
}

}  // namespace
}  // namespace tessera::frame_masks_test
