#include "engine/program/cli/indexed_frame.h"

#include "engine/program/imageio/screen_picture.h"

namespace tessera::program::cli {

bool is_indexed(const FrameBufferFormat& format) {
  return format.color_bits <= (format.color_mode == ColorMode::index ? 8 : 2);
}

IndexedPicture indexed_picture(const FrameBuffer& buffer) {
  const ScreenPicture screen = screen_picture(buffer, {});
  IndexedPicture picture{.width = screen.width, .height = screen.height};
  while (picture.bits / 2 >= screen.bits) picture.bits /= 2;
  picture.indices.assign(screen.pixels.begin(), screen.pixels.end());
  if (buffer.format().color_mode == ColorMode::index)
    for (const auto& entry : screen.palette)
      picture.palette.insert(picture.palette.end(), entry.begin(), entry.end());
  return picture;
}

}  // namespace tessera::program::cli
