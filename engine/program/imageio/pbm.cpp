#include "engine/program/imageio/pbm.h"

namespace tessera::program {

std::string encode_pbm(const ScreenPicture& screen) {
  constexpr std::array<std::uint8_t, 3> kBlack{0, 0, 0}, kWhite{255, 255, 255};
  if (screen.bits != 1) throw Error("a .pbm file holds 1 bit per pixel, the picture has more");
  for (const auto& entry : screen.palette)
    if (entry != kBlack && entry != kWhite)
      throw Error("a .pbm file is black and white, the palette has other colours");
  std::string file = "P4\n" + std::to_string(screen.width) + " " + std::to_string(screen.height) + "\n";
  for (int y = 0; y < screen.height; ++y) {
    std::string row(static_cast<std::size_t>((screen.width + 7) / 8), '\0');
    for (int x = 0; x < screen.width; ++x)
      if (screen.palette[screen.pixel(x, y)] == kBlack)
        row[static_cast<std::size_t>(x / 8)] |= static_cast<char>(0x80 >> x % 8);
    file += row;
  }
  return file;
}

}  // namespace tessera::program
