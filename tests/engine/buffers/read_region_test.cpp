// Reading a region of a buffer, and reading with a renderer's workers, gives the values of whole reads on one
// thread.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <barrier>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::read_region_test {
namespace {

using namespace test;
using testing::HasSubstr;

/// The values of a region of a picture, rows from the top.
template <class T>
std::vector<T> part_of(const std::vector<T>& whole, const FrameBufferFormat& format, const Rect& region,
                       int components = 1) {
  std::vector<T> part;
  for (int y = 0; y < region.height; ++y) {
    const int row = format.height - region.y - region.height + y;  // rectangles count rows from the bottom
    const auto first = whole.begin() + std::ptrdiff_t{components} * (row * format.width + region.x);
    part.insert(part.end(), first, first + std::ptrdiff_t{components} * region.width);
  }
  return part;
}

/// One of the reading functions of FrameBuffer.
template <class T>
struct Reader {
  const char* what;
  int components;
  std::function<void(const FrameBuffer&, std::span<T>, const ReadOptions&)> read;

  std::vector<T> whole(const FrameBuffer& buffer, Renderer* workers = nullptr) const {
    std::vector<T> values(static_cast<std::size_t>(components) * pixel_count(buffer));
    read(buffer, values, {.region = {}, .workers = workers});
    return values;
  }
  std::vector<T> region(const FrameBuffer& buffer, const Rect& rect, Renderer* workers) const {
    std::vector<T> values(static_cast<std::size_t>(components * rect.width * rect.height));
    read(buffer, values, {.region = rect, .workers = workers});
    return values;
  }
};

Camera camera_of(const FrameBuffer& buffer) {
  return {.projection = perspective(60, double(buffer.format().width) / buffer.format().height, 0.5, 7)};
}

std::vector<Reader<std::uint32_t>> word_readers(const FrameBufferFormat& format) {
  std::vector<Reader<std::uint32_t>> readers = {
      {"packed colours", 1, [](const FrameBuffer& b, std::span<std::uint32_t> to, const ReadOptions& o) {
         b.read_packed_colors(to, o);
       }}};
  if (format.depth != DepthFormat::none)
    readers.push_back(
        {"stored depths", 1, [](const FrameBuffer& b, std::span<std::uint32_t> to, const ReadOptions& o) {
           b.read_stored_depths(to, o);
         }});
  return readers;
}

std::vector<Reader<float>> float_readers(const FrameBufferFormat& format) {
  std::vector<Reader<float>> readers;
  if (format.depth != DepthFormat::none) {
    readers.push_back({"depth", 1, [](const FrameBuffer& b, std::span<float> to, const ReadOptions& o) {
                         b.read_depth(to, o);
                       }});
    readers.push_back({"view depth", 1, [](const FrameBuffer& b, std::span<float> to, const ReadOptions& o) {
                         b.read_view_depth(to, camera_of(b), -1, o);
                       }});
  }
  if (format.accumulation_bits != 0)
    readers.push_back(
        {"accumulation", 4, [](const FrameBuffer& b, std::span<float> to, const ReadOptions& o) {
           b.read_accumulation(to, o);
         }});
  return readers;
}

std::vector<Reader<std::uint8_t>> byte_readers(const FrameBufferFormat& format) {
  if (format.stencil_bits == 0) return {};
  return {{"stencil", 1, [](const FrameBuffer& b, std::span<std::uint8_t> to, const ReadOptions& o) {
             b.read_stencil(to, o);
           }}};
}

const std::vector<FrameBufferFormat>& formats() {
  static const std::vector<FrameBufferFormat> all = {
      {.width = 203, .height = 141, .alpha_bits = 8, .accumulation_bits = 16},
      {.width = 97, .height = 130, .color_bits = 16, .depth = DepthFormat::float32, .stencil_bits = 3},
      {.width = 161,
       .height = 65,
       .color_mode = ColorMode::index,
       .color_bits = 5,
       .depth = DepthFormat::none},
      {.width = 66,
       .height = 70,
       .color_bits = 6,
       .depth = DepthFormat::unorm16,
       .stencil_bits = 0,
       .dither = Dither::floyd_steinberg,
       .samples = 4},
      {.width = 1, .height = 33, .depth = DepthFormat::unorm32},
  };
  return all;
}

/// Fills all buffers with values that differ from pixel to pixel.
void draw(FrameBuffer& buffer, Renderer& renderer) {
  const FrameBufferFormat& format = buffer.format();
  RandomFrame scene(format, 300);
  Frame frame(buffer);
  frame.clear({.color = Color{0.1f, 0.2f, 0.3f, 1}});
  if (format.depth != DepthFormat::none) frame.clear({.depth = 1.0});
  frame.set_camera(scene.camera);
  frame.set_lights(scene.lights);
  DrawState state;
  if (format.stencil_bits != 0) {
    frame.clear({.stencil = 1u});
    state.stencil = StencilState{.front = {.zpass = StencilOp::incr_wrap}};
  }
  frame.draw(scene.triangles.view(), state);
  if (format.accumulation_bits != 0) frame.accumulate({.op = AccumOp::load, .value = 0.7});
  renderer.finish(frame);
}

Rect random_region(const FrameBufferFormat& format, Random& random) {
  Rect rect;
  rect.x = static_cast<int>(below(random, format.width));
  rect.y = static_cast<int>(below(random, format.height));
  rect.width = static_cast<int>(below(random, format.width - rect.x + 1));
  rect.height = static_cast<int>(below(random, format.height - rect.y + 1));
  return rect;
}

std::vector<Rect> regions_of(const FrameBufferFormat& format) {
  std::vector<Rect> rects = {{0, 0, format.width, format.height},
                             {0, 0, 1, 1},
                             {format.width - 1, format.height - 1, 1, 1},
                             {format.width / 2, 0, 1, format.height},
                             {0, format.height / 2, format.width, 1}};
  Random random(7);
  for (int i = 0; i < 12; ++i) rects.push_back(random_region(format, random));
  return rects;
}

template <class T>
void expect_parts(const FrameBuffer& buffer, const std::vector<Reader<T>>& readers, Renderer& renderer) {
  for (const Reader<T>& reader : readers) {
    SCOPED_TRACE(reader.what);
    const std::vector<T> whole = reader.whole(buffer);
    EXPECT_EQ(reader.whole(buffer, &renderer), whole) << "with workers";
    for (const Rect& rect : regions_of(buffer.format())) {
      const std::vector<T> expected = part_of(whole, buffer.format(), rect, reader.components);
      ASSERT_EQ(reader.region(buffer, rect, nullptr), expected)
          << rect.width << " x " << rect.height << " at " << rect.x << ", " << rect.y;
      ASSERT_EQ(reader.region(buffer, rect, &renderer), expected) << "with workers";
    }
  }
}

TEST(ReadRegion, HoldsTheValuesOfTheWholeBuffer) {
  for (const FrameBufferFormat& format : formats()) {
    SCOPED_TRACE(std::to_string(format.width) + " x " + std::to_string(format.height));
    Renderer renderer({.threads = 3});
    FrameBuffer buffer(format);
    for (const bool drawn : {false, true}) {  // a buffer that was only cleared has no planes
      if (drawn) draw(buffer, renderer);
      expect_parts(buffer, word_readers(format), renderer);
      expect_parts(buffer, float_readers(format), renderer);
      expect_parts(buffer, byte_readers(format), renderer);
    }
  }
}

TEST(ReadRegion, WorkersReadTheSamePicture) {
  for (const FrameBufferFormat& format : formats()) {
    Renderer renderer({.threads = 3});
    FrameBuffer buffer(format);
    draw(buffer, renderer);
    Image serial(buffer), parallel(buffer);
    buffer.read_color(serial.target());
    buffer.read_color(parallel.target(), &renderer);
    EXPECT_EQ(parallel.bytes, serial.bytes);
  }
}

/// Starts all workers of a call at the same time.
struct TwoThreads : Executor {
  int workers() const noexcept override { return 2; }
  void run(int count, void (*work)(void*, int), void* context) override {
    std::barrier start(count);
    std::vector<std::jthread> threads;
    for (int k = 0; k < count; ++k)
      threads.emplace_back([&start, work, context, k] {
        start.arrive_and_wait();
        work(context, k);
      });
  }
};

TEST(ReadRegion, WorkersDoNotShareMemory) {
  Renderer renderer({.executor = std::make_shared<TwoThreads>()});
  FrameBuffer buffer({.width = 2048, .height = 2048});
  draw(buffer, renderer);
  std::vector<std::uint32_t> serial(2048 * 2048), parallel(serial.size());
  buffer.read_packed_colors(serial);
  for (int i = 0; i < 5; ++i) {
    std::fill(parallel.begin(), parallel.end(), 0u);
    buffer.read_packed_colors(parallel, {.workers = &renderer});
    ASSERT_TRUE(parallel == serial) << "reading " << i;
  }
}

TEST(ReadRegion, HoldsTheBitsOfOnePixelInEveryPlane) {
  Renderer renderer({.threads = 2});
  FrameBuffer buffer({.width = 203, .height = 141});
  draw(buffer, renderer);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const int x = static_cast<int>(below(random, 203)), y = static_cast<int>(below(random, 141));
    std::uint32_t word = 0;
    buffer.read_packed_colors({&word, 1}, {.region = Rect{x, y, 1, 1}});
    for (int k = 0; k < 24; ++k) {
      const PlaneView plane = buffer.plane(Buffer::color, k);
      const int bit = plane.bits[(140 - y) * plane.stride_bytes + x / 8] >> (7 - x % 8) & 1;
      ASSERT_EQ(static_cast<int>(word >> k & 1), bit) << x << ", " << y << ", plane " << k;
    }
  }
}

