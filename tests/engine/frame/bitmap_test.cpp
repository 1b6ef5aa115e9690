// Bitmaps: the pixels of their bits by an independent integer rule, and fragment operations that match those
// of a rectangle of triangles in the same place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::bitmap_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 150, kHeight = 110;

// Bits in rows of any stride, upwards or downwards in memory.
struct OwnBitmap {
  int width, height;
  std::vector<bool> bits;  // row by row from the lower left
  std::vector<std::uint8_t> memory;
  std::ptrdiff_t stride;
  Bitmap bitmap;

  OwnBitmap(Random& random, int w, int h, std::uint32_t one_in) : width(w), height(h) {
    const std::ptrdiff_t row = (w + 7) / 8;
    const std::ptrdiff_t pitch = row + below(random, 3);
    memory.assign(static_cast<std::size_t>(pitch * h), 0xff);  // padding between the rows is set
    stride = random.next() % 2 == 0 ? pitch : -pitch;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) bits.push_back(random.next() % one_in == 0);
    const std::ptrdiff_t top = stride > 0 ? 0 : pitch * (h - 1);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        std::uint8_t& byte = memory[static_cast<std::size_t>(top + stride * (h - 1 - y) + x / 8)];
        const auto bit = static_cast<std::uint8_t>(0x80u >> (x % 8));
        byte =
            static_cast<std::uint8_t>(bits[static_cast<std::size_t>(y * w + x)] ? byte | bit : byte & ~bit);
      }
    bitmap = {.bits = memory.data() + top, .width = w, .height = h, .stride_bytes = stride};
  }
  bool at(std::int64_t x, std::int64_t y) const {
    return x >= 0 && x < width && y >= 0 && y < height && bits[static_cast<std::size_t>(y * width + x)];
  }
};

// In 1/16 pixel; also outside the window.
std::int64_t random_position(Random& random, int size) {
  switch (random.next() % 8) {
    case 0: return std::int64_t{16} * (random.next() % 2 == 0 ? 1'000'000'000'000 : -1'000'000'000'000);
    case 1: return 16 * below(random, size);
    default: return below(random, 16 * (size + 80)) - 16 * 60;
  }
}

TEST(Bitmap, CoversThePixelsOfItsRoundedPosition) {
  for (const int samples : {1, 4, 8})
    for (const int tile_size : {32, 64, 128})
      for (const InstructionSet set : available_instruction_sets()) {
        Random random(40 + static_cast<std::uint64_t>(samples));
        Renderer renderer({.threads = 2, .tile_size = tile_size, .instruction_set = set});
        FrameBuffer buffer({.width = kWidth, .height = kHeight, .samples = samples});
        Frame frame(buffer);
        frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
        std::vector<std::uint32_t> expected(pixel_count(buffer), 0);
        std::vector<OwnBitmap> bitmaps;
        bitmaps.reserve(60);
        std::uint64_t touched = 0;
        for (int i = 0; i < 60; ++i) {
          const auto width = 1 + static_cast<int>(below(random, i % 2 == 0 ? 140 : 20));
          const auto height = 1 + static_cast<int>(below(random, i % 3 == 0 ? 120 : 20));
          OwnBitmap& own = bitmaps.emplace_back(random, width, height, i % 3 + 1);
          const std::int64_t x = random_position(random, kWidth), y = random_position(random, kHeight);
          const std::uint32_t word = random.next() & 0xffffff;
          own.bitmap.x = static_cast<double>(x) / 16;
          own.bitmap.y = static_cast<double>(y) / 16;
          own.bitmap.color = color_of(word);
          frame.draw_bitmap(own.bitmap, {.depth = {.enabled = false}});
          // Rounded towards minus infinity.
          const std::int64_t left = x >> 4, bottom = y >> 4;
          for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column)
              if (own.at(column - left, kHeight - 1 - row - bottom))
                expected[static_cast<std::size_t>(row * kWidth + column)] = word, ++touched;
        }
        renderer.finish(frame);
        EXPECT_EQ(packed_colors(buffer), expected)
            << samples << " samples, tiles of " << tile_size << ", " << name(set);
        EXPECT_GT(touched, 10000u);
      }
}

