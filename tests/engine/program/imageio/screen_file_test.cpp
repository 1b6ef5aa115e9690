// ILBM and PCX files of every display mode, decoded by netpbm and by ffmpeg.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

#include "engine/program/imageio/ilbm.h"
#include "engine/program/imageio/pcx.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/imageio/screen_picture.h"
#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::screen_file_test {
namespace {

namespace fs = std::filesystem;

/// Modes with and without a table entry: every number of bits, odd widths, two colours of a palette.
std::vector<DisplayMode> file_modes() {
  std::vector<DisplayMode> modes;
  for (const DisplayMode& mode : display_modes())
    if (mode.layout != MemoryLayout::character_cells) modes.push_back(mode);
  for (int bits = 1; bits <= 24; ++bits) modes.push_back(display_mode("51x7x" + std::to_string(bits)));
  for (int bits = 1; bits <= 12; ++bits)
    modes.push_back(display_mode("50x7x" + std::to_string(bits) + ":color=index"));
  DisplayMode two_colors = display_mode("33x7x1:color=index");
  two_colors.palette = {{0, 0, 1}, {1, 1, 0}};
  modes.push_back(two_colors);
  return modes;
}

/// A frame buffer of the mode: rows of noise, of long runs and of a gradient.
FrameBuffer drawn_buffer(const DisplayMode& mode) {
  FrameBuffer buffer(frame_buffer_format(mode));
  std::mt19937 random(static_cast<unsigned>(mode.width));
  Picture picture(mode.width, mode.height);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    const std::size_t x = i / 4 % static_cast<std::size_t>(mode.width);
    const std::size_t y = i / 4 / static_cast<std::size_t>(mode.width);
    const std::size_t run = x / 150 * 85 + 40 * (i % 4);
    const std::size_t gradient = 255 * x / static_cast<std::size_t>(mode.width);
    picture.rgba[i] = static_cast<std::uint8_t>(y % 3 == 0   ? random()
                                                : y % 3 == 1 ? run
                                                             : gradient + 30 * (i % 4));
  }
  Frame frame(buffer);
  frame.draw_image({.pixels = picture.rgba.data(), .width = mode.width, .height = mode.height},
                   {.depth = {.enabled = false}});
  frame.keep({Buffer::color});
  Renderer renderer;
  renderer.finish(frame);
  return buffer;
}

/// Red, green and blue of a stored word, by the definition of the displayed level.
std::array<long, 3> displayed(const FrameBufferFormat& format, std::uint32_t word) {
  if (format.color_mode == ColorMode::index) {
    const Color c = word < format.palette.size() ? format.palette[word] : Color{};
    return {std::lround(255 * c.r), std::lround(255 * c.g), std::lround(255 * c.b)};
  }
  const int bits = format.color_bits;
  const auto level = [](std::uint32_t v, int b) {
    return b == 0 ? 0 : std::lround(255.0 * v / ((1 << b) - 1));
  };
  if (bits <= 2) return {level(word, bits), level(word, bits), level(word, bits)};
  const int b = bits / 3, g = b + (bits % 3 > 0 ? 1 : 0), r = b + (bits % 3 > 1 ? 1 : 0);
  return {level(word >> (g + b), r), level(word >> b & ((1u << g) - 1), g), level(word & ((1u << b) - 1), b)};
}

class ScreenFile : public testing::Test {
 protected:
  ScreenFile() : folder_(fs::temp_directory_path() / ("tessera_screen_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~ScreenFile() override { fs::remove_all(folder_); }

  static bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null").c_str()) == 0;
  }
  /// Writes the file, runs the command in its folder and compares the picture in decoded.ppm with the planes.
  void expect_decoded(const FrameBuffer& buffer, const std::string& file, const std::string& name,
                      const std::string& command, const std::string& mode) const {
    fs::remove(folder_ / "decoded.ppm");
    std::ofstream(folder_ / name, std::ios::binary) << file;
    ASSERT_EQ(std::system(("cd '" + folder_.string() + "' && " + command).c_str()), 0) << mode;
    const Picture decoded = read_picture((folder_ / "decoded.ppm").string());
    const FrameBufferFormat& format = buffer.format();
    ASSERT_EQ(decoded.width, format.width) << mode;
    ASSERT_EQ(decoded.height, format.height) << mode;
    std::vector<std::uint32_t> words(decoded.rgba.size() / 4);
    buffer.read_packed_colors(words);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto color = displayed(format, words[i]);
      for (std::size_t c = 0; c < 3; ++c) wrong += decoded.rgba[4 * i + c] != color[c] ? 1u : 0u;
    }
    EXPECT_EQ(wrong, 0u) << mode;
  }
  fs::path folder_;
};

TEST_F(ScreenFile, IlbmIsReadByNetpbm) {
  if (!has_program("ilbmtoppm")) GTEST_SKIP() << "needs ilbmtoppm (Debian package netpbm)";
  for (const DisplayMode& mode : file_modes()) {
    const FrameBuffer buffer = drawn_buffer(mode);
    const ScreenPicture screen = screen_picture(buffer, mode.pixel_aspect);
    expect_decoded(buffer, encode_ilbm(screen), "screen.iff", "ilbmtoppm screen.iff >decoded.ppm 2>log.txt",
                   mode.name);
  }
}

TEST_F(ScreenFile, PcxIsReadByFfmpeg) {
  if (!has_program("ffmpeg")) GTEST_SKIP() << "needs ffmpeg";
  for (const DisplayMode& mode : file_modes()) {
    const FrameBuffer buffer = drawn_buffer(mode);
    const ScreenPicture screen = screen_picture(buffer, mode.pixel_aspect);
    expect_decoded(
        buffer, encode_pcx(screen), "screen.pcx",
        "ffmpeg -v error -nostdin -y -f pcx_pipe -i screen.pcx -pix_fmt rgb24 -update 1 decoded.ppm "
        "2>log.txt",
        mode.name);
  }
}

/// Two bytes of a file, the lower one first.
std::size_t word_at(const std::string& file, std::size_t at) {
  return static_cast<std::uint8_t>(file[at]) + std::size_t{256} * static_cast<std::uint8_t>(file[at + 1]);
}

TEST(ScreenFileBytes, RowsAndChunksHaveEvenLengths) {
  for (int bits : {1, 3, 4, 8, 24}) {
    const DisplayMode mode = display_mode("51x7x" + std::to_string(bits) + ":aspect=29:45");
    const ScreenPicture screen = screen_picture(drawn_buffer(mode), mode.pixel_aspect);
    const std::size_t pcx_row = bits == 1 || bits == 4 ? 8 : 52;  // 51 bits or bytes, padded
    EXPECT_EQ(word_at(encode_pcx(screen), 66), pcx_row) << bits;
    const std::string ilbm = encode_ilbm(screen);
    EXPECT_EQ(ilbm.size() % 2, 0u) << bits;
    std::size_t form_bytes = 0;
    for (std::size_t i = 4; i < 8; ++i) form_bytes = 256 * form_bytes + static_cast<std::uint8_t>(ilbm[i]);
    EXPECT_EQ(form_bytes + 8, ilbm.size()) << bits;
    EXPECT_EQ(ilbm[34], 29) << "aspect in BMHD";
    EXPECT_EQ(ilbm[35], 45);
  }
}

}  // namespace
}  // namespace tessera::program::screen_file_test
