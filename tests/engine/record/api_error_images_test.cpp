// Mismatched images and missing buffers are refused before a pixel is touched; the refused frame is still
// recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/engine/frame/api_support.h"

namespace tessera::api_error_images_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;

struct BadImage {
  const char* what;
  std::function<void(ImageTarget&)> change;
  std::vector<std::string> substrings;
};
const std::vector<BadImage> kBadImages = {
    {"null pixels", [](ImageTarget& t) { t.pixels = nullptr; }, {"null"}},
    {"wider", [](ImageTarget& t) { t.width = 21; }, {"21 x 10", "20 x 10"}},
    {"lower", [](ImageTarget& t) { t.height = 9; }, {"20 x 9", "20 x 10"}},
    {"empty", [](ImageTarget& t) { t.width = t.height = 0; }, {"0 x 0", "20 x 10"}},
    {"turned", [](ImageTarget& t) { std::swap(t.width, t.height); }, {"10 x 20", "20 x 10"}},
    {"stride 79", [](ImageTarget& t) { t.stride_bytes = 79; }, {"stride is 79", "80"}},
    {"stride -79", [](ImageTarget& t) { t.stride_bytes = -79; }, {"stride is -79", "80"}},
    {"stride in pixels", [](ImageTarget& t) { t.stride_bytes = 20; }, {"stride is 20", "80"}},
};

const FrameBufferFormat kFormat{.width = 20, .height = 10};
const MeshData kMesh = rectangle(-0.5f, -0.5f, 0.5f, 0.5f);

TEST(ErrorsOfImages, LeaveTheFrameRecordedAndTheBufferUnchanged) {
  Renderer renderer({.threads = 1});
  FrameBuffer plain(kFormat);
  FrameBuffer buffer(kFormat);
  Frame expected(plain);
  expected.clear({.color = Color{0, 0, 1, 1}});
  expected.draw(kMesh.view(), {});
  renderer.finish(expected);

  const Fingerprint before = fingerprint(buffer);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 1, 1}});
  frame.draw(kMesh.view(), {});
  frame.keep({Buffer::color, Buffer::depth});
  Image image(buffer);
  for (const BadImage& bad : kBadImages) {
    SCOPED_TRACE(bad.what);
    ImageTarget target = image.target();
    bad.change(target);
    const auto error = error_of([&] { renderer.finish(frame, target); });
    ASSERT_TRUE(error);
    for (const std::string& words : bad.substrings) EXPECT_THAT(*error, HasSubstr(words));
    EXPECT_EQ(frame.draw_count(), 1u);
    EXPECT_EQ(fingerprint(buffer), before);
    EXPECT_THAT(image.bytes, Each(0));
  }
  renderer.finish(frame, image.target());
  EXPECT_EQ(fingerprint(buffer), fingerprint(plain))
      << "the frame was rendered completely and kept its buffers";
  EXPECT_EQ(frame.draw_count(), 0u);
}

TEST(ErrorsOfImages, AreTheSameForReadingBack) {
  const FrameBuffer buffer(kFormat);
  Image image(buffer);
  std::fill(image.bytes.begin(), image.bytes.end(), std::uint8_t{7});
  for (const BadImage& bad : kBadImages) {
    SCOPED_TRACE(bad.what);
    ImageTarget target = image.target();
    bad.change(target);
    const auto error = error_of([&] { buffer.read_color(target); });
    ASSERT_TRUE(error);
    for (const std::string& words : bad.substrings) EXPECT_THAT(*error, HasSubstr(words));
    EXPECT_THAT(image.bytes, Each(7));
  }
}

TEST(ErrorsOfImages, StrideOfZeroMeansPackedRows) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 1, 1}});
  frame.draw(kMesh.view(), {});
  Renderer renderer({.threads = 1});
  Image shown(buffer), read(buffer), packed(buffer);
  frame.keep({Buffer::color});
  ImageTarget target = shown.target();
  target.stride_bytes = 0;
  renderer.finish(frame, target);
  buffer.read_color(packed.target());
  EXPECT_EQ(shown.bytes, packed.bytes);
  target = read.target();
  target.stride_bytes = 0;
  buffer.read_color(target);
  EXPECT_EQ(read.bytes, packed.bytes);
}

TEST(ErrorsOfReading, NameSpansOfTheWrongSize) {
  const FrameBuffer buffer(kFormat);
  std::vector<std::uint32_t> words(199);
  std::vector<float> depth(201);
  std::vector<std::uint8_t> stencil(0);
  EXPECT_THAT(error_of([&] { buffer.read_packed_colors(words); }).value_or(""),
              AllOf(HasSubstr("199"), HasSubstr("200")));
  EXPECT_THAT(error_of([&] { buffer.read_stored_depths(words); }).value_or(""),
              AllOf(HasSubstr("199"), HasSubstr("200")));
  EXPECT_THAT(error_of([&] { buffer.read_depth(depth); }).value_or(""),
              AllOf(HasSubstr("201"), HasSubstr("200")));
  EXPECT_THAT(error_of([&] { buffer.read_stencil(stencil); }).value_or(""),
              AllOf(HasSubstr("0"), HasSubstr("200")));
}

TEST(ErrorsOfReading, NameMissingBuffersAndPlanes) {
  const FrameBuffer buffer(
      {.width = 20, .height = 10, .color_bits = 15, .depth = DepthFormat::none, .stencil_bits = 0});
  std::vector<std::uint32_t> words(200);
  std::vector<float> depth(200);
  std::vector<std::uint8_t> stencil(200);
  EXPECT_THAT(error_of([&] { buffer.read_depth(depth); }).value_or(""), HasSubstr("no depth buffer"));
  EXPECT_THAT(error_of([&] { buffer.read_stored_depths(words); }).value_or(""), HasSubstr("no depth buffer"));
  EXPECT_THAT(error_of([&] { buffer.read_stencil(stencil); }).value_or(""), HasSubstr("no stencil buffer"));
  EXPECT_THAT(error_of([&] { buffer.plane(Buffer::depth, 0); }).value_or(""), HasSubstr("no depth buffer"));
  EXPECT_THAT(error_of([&] { buffer.plane(Buffer::stencil, 0); }).value_or(""),
              HasSubstr("no stencil buffer"));
  EXPECT_THAT(error_of([&] { buffer.plane(Buffer::color, 15); }).value_or(""),
              AllOf(HasSubstr("plane 15"), HasSubstr("0 to 14")));
  EXPECT_THAT(error_of([&] { buffer.plane(Buffer::color, -1); }).value_or(""),
              AllOf(HasSubstr("plane -1"), HasSubstr("0 to 14")));
  EXPECT_FALSE(error_of([&] { buffer.plane(Buffer::color, 14); }));
}

}  // namespace
}  // namespace tessera::api_error_images_test