// With all bits set, a bitmap equals a scissored rectangle, for each operation and each kind of buffer.
TEST(Bitmap, PassesThroughEveryOperationLikeTriangles) {
  for (const FrameBufferFormat& format : operation_formats())
    for (int turn = 0; turn < 60; ++turn) {
      Random random(100 + static_cast<std::uint64_t>(turn));
      const Rect place = random_rect(random);
      const std::vector<std::uint8_t> ones(static_cast<std::size_t>((place.width + 7) / 8 * place.height),
                                           0xff);
      const Color color{random.between(0, 1), random.between(0, 1), random.between(0, 1),
                        random.between(0, 1)};
      const double depth = static_cast<double>(below(random, 257)) / 256;  // exact in every depth format
      const FragmentState state = random_fragment_state(random, format, turn);
      const auto background = [&](Frame& frame) { draw_background(frame, format); };
      FrameBuffer by_bits(format);
      FrameBuffer by_triangles(format);
      Frame bits(by_bits);
      Frame triangles(by_triangles);
      background(bits);
      background(triangles);
      Bitmap bitmap{
          .bits = ones.data(), .width = place.width, .height = place.height, .depth = depth, .color = color};
      bitmap.x = place.x;
      bitmap.y = place.y;
      bits.draw_bitmap(bitmap, state);
      const MeshData whole = whole_window(static_cast<float>(2 * depth - 1));
      DrawState same = draw_state(state);
      same.lighting = false;
      same.material.diffuse = color;
      same.scissor = state.scissor ? intersection(*state.scissor, place) : place;
      triangles.draw(whole.view(), same);
      Renderer renderer({.threads = 1, .tile_size = 32});
      renderer.finish(bits);
      renderer.finish(triangles);
      EXPECT_EQ(fingerprint(by_bits), fingerprint(by_triangles))
          << "turn " << turn << ", " << describe(format);
    }
}

TEST(Bitmap, DepthIsQuantizedLikeAClear) {
  const std::uint8_t one = 0x80;
  for (const auto& [format, bits] :
       {std::pair{DepthFormat::unorm16, 16}, std::pair{DepthFormat::unorm24, 24},
        std::pair{DepthFormat::unorm32, 32}, std::pair{DepthFormat::float32, 32}}) {
    for (const double depth : {0.0, 1.0, 0.5, 0.1, 1.0 / 3, 0.999999, 1e-9, 0.7000001}) {
      FrameBuffer buffer({.width = 5, .height = 3, .depth = format});
      Frame frame(buffer);
      frame.clear({.color = Color{}, .depth = 1.0});
      frame.draw_bitmap({.bits = &one, .width = 1, .height = 1, .x = 2, .y = 1, .depth = depth},
                        {.depth = {.test = Compare::always}});
      Renderer({.threads = 1}).finish(frame);
      const long double scaled = static_cast<long double>(depth) * (std::ldexp(1.0L, bits) - 1);
      const bool is_float = format == DepthFormat::float32;
      const std::uint32_t level = is_float ? std::bit_cast<std::uint32_t>(static_cast<float>(depth))
                                           : static_cast<std::uint32_t>(std::floor(scaled + 0.5L));
      EXPECT_EQ(stored_depths(buffer)[7], level) << depth << " in " << bits << " bits";
    }
  }
}

TEST(Bitmap, KeepsItsPlaceAmongClearsDrawsAndAccumulation) {
  const std::vector<std::uint8_t> ones(8, 0xff);
  const auto square = [&](double x, double y, Color color, double depth = 0) {
    return Bitmap{
        .bits = ones.data(), .width = 8, .height = 8, .x = x, .y = y, .depth = depth, .color = color};
  };
  for (const int samples : {1, 4})
    for (const bool defer : {true, false}) {
      FrameBuffer buffer({.width = 48, .height = 40, .accumulation_bits = 16, .samples = samples});
      Frame frame(buffer);
      const MeshData whole = whole_window(0.5f);
      Light red;
      red.position = {0, 0, 5, 1};
      red.diffuse = {1, 0, 0, 1};
      frame.set_lights({red});
      frame.set_light_model({.ambient = {0, 0, 0, 1}});
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      frame.draw_bitmap(square(0, 0, {0, 1, 0, 1}, 0.9));     // covered by later draws
      frame.draw(whole.view(), {.shading = Shading::phong});  // deferred pixels
      frame.draw_bitmap(square(10, 0, {0, 0, 1, 1}, 0.25));   // nearer
      frame.draw_bitmap(square(20, 0, {0, 0, 1, 1}, 0.8));    // behind it
      frame.accumulate({.op = AccumOp::load, .value = 1});
      frame.draw_bitmap(square(30, 0, {1, 1, 1, 1}));  // not accumulated
      frame.accumulate({.op = AccumOp::return_color, .value = 1, .scissor = Rect{30, 0, 4, 8}});
      frame.clear({.color = Color{1, 1, 0, 1}, .scissor = Rect{10, 0, 4, 8}});
      frame.draw_bitmap(square(40, 4, {0, 1, 1, 1}));
      Renderer({.threads = 1, .debug = {.defer_shading = defer}}).finish(frame);
      const std::vector<std::uint32_t> words = packed_colors(buffer);
      const auto at = [&](int x, int y) { return words[static_cast<std::size_t>((39 - y) * 48 + x)]; };
      EXPECT_EQ(at(2, 2) & 0xffff, 0u) << "red light only";
      EXPECT_GT(at(2, 2) >> 16, 100u);
      EXPECT_EQ(at(12, 2), 0xffff00u);
      EXPECT_EQ(at(16, 2), 0x0000ffu);
      EXPECT_EQ(at(22, 2) & 0xffff, 0u);
      EXPECT_EQ(at(32, 2) & 0xffff, 0u) << "as accumulated";
      EXPECT_EQ(at(36, 2), 0xffffffu);
      EXPECT_EQ(at(40, 4), 0x00ffffu);
      EXPECT_EQ(at(47, 11), 0x00ffffu);
      EXPECT_EQ(at(39, 4) & 0xffff, 0u);
    }
}

