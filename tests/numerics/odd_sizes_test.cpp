// Frame buffers of the smallest, the largest and odd sizes: the picture equals that part of a larger buffer,
// and planes, packed colors, read-back and scan-out agree bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::test::odd_sizes_test {
namespace {

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1, 1},   {1, 16384}, {16384, 1}, {2, 3},    {3, 16383}, {16383, 2},
                           {31, 33}, {63, 65},   {129, 127}, {1, 4097}, {257, 1}};

/// Draws of every kind. The viewport is larger than any of the buffers in one direction, so each buffer shows
/// its lower left part.
struct Scene {
  Rect viewport;
  MeshData mesh;
  MeshData lines;
  MeshData points;
  std::vector<std::uint8_t> bytes;

  explicit Scene(Size size) : viewport{0, 0, std::max(size.width, 40), std::max(size.height, 40)} {
    Random random(11);
    for (int i = 0; i < 60; ++i)
      for (int k = 0; k < 3; ++k) {
        // Near the lower left corner, and along the whole long side.
        mesh.positions.insert(mesh.positions.end(), {random.between(-1.2f, i % 2 == 0 ? 1.2f : -0.9f),
                                                     random.between(-1.2f, i % 3 == 0 ? 1.2f : -0.9f),
                                                     random.between(-0.9f, 0.9f)});
        mesh.colors.insert(mesh.colors.end(), {random.between(0, 1), random.between(0, 1),
                                               random.between(0, 1), random.between(0, 1)});
        mesh.color_indices.push_back(random.between(0, 255));
      }
    lines = points = mesh;
    lines.primitive = Primitive::line_strip;
    points.primitive = Primitive::points;
    for (int i = 0; i < 4 * 40 * 40; ++i) bytes.push_back(static_cast<std::uint8_t>(random.next()));
  }
  void record(Frame& frame, const FrameBufferFormat& format) const {
    const bool index = format.color_mode == ColorMode::index;
    Clear whole{.color = Color{0.3f, 0.6f, 0.2f, 0.5f}};
    if (format.depth != DepthFormat::none) whole.depth = 0.9;
    if (format.stencil_bits > 0) whole.stencil = 1;
    frame.clear(whole);
    DrawState state = unlit({0.9f, 0.2f, 0.4f, 0.5f});
    state.viewport = viewport;
    state.line_width = state.point_size = 3;
    if (format.stencil_bits > 0)
      state.stencil = StencilState{.front = {.zfail = StencilOp::incr_wrap, .zpass = StencilOp::invert}};
    frame.draw(mesh.view(), state);
    if (!index) state.blend.emplace();
    frame.draw(lines.view(), state);
    frame.draw(points.view(), state);
    frame.draw_image({.pixels = bytes.data(),
                      .width = 40,
                      .height = 40,
                      .x = -3,
                      .y = -2,
                      .zoom_x = 1.3,
                      .zoom_y = 0.7,
                      .depth = 0.4});
    frame.draw_bitmap({.bits = bytes.data(),
                       .width = 40,
                       .height = 40,
                       .x = -7,
                       .y = -5,
                       .depth = 0.3,
                       .color = {0.1f, 0.9f, 0.7f, 1}});
    frame.clear({.color = Color{0.5f, 0, 0.5f, 1}, .scissor = Rect{0, 0, 1, 1}});
    if (format.accumulation_bits > 0) {
      frame.accumulate({.op = AccumOp::load, .value = 0.7});
      frame.accumulate({.op = AccumOp::return_color, .value = 1.2, .scissor = Rect{1, 0, 16384, 16384}});
    }
  }
};

std::vector<FrameBufferFormat> formats(Size size) {
  const FrameBufferFormat base{.width = size.width, .height = size.height};
  std::vector<FrameBufferFormat> all(5, base);
  all[1].color_bits = 15;
  all[1].depth = DepthFormat::float32;
  all[1].alpha_bits = 8;
  all[1].dither = Dither::bayer4;
  all[1].accumulation_bits = 16;
  all[1].stencil_bits = 3;
  all[2].color_mode = ColorMode::index;
  all[2].color_bits = 7;
  all[2].depth = DepthFormat::unorm16;
  all[2].stencil_bits = 1;
  all[3].samples = 4;
  all[3].depth = DepthFormat::unorm32;
  all[3].accumulation_bits = 32;
  all[3].color_bits = 23;
  all[4].color_bits = 1;
  all[4].depth = DepthFormat::none;
  all[4].stencil_bits = 0;
  all[4].dither = Dither::bayer8;
  return all;
}

