// Captures of a region: the values of a capture of the whole frame buffer, the same picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::capture_region_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr FrameBufferFormat kFormat{.width = 150, .height = 110};

struct Captured {
  std::vector<std::uint32_t> draw_ids, primitive_ids;
  std::vector<float> normals;
  explicit Captured(std::size_t pixels) : draw_ids(pixels), primitive_ids(pixels), normals(3 * pixels) {}
  Capture capture(std::optional<Rect> region) {
    return {.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals, .region = region};
  }
};

TEST(CaptureRegion, HoldsTheValuesOfTheWholeCapture) {
  const RandomFrame scene(kFormat, 400);
  const Rect regions[] = {{0, 0, 150, 110}, {77, 41, 1, 1},  {149, 109, 1, 1}, {31, 30, 67, 40},
                          {0, 64, 150, 1},  {12, 0, 3, 110}, {5, 5, 0, 4}};
  for (const int tile_size : {32, 64, 128}) {
    Renderer renderer({.threads = 2, .tile_size = tile_size});
    FrameBuffer buffer(kFormat);
    const auto finish = [&](const Capture& capture) {
      Frame frame(buffer);
      scene.record(frame);
      frame.capture(capture);
      renderer.finish(frame);
      return packed_colors(buffer);
    };
    Captured whole(pixel_count(buffer));
    const std::vector<std::uint32_t> picture = finish(whole.capture(std::nullopt));
    for (const Rect& region : regions) {
      SCOPED_TRACE(std::to_string(region.width) + " x " + std::to_string(region.height));
      Captured part(static_cast<std::size_t>(region.width * region.height));
      EXPECT_EQ(finish(part.capture(region)), picture);
      std::size_t i = 0;
      for (int y = 0; y < region.height; ++y)
        for (int x = 0; x < region.width; ++x, ++i) {
          const auto at = static_cast<std::size_t>((110 - region.y - region.height + y) * 150 + region.x + x);
          ASSERT_EQ(part.draw_ids[i], whole.draw_ids[at]) << x << ", " << y;
          ASSERT_EQ(part.primitive_ids[i], whole.primitive_ids[at]) << x << ", " << y;
          for (std::size_t c = 0; c < 3; ++c)
            ASSERT_EQ(part.normals[3 * i + c], whole.normals[3 * at + c]) << x << ", " << y;
        }
    }
  }
}

TEST(CaptureRegion, RendersTheTilesOfTheRegionAlone) {
  FrameBuffer buffer({.width = 256, .height = 192});
  const MeshData mesh = whole_window();
  Renderer renderer({.threads = 1, .tile_size = 64});
  const auto tiles_for = [&](const Rect& region) {
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(region.width * region.height));
    Frame frame(buffer);
    frame.clear({.color = Color{}, .depth = 1.0});
    frame.draw(mesh.view(), unlit({1, 0, 0, 1}));
    frame.keep({});
    frame.capture({.draw_ids = ids, .region = region});
    const FrameStats stats = renderer.finish(frame);
    EXPECT_THAT(ids, testing::Each(0u));
    return stats.tiles_rendered;
  };
  EXPECT_EQ(tiles_for({100, 100, 1, 1}), 1u);
  EXPECT_EQ(tiles_for({63, 63, 2, 2}), 4u);
  EXPECT_EQ(tiles_for({0, 0, 256, 192}), 12u);
}

TEST(CaptureRegion, DoesNotChangeTheNumberOfFragments) {
  const RandomFrame scene(kFormat, 200);
  Renderer renderer({.threads = 1, .tile_size = 32, .debug = {.count_fragments = true}});
  FrameBuffer buffer(kFormat);
  const auto fragments_with = [&](const Capture& capture) {
    Frame frame(buffer);
    scene.record(frame);
    frame.capture(capture);
    return renderer.finish(frame).fragments;
  };
  std::uint32_t id = 0;
  EXPECT_EQ(fragments_with({.draw_ids = {&id, 1}, .region = Rect{3, 90, 1, 1}}), fragments_with({}));
}

TEST(CaptureRegion, MustLieInTheFrameBufferAndFitTheSpans) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  std::vector<std::uint32_t> ids(4);
  EXPECT_THAT(
      error_of([&] {
        frame.capture({.draw_ids = ids, .region = Rect{149, 0, 2, 2}});
      }).value_or(""),
      HasSubstr("Frame::capture: the region is 2 x 2 pixels at (149, 0), must lie in the frame buffer"));
  EXPECT_THAT(error_of([&] {
                frame.capture({.draw_ids = ids, .region = Rect{0, 0, 2, 3}});
              }).value_or(""),
              HasSubstr("holds 4 elements, the region needs 6"));
}

}  // namespace
}  // namespace tessera::capture_region_test
