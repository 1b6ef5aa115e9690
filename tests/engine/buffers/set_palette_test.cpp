// Palettes that change after the picture was drawn.
#include <limits>

#include "tests/engine/frame/index_pictures.h"

namespace tessera::set_palette_test {
namespace {

using namespace test;
using testing::Each;
using testing::HasSubstr;

std::vector<std::uint8_t> shown(const FrameBuffer& buffer) {
  Image image(buffer);
  buffer.read_color(image.target());
  return image.bytes;
}

TEST(SetPalette, ChangesTheShownColorsAndNotTheStoredIndices) {
  FrameBuffer buffer(kIndexFormat);
  Frame frame(buffer);
  frame.clear({.index = 2});
  Renderer renderer({.threads = 1});
  renderer.finish(frame);
  const Color red{1, 0, 0, 1};
  const Color green{0, 1, 0, 1};
  const Color blue{0, 0, 1, 1};
  const std::vector<Color> first{red, green, blue};
  const std::vector<Color> second{blue, red, green};
  buffer.set_palette(first);
  EXPECT_EQ(shown(buffer)[2], 255);
  buffer.set_palette(second);
  EXPECT_EQ(shown(buffer)[1], 255);
  EXPECT_EQ(shown(buffer)[2], 0);
  EXPECT_THAT(packed_colors(buffer), Each(2u));
  EXPECT_EQ(buffer.format().palette.size(), 3u);

  // Colours are matched with the palette that is set when the frame is finished.
  const MeshData mesh = whole_window();
  DrawState over = unlit(red);
  over.depth.enabled = false;
  const auto draw_red = [&] { frame.draw(mesh.view(), over); };
  draw_red();
  renderer.finish(frame);
  EXPECT_THAT(packed_colors(buffer), Each(1u));
  draw_red();
  buffer.set_palette(first);
  renderer.finish(frame);
  EXPECT_THAT(packed_colors(buffer), Each(0u));
  buffer.set_palette({});
  EXPECT_EQ(buffer.format().palette.size(), 16u);
  draw_red();
  renderer.finish(frame);
  EXPECT_THAT(packed_colors(buffer), Each(4u)) << "of ega16";
}

TEST(SetPalette, ErrorsChangeNothing) {
  FrameBuffer buffer(kIndexFormat);
  FrameBuffer rgb({.width = 4, .height = 4});
  Frame frame(buffer);
  frame.clear({.index = 9});
  Renderer({.threads = 1}).finish(frame);
  const auto before = shown(buffer);
  std::vector<Color> entries(65);
  EXPECT_THAT(error_of([&] { buffer.set_palette(entries); }).value_or(""),
              AllOf(HasSubstr("65"), HasSubstr("at most 64")));
  entries.resize(10);
  for (const float wrong : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    entries[7].g = wrong;
    EXPECT_THAT(error_of([&] { buffer.set_palette(entries); }).value_or(""),
                AllOf(HasSubstr("entry 7"), HasSubstr("0 to 1")));
  }
  EXPECT_EQ(shown(buffer), before);
  EXPECT_EQ(buffer.format().palette.size(), 16u);
  entries[7].g = 1;
  EXPECT_THAT(error_of([&] { rgb.set_palette(entries); }).value_or(""),
              AllOf(HasSubstr("set_palette"), HasSubstr("rgb")));
  EXPECT_EQ(error_of([&] { buffer.set_palette(entries); }), std::nullopt);
}

}  // namespace
}  // namespace tessera::set_palette_test