TEST(Bitmap, CountsAsADrawInCapturesExplanationsAndStatistics) {
  const std::vector<std::uint8_t> stripes(64, 0xf0);
  for (const bool with_operations : {false, true})
    for (const int samples : {1, 4}) {
      FrameBuffer buffer({.width = 70, .height = 50, .samples = samples});
      Frame frame(buffer);
      const MeshData whole = whole_window(0.5f);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      FragmentState state;
      if (with_operations) state.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
      frame.draw(whole.view(), {});
      frame.draw_bitmap({.bits = stripes.data(), .width = 8, .height = 64, .x = 30, .y = -4}, state);
      frame.draw_bitmap({.bits = stripes.data(), .width = 8, .height = 1, .x = 100, .y = 0},
                        state);  // outside the window
      frame.draw_bitmap({.bits = stripes.data(), .width = 8, .height = 1, .x = 0, .y = 3}, state);
      EXPECT_EQ(frame.draw_count(), 4u);
      EXPECT_THAT(frame.explain(1), AllOf(HasSubstr("bitmap: 8 x 64, one colour"), HasSubstr("depth test"),
                                          testing::Not(HasSubstr("skipped"))));
      EXPECT_THAT(frame.explain(2), HasSubstr("draw: skipped, it can change no pixel"));
      std::vector<std::uint32_t> draw_ids(pixel_count(buffer)), primitive_ids(draw_ids.size());
      std::vector<float> normals(3 * draw_ids.size());
      frame.capture({.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals});
      const FrameStats stats =
          Renderer({.threads = 1, .tile_size = 32, .debug = {.count_fragments = true}}).finish(frame);
      EXPECT_EQ(stats.fragments, 70u * 50 + 4 * 50 + 4);
      EXPECT_EQ(stats.triangles_in, 2u);
      std::size_t drawn = 0;
      for (std::size_t y = 0; y < 50; ++y)
        for (std::size_t x = 0; x < 70; ++x) {
          std::uint32_t object = 0;
          if (x < 4 && y == 46) object = 3;
          if (x >= 30 && x < 34) object = 1;
          const std::size_t i = 70 * y + x;
          ASSERT_EQ(draw_ids[i], object) << x << ' ' << y;
          ASSERT_EQ(primitive_ids[i], object == 0 ? (primitive_ids[i] & 1) : 0u);
          ASSERT_EQ(normals[3 * i + 2], object == 0 ? 1.0f : 0.0f) << x << ' ' << y;
          drawn += object == 0 ? 0 : 1;
        }
      EXPECT_EQ(drawn, 4u * 50 + 4);
    }
}

TEST(Bitmap, CountsTheTilesItTouches) {
  const std::vector<std::uint8_t> ones(64, 0xff);
  FrameBuffer buffer({.width = 128, .height = 96});
  Frame frame(buffer);
  frame.clear({.color = Color{}, .depth = 1.0});
  frame.draw_bitmap({.bits = ones.data(),
                     .width = 64,
                     .height = 8,
                     .x = 31,
                     .y = 28});  // columns 31..94, rows 60..67 from the top
  const FrameStats stats = Renderer({.threads = 1, .tile_size = 32}).finish(frame);
  EXPECT_EQ(stats.tiles_touched, 6u);
  EXPECT_EQ(stats.bin_entries, 6u);
  EXPECT_EQ(stats.shaded_pixels, 64u * 8);
}

