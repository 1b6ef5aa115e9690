// Scan-out of a region: its pixels equal those of the whole picture, and the rest of the caller's memory is
// unchanged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::image_region_test {
namespace {

using namespace test;

constexpr std::uint8_t kUntouched = 0xa7;

void expect_part(const Image& part, const Image& whole, const Rect& rect, const char* what) {
  for (int y = 0; y < whole.height; ++y)
    for (int x = 0; x < whole.width; ++x) {
      const int up = whole.height - 1 - y;  // rectangles count rows from the bottom
      const bool inside = x >= rect.x && x < rect.x + rect.width && up >= rect.y && up < rect.y + rect.height;
      for (int c = 0; c < 4; ++c) {
        const auto at = static_cast<std::size_t>(4 * (y * whole.width + x) + c);
        ASSERT_EQ(part.bytes[at], inside ? whole.bytes[at] : kUntouched) << what << ": " << x << ' ' << y;
      }
    }
}

TEST(ImageRegion, FinishAndReadColorWriteTheRegionAlone) {
  const RandomFrame scene({.width = 203, .height = 141}, 300);
  const MeshData small = rectangle(-0.2f, -0.3f, 0.1f, 0.2f);
  Random random(5);
  for (int round = 0; round < 24; ++round) {
    const bool sparse = round % 2 == 1;  // most tiles show the clear colour only
    Rect rect{static_cast<int>(random.next() % 260) - 40, static_cast<int>(random.next() % 200) - 40,
              static_cast<int>(random.next() % 200), static_cast<int>(random.next() % 150)};
    if (round == 0) rect = {0, 0, 203, 141};
    if (round == 2) rect = {64, 13, 64, 64};
    Renderer renderer({.threads = 2, .tile_size = 32 << round % 3});
    FrameBuffer buffer(scene.format);
    const auto draw = [&](std::optional<Rect> part, Image& image, bool keep) {
      Frame frame(buffer);
      if (sparse) {
        frame.clear({.color = Color{0.5f, 0.25f, 1, 1}, .depth = 1.0});
        frame.draw(small.view(), unlit({1, 1, 0, 1}));
      } else {
        scene.record(frame);
      }
      if (keep) frame.keep({Buffer::color});
      ImageTarget target = image.target();
      target.region = part;
      renderer.finish(frame, target);
    };
    Image whole(buffer);
    Image part(buffer);
    Image read(buffer);
    Image kept(buffer);
    for (Image* image : {&part, &read, &kept})
      std::fill(image->bytes.begin(), image->bytes.end(), kUntouched);
    draw(std::nullopt, whole, false);
    draw(rect, part, false);
    expect_part(part, whole, rect, "finish");
    draw(rect, kept, true);
    expect_part(kept, whole, rect, "finish that keeps");
    ImageTarget target = read.target();
    target.region = rect;
    buffer.read_color(target);
    expect_part(read, whole, rect, "read_color");
    Image everything(buffer);
    buffer.read_color(everything.target());
    EXPECT_EQ(everything.bytes, whole.bytes) << "the whole buffer is kept";
  }
}

TEST(ImageRegion, NegativeSizeIsAnError) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Image image(buffer);
  ImageTarget target = image.target();
  target.region = Rect{0, 0, -1, 4};
  EXPECT_THAT(error_of([&] { buffer.read_color(target); }).value_or(""),
              testing::HasSubstr("region is -1 x 4"));
}

}  // namespace
}  // namespace tessera::image_region_test
