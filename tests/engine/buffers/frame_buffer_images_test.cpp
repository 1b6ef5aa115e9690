// Scan-out and read-back write exactly the pixels of the picture, in either byte order and either row order.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::frame_buffer_images_test {
namespace {

using namespace test;

constexpr std::uint8_t kUntouched = 0xa7;

struct Layout {
  const char* what;
  std::ptrdiff_t extra_bytes;  ///< gap after the pixels of a row
  std::size_t offset;          ///< bytes from an aligned address to the first pixel
  bool upwards;
  PixelOrder order;
};
const Layout kLayouts[] = {
    {"tight rows", 0, 0, false, PixelOrder::rgba8},
    {"tight rows, BGRA", 0, 0, false, PixelOrder::bgra8},
    {"rows upwards", 0, 0, true, PixelOrder::rgba8},
    {"gaps between rows", 12, 0, false, PixelOrder::rgba8},
    {"gaps of odd bytes", 13, 0, false, PixelOrder::bgra8},
    {"unaligned pixels", 0, 1, false, PixelOrder::rgba8},
    {"all at once", 7, 3, true, PixelOrder::bgra8},
    {"gaps wider than rows", 5000, 2, false, PixelOrder::rgba8},
};

const FrameBufferFormat kFormats[] = {
    {.width = 139, .height = 75},
    {.width = 64, .height = 64, .color_bits = 16},
    {.width = 130, .height = 33, .color_bits = 1},
    {.width = 75, .height = 139, .color_mode = ColorMode::index, .color_bits = 8},
    {.width = 1, .height = 40, .color_bits = 8},
};

std::vector<InstructionSet> sets() { return available_instruction_sets(); }

// An image whose memory, including the gaps around and between its rows, starts with one value.
struct GuardedImage {
  int width, height;
  Layout layout;
  std::ptrdiff_t row_bytes;
  std::ptrdiff_t stride;
  std::vector<std::uint8_t> memory;
  std::uint8_t* first;  ///< byte with the lowest address

  GuardedImage(const FrameBufferFormat& format, const Layout& l)
      : width(format.width),
        height(format.height),
        layout(l),
        row_bytes(4 * width),
        stride(row_bytes + l.extra_bytes) {
    memory.assign(static_cast<std::size_t>(stride * height) + 512, kUntouched);
    first = memory.data() + 128;
    first += (64 - reinterpret_cast<std::uintptr_t>(first) % 64) % 64 + layout.offset;
  }
  std::uint8_t* row(int y) { return first + (layout.upwards ? height - 1 - y : y) * stride; }
  ImageTarget target() { return {row(0), width, height, layout.upwards ? -stride : stride, layout.order}; }
  void expect_picture(const std::vector<std::uint8_t>& rgba) {
    std::vector<std::uint8_t> expected(memory.size(), kUntouched);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::uint8_t* const p = &rgba[static_cast<std::size_t>(4 * (y * width + x))];
        std::uint8_t* const out = expected.data() + (row(y) - memory.data()) + 4 * x;
        const bool swap = layout.order == PixelOrder::bgra8;
        out[0] = p[swap ? 2 : 0];
        out[1] = p[1];
        out[2] = p[swap ? 0 : 2];
        out[3] = 255;
      }
    EXPECT_TRUE(memory == expected);
  }
};

TEST(FrameBufferImages, ScanOutAndReadBackWriteExactlyThePicture) {
  for (const FrameBufferFormat& format : kFormats) {
    const RandomFrame random(format, 100);
    for (const InstructionSet set : sets()) {
      Renderer renderer({.threads = 2, .tile_size = 32, .instruction_set = set});
      FrameBuffer buffer(format);
      Frame frame(buffer);
      random.record(frame);
      renderer.finish(frame);
      Image plain(buffer);
      buffer.read_color(plain.target());
      for (const Layout& layout : kLayouts) {
        SCOPED_TRACE(std::string(layout.what) + ", " + std::string(name(set)) + ", width " +
                     std::to_string(format.width));
        GuardedImage read(format, layout);
        GuardedImage shown(format, layout);
        buffer.read_color(read.target());
        read.expect_picture(plain.bytes);
        FrameBuffer other(format);
        Frame again(other);
        random.record(again);
        renderer.finish(again, shown.target());
        shown.expect_picture(plain.bytes);
      }
    }
  }
}

// Tiles without draws take a shorter scan-out path.
TEST(FrameBufferImages, ScanOutShowsAFrameOfClearsAlone) {
  for (const FrameBufferFormat& format : kFormats)
    for (const Layout& layout : kLayouts) {
      SCOPED_TRACE(std::string(layout.what) + ", width " + std::to_string(format.width));
      Renderer renderer({.threads = 1, .tile_size = 32});
      FrameBuffer buffer(format);
      GuardedImage shown(format, layout);
      Frame frame(buffer);
      frame.clear({.color = Color{0, 1, 0, 1}});
      frame.clear({.color = Color{0.2f, 0.5f, 0.9f, 1}, .depth = 0.5});
      frame.keep({Buffer::color});
      renderer.finish(frame, shown.target());
      Image plain(buffer);
      buffer.read_color(plain.target());
      shown.expect_picture(plain.bytes);
      GuardedImage alone(format, layout);
      frame.clear({.color = Color{0.2f, 0.5f, 0.9f, 1}, .depth = 0.5});
      renderer.finish(frame, alone.target());
      alone.expect_picture(plain.bytes);
    }
}

TEST(FrameBufferImages, EmptyFrameShowsTheStoredPicture) {
  for (const FrameBufferFormat& format : kFormats) {
    Renderer renderer({.threads = 1});
    FrameBuffer buffer(format);
    const RandomFrame random(format, 60);
    Frame frame(buffer);
    random.record(frame);
    renderer.finish(frame);
    Image plain(buffer);
    Image shown(buffer);
    Image shown_again(buffer);
    buffer.read_color(plain.target());
    renderer.finish(frame, shown.target());
    EXPECT_EQ(shown.bytes, plain.bytes);
    renderer.finish(frame, shown_again.target());
    EXPECT_EQ(shown_again.bytes, plain.bytes) << "scan-out keeps the stored picture";
    buffer.read_color(shown.target());
    EXPECT_EQ(shown.bytes, plain.bytes);
  }
}

TEST(FrameBufferImages, FirstRowIsTheTopRow) {
  FrameBuffer buffer({.width = 3, .height = 2});
  const MeshData upper = rectangle(-1, 0, 1, 1);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}});
  frame.draw(upper.view(), unlit({1, 0, 0, 1}));
  Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(packed_colors(buffer), (std::vector<std::uint32_t>{0xff0000, 0xff0000, 0xff0000, 0, 0, 0}));
}

}  // namespace
}  // namespace tessera::frame_buffer_images_test
