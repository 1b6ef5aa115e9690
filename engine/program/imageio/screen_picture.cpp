#include "engine/program/imageio/screen_picture.h"

#include "engine/program/imageio/picture.h"

namespace tessera::program {
namespace {

std::vector<std::array<std::uint8_t, 3>> palette_of(const FrameBufferFormat& format) {
  std::vector<std::array<std::uint8_t, 3>> entries(std::size_t{1} << format.color_bits);
  const auto level = [](float component) { return static_cast<std::uint8_t>(component * 255 + 0.5f); };
  if (format.color_mode == ColorMode::index) {
    for (std::size_t i = 0; i < format.palette.size(); ++i) {
      const Color& c = format.palette[i];
      entries[i] = {level(c.r), level(c.g), level(c.b)};
    }
  } else {
    for (std::size_t i = 0; i < entries.size(); ++i)
      entries[i].fill(level(static_cast<float>(i) / static_cast<float>(entries.size() - 1)));
  }
  return entries;
}

}  // namespace

ScreenPicture screen_picture(const FrameBuffer& buffer, AspectRatio pixel_aspect) {
  const FrameBufferFormat& format = buffer.format();
  ScreenPicture screen{.width = format.width, .height = format.height, .pixel_aspect = pixel_aspect};
  screen.pixels.resize(static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height));
  if (format.color_bits <= (format.color_mode == ColorMode::index ? 8 : 2)) {
    screen.bits = format.color_bits;
    screen.palette = palette_of(format);
    buffer.read_packed_colors(screen.pixels);
    for (std::uint32_t& pixel : screen.pixels) pixel &= (1u << screen.bits) - 1;  // without alpha
    return screen;
  }
  Picture shown(format.width, format.height);
  buffer.read_color(shown.target());
  for (std::size_t i = 0; i < screen.pixels.size(); ++i)
    screen.pixels[i] = std::uint32_t{shown.rgba[4 * i]} << 16 | std::uint32_t{shown.rgba[4 * i + 1]} << 8 |
                       shown.rgba[4 * i + 2];
  return screen;
}

}  // namespace tessera::program