TEST(ReadRegion, UsesTheWorkersOfTheExecutor) {
  struct Counting : Executor {
    int calls = 0;
    int workers() const noexcept override { return 4; }
    void run(int count, void (*work)(void*, int), void* context) override {
      ++calls;
      for (int k = 0; k < count; ++k) work(context, k);
    }
  };
  const auto executor = std::make_shared<Counting>();
  Renderer renderer({.executor = executor});
  FrameBuffer buffer({.width = 64, .height = 200});
  std::vector<float> depth(64 * 200);
  buffer.read_depth(depth, {.workers = &renderer});
  EXPECT_EQ(executor->calls, 1);
  buffer.read_depth(depth);
  EXPECT_EQ(executor->calls, 1);
}

TEST(ReadRegion, MustLieInTheFrameBuffer) {
  FrameBuffer buffer({.width = 8, .height = 6});
  std::vector<float> depth(48);
  for (const Rect& rect : {Rect{-1, 0, 2, 2}, Rect{0, -1, 2, 2}, Rect{7, 0, 2, 1}, Rect{0, 5, 1, 2},
                           Rect{0, 0, -1, 1}, Rect{0, 0, 1, -1}, Rect{2147483647, 0, 1, 1}}) {
    const auto message = error_of([&] { buffer.read_depth(depth, {.region = rect}); });
    EXPECT_THAT(message.value_or(""), HasSubstr("must lie in the frame buffer of 8 x 6"));
  }
}

TEST(ReadRegion, SpanHasThePixelsOfTheRegion) {
  FrameBuffer buffer({.width = 8, .height = 6, .accumulation_bits = 16});
  std::vector<float> values(48);
  EXPECT_THAT(error_of([&] {
                buffer.read_depth(values, {.region = Rect{1, 1, 3, 2}});
              }).value_or(""),
              HasSubstr("holds 48 elements, the pixels to read are 6"));
  EXPECT_THAT(error_of([&] {
                buffer.read_accumulation(values, {.region = Rect{1, 1, 3, 2}});
              }).value_or(""),
              HasSubstr("holds 48 elements, the pixels to read are 6 of 4 components"));
}

TEST(ReadRegion, RefusesAMovedFromRenderer) {
  FrameBuffer buffer({.width = 8, .height = 6});
  Renderer renderer({.threads = 1});
  const Renderer moved = std::move(renderer);
  std::vector<float> depth(48);
  EXPECT_THAT(error_of([&] { buffer.read_depth(depth, {.workers = &renderer}); }).value_or(""),
              HasSubstr("the renderer was moved from"));
}

}  // namespace
}  // namespace tessera::read_region_test