TEST(Bitmap, InvalidBitmapsAreRefused) {
  const std::uint8_t byte = 0xff;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Bitmap good{.bits = &byte, .width = 8, .height = 1};
  FrameBuffer rgb({.width = 16, .height = 16});
  FrameBuffer index({.width = 16, .height = 16, .color_mode = ColorMode::index, .color_bits = 4});
  FrameBuffer bare({.width = 16, .height = 16, .depth = DepthFormat::none, .stencil_bits = 0});
  const auto error = [&](const auto& change, const FragmentState& state, FrameBuffer& buffer) {
    Bitmap bitmap = good;
    change(bitmap);
    Frame frame(buffer);
    const auto message = error_of([&] { frame.draw_bitmap(bitmap, state); });
    EXPECT_EQ(frame.draw_count(), message ? 0u : 1u);
    return message.value_or("(no error)");
  };
  const auto of = [&](const auto& change) { return error(change, {}, rgb); };
  EXPECT_THAT(of([](Bitmap& b) { b.bits = nullptr; }), HasSubstr("Frame::draw_bitmap: bits is null"));
  EXPECT_THAT(of([](Bitmap& b) { b.width = 0; }),
              HasSubstr("Frame::draw_bitmap: width is 0, must be 1 to 16384"));
  EXPECT_THAT(of([](Bitmap& b) { b.height = -3; }), HasSubstr("height is -3, must be 1 to 16384"));
  EXPECT_THAT(of([](Bitmap& b) { b.width = 16385; }), HasSubstr("width is 16385"));
  EXPECT_THAT(of([](Bitmap& b) { b.width = 9, b.height = 2, b.stride_bytes = -1; }),
              HasSubstr("stride_bytes is -1, a row takes 2 bytes"));
  EXPECT_THAT(of([&](Bitmap& b) { b.x = nan; }), HasSubstr("position holds nan, must be finite"));
  EXPECT_THAT(of([&](Bitmap& b) { b.y = -infinity; }), HasSubstr("position holds -inf, must be finite"));
  EXPECT_THAT(of([](Bitmap& b) { b.depth = 1.5; }), HasSubstr("depth is 1.5, must be 0 to 1"));
  EXPECT_THAT(of([&](Bitmap& b) { b.depth = nan; }), HasSubstr("depth is nan"));
  EXPECT_THAT(of([&](Bitmap& b) { b.color.g = static_cast<float>(nan); }),
              HasSubstr("color holds nan, must be finite"));
  const auto as_is = [](Bitmap&) {};
  EXPECT_THAT(error(as_is, {.scissor = Rect{0, 0, 4, -1}}, rgb),
              HasSubstr("Frame::draw_bitmap: scissor is 4 x -1 pixels"));
  EXPECT_THAT(error(as_is, {.alpha_test = AlphaTest{.ref = 2}}, rgb),
              HasSubstr("Frame::draw_bitmap: alpha_test.ref is 2"));
  EXPECT_THAT(error(as_is, {.blend = BlendState{}, .logic_op = LogicOp::bit_xor}, rgb),
              HasSubstr("Frame::draw_bitmap: blending and a logic operation"));
  EXPECT_THAT(error(as_is, {.blend = BlendState{}}, index), HasSubstr("indices, which do not blend"));
  EXPECT_THAT(error(as_is, {.alpha_test = AlphaTest{}}, index), HasSubstr("indices, which have no alpha"));
  EXPECT_THAT(error(as_is, {.color_mask = {true, false, true, true}}, index), HasSubstr("all or none"));
  EXPECT_THAT(error(as_is, {.stencil = StencilState{}}, bare), HasSubstr("no stencil buffer"));
  EXPECT_EQ(error(as_is, {}, bare), "(no error)") << "without a depth buffer the depth is not checked";
  EXPECT_EQ(of([](Bitmap& b) {
              b.x = -1e300;
              b.y = 1e300;
              b.color = {-5, 7, 0, 2};
            }),
            "(no error)")
      << "far outside the window; colours are clamped";
  EXPECT_EQ(of([](Bitmap& b) { b.height = 1, b.stride_bytes = -100; }), "(no error)")
      << "one row needs no stride";
}

}  // namespace
}  // namespace tessera::bitmap_test