template <class Word>
void expect_planes(const FrameBuffer& buffer, Buffer which, const std::vector<Word>& words) {
  const int width = buffer.format().width, height = buffer.format().height;
  for (int k = 0; k < buffer.plane_count(which); ++k) {
    const PlaneView plane = buffer.plane(which, k);
    ASSERT_EQ(plane.width, width);
    ASSERT_EQ(plane.height, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        ASSERT_EQ(plane.bits[y * plane.stride_bytes + x / 8] >> (7 - x % 8) & 1,
                  static_cast<int>(words[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(x)] >>
                                       k &
                                   1u))
            << "plane " << k << " at " << x << ", " << y;
  }
}

/// Scans out into memory with a margin; rows go up if `upwards`. Memory outside the region keeps its value.
std::vector<std::uint8_t> shown(const FrameBuffer& buffer, PixelOrder order, bool upwards,
                                const std::optional<Rect>& part,
                                const std::function<void(const ImageTarget&)>& write) {
  const int width = buffer.format().width, height = buffer.format().height;
  const std::ptrdiff_t stride = 4 * std::ptrdiff_t{width} + 12;
  std::vector<std::uint8_t> memory(static_cast<std::size_t>(stride * height), 0xcd);
  std::vector<std::uint8_t> rows;
  write({.pixels = memory.data() + (upwards ? stride * (height - 1) : 0),
         .width = width,
         .height = height,
         .stride_bytes = upwards ? -stride : stride,
         .order = order,
         .region = part});
  for (int y = 0; y < height; ++y) {
    const auto row = memory.begin() + stride * (upwards ? height - 1 - y : y);
    rows.insert(rows.end(), row, row + 4 * width);
    EXPECT_TRUE(std::all_of(row + 4 * width, row + stride, [](std::uint8_t b) { return b == 0xcd; }))
        << "margin next to row " << y;
  }
  return rows;
}

TEST(OddSizes, PlanesWordsReadBackAndScanOutAgree) {
  for (const Size size : kSizes) {
    const Scene scene(size);
    for (const FrameBufferFormat& format : formats(size)) {
      SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height) + ", " + describe(format));
      Renderer renderer({.threads = 1});
      FrameBuffer buffer(format);
      FrameBuffer presented(format);
      Frame frame(buffer);
      Frame shown_frame(presented);
      scene.record(frame, format);
      renderer.finish(frame);
      const auto words = packed_colors(buffer);
      expect_planes(buffer, Buffer::color, words);
      if (format.depth != DepthFormat::none) expect_planes(buffer, Buffer::depth, stored_depths(buffer));
      if (format.stencil_bits > 0) expect_planes(buffer, Buffer::stencil, stencil_values(buffer));
      std::vector<std::uint8_t> expected;
      for (const PixelOrder order : {PixelOrder::rgba8, PixelOrder::bgra8})
        for (const bool upwards : {false, true}) {
          const auto read = shown(buffer, order, upwards, {},
                                  [&](const ImageTarget& target) { buffer.read_color(target); });
          scene.record(shown_frame, format);
          const auto scanned = shown(presented, order, upwards, {}, [&](const ImageTarget& target) {
            renderer.finish(shown_frame, target);
          });
          ASSERT_TRUE(read == scanned) << "read-back and scan-out differ";
          std::vector<std::uint8_t> turned = read;
          if (order == PixelOrder::bgra8)
            for (std::size_t i = 0; i < turned.size(); i += 4) std::swap(turned[i], turned[i + 2]);
          if (expected.empty()) expected = turned;
          ASSERT_TRUE(turned == expected) << "another byte or row order differs";
        }
      // A region: the same pixels inside, nothing written outside.
      const Rect part{size.width / 3, size.height / 2, size.width / 2 + 1, size.height / 3 + 1};
      const auto some = shown(buffer, PixelOrder::rgba8, true, part,
                              [&](const ImageTarget& target) { buffer.read_color(target); });
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const int up = size.height - 1 - y;
          const bool inside =
              x >= part.x && x < part.x + part.width && up >= part.y && up < part.y + part.height;
          for (std::size_t c = 0,
                           i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                    static_cast<std::size_t>(x));
               c < 4; ++c)
            ASSERT_EQ(some[i + c], inside ? expected[i + c] : 0xcd) << x << ", " << y;
        }
      // Stored levels are displayed through the palette or the bit split; without alpha planes alpha is 255.
      if (format.color_mode != ColorMode::rgb || format.color_bits <= 2 || format.alpha_bits == 8) continue;
      for (std::size_t i = 0; i < words.size(); ++i) ASSERT_EQ(expected[4 * i + 3], 255);
    }
  }
}

// In a buffer that is larger to the right and upwards the same scene has the same bits there.
TEST(OddSizes, MatchTheSamePartOfALargerBuffer) {
  for (const Size size : kSizes) {
    const Scene scene(size);
    const Size larger{std::max(size.width, 40), std::max(size.height, 40)};
    const auto smalls = formats(size);
    const auto larges = formats(larger);
    for (std::size_t f = 0; f < smalls.size(); ++f) {
      SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height) + ", " +
                   describe(smalls[f]));
      for (const int tile_size : {32, 128}) {
        Renderer renderer({.threads = 1, .tile_size = tile_size});
        FrameBuffer small(smalls[f]);
        FrameBuffer large(larges[f]);
        for (FrameBuffer* buffer : {&small, &large}) {
          Frame frame(*buffer);
          scene.record(frame, buffer->format());
          renderer.finish(frame);
        }
        const auto expect_part = [&](const auto& part, const auto& whole, const char* what) {
          for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
              const std::size_t here = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                       static_cast<std::size_t>(x);
              const std::size_t there = static_cast<std::size_t>(larger.height - size.height + y) *
                                            static_cast<std::size_t>(larger.width) +
                                        static_cast<std::size_t>(x);
              ASSERT_EQ(part[here], whole[there]) << what << " at " << x << ", " << y << " from the top";
            }
        };
        expect_part(packed_colors(small), packed_colors(large), "colour");
        if (smalls[f].depth != DepthFormat::none)
          expect_part(stored_depths(small), stored_depths(large), "depth");
        if (smalls[f].stencil_bits > 0) expect_part(stencil_values(small), stencil_values(large), "stencil");
        if (HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace tessera::test::odd_sizes_test
