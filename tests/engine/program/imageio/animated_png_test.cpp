// The chunks of animated PNG files, and their frames as libpng decodes them.
#include "engine/program/imageio/animated_png.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

#include "engine/program/imageio/png.h"
#include "engine/program/imageio/png_chunks.h"
#include "tests/engine/program/imageio/png_chunk_walk.h"
#include "tests/engine/program/imageio/png_reader.h"

namespace tessera::program::animated_png_test {
namespace {

namespace fs = std::filesystem;

class AnimatedPngFile : public testing::Test {
 protected:
  AnimatedPngFile() : folder_(fs::temp_directory_path() / ("tessera_apng_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~AnimatedPngFile() override { fs::remove_all(folder_); }

  std::string path() const { return (folder_ / "a.png").string(); }
  std::string content() const {
    std::ifstream stream(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  bool is_empty() const { return fs::is_empty(folder_); }

  fs::path folder_;
};

Picture noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Picture picture(width, height);
  for (std::uint8_t& level : picture.rgba) level = static_cast<std::uint8_t>(random());
  return picture;
}

void add(const Picture& picture, AnimatedPng& file) {
  const PngImage image = as_png(picture, 3);
  file.add(image, compress_pixels(image, 1));
}

/// The frames as PNG files; checks sequence numbers and frame controls.
std::vector<std::string> frames_of(const std::vector<PngChunk>& chunks, std::uint32_t delay_ms) {
  std::vector<std::string> data;
  std::uint32_t sequence = 0;
  for (const PngChunk& chunk : chunks) {
    if (chunk.type == "fcTL") {
      EXPECT_EQ(big_endian(chunk.data, 0, 4), sequence++);
      EXPECT_EQ(chunk.data.substr(4, 8), chunks[0].data.substr(0, 8)) << "size";
      EXPECT_EQ(chunk.data.substr(12, 8), std::string(8, '\0')) << "position";
      EXPECT_EQ(big_endian(chunk.data, 20, 2), delay_ms);
      EXPECT_EQ(big_endian(chunk.data, 22, 2), 1000u);
      EXPECT_EQ(chunk.data.substr(24), std::string(2, '\0')) << "disposal, blending";
      data.emplace_back();
    }
    if (chunk.type == "IDAT") data.back() += chunk.data;
    if (chunk.type == "fdAT") {
      EXPECT_EQ(big_endian(chunk.data, 0, 4), sequence++);
      data.back() += chunk.data.substr(4);
    }
  }
  std::vector<std::string> files;
  for (const std::string& stream : data) {
    std::string file = "\x89PNG\r\n\x1a\n";
    append_chunk("IHDR", chunks[0].data, file);
    append_pixel_data(stream, file);
    append_chunk("IEND", "", file);
    files.push_back(file);
  }
  return files;
}

TEST_F(AnimatedPngFile, FramesHoldThePicturesInOrder) {
  std::vector<Picture> pictures;
  for (unsigned f = 0; f < 3; ++f) pictures.push_back(noise(700, 600, f));  // more than one chunk each
  AnimatedPng file(path(), 3, 125);
  for (const Picture& picture : pictures) add(picture, file);
  file.finish();
  const auto chunks = png_chunks(content());
  EXPECT_EQ(types_of(chunks), "IHDR acTL fcTL IDAT IDAT fcTL fdAT fdAT fcTL fdAT fdAT IEND");
  EXPECT_EQ(chunks[1].data, std::string("\0\0\0\x03\0\0\0\0", 8)) << "3 frames, without end";
  const auto frames = frames_of(chunks, 125);
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t f = 0; f < 3; ++f) {
    const DecodedPng decoded = read_by_libpng(frames[f]);
    for (std::size_t i = 0; i < std::size_t{700} * 600; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(decoded.rows[i / 700][3 * (i % 700) + c], pictures[f].rgba[4 * i + c]) << f << ": " << i;
  }
  EXPECT_EQ(read_by_libpng(content()).rows, read_by_libpng(frames[0]).rows) << "readers of still pictures";
}

TEST_F(AnimatedPngFile, PalettesPrecedeTheFrames) {
  IndexedPicture picture{.width = 3, .height = 1, .bits = 4};
  picture.indices = {1, 2, 15};
  picture.palette.assign(48, 7);
  const PngImage image = as_png(picture);
  AnimatedPng file(path(), 2, kMaxDelayMs);
  for (int f = 0; f < 2; ++f) file.add(image, compress_pixels(image, 9));
  file.finish();
  const auto chunks = png_chunks(content());
  EXPECT_EQ(types_of(chunks), "IHDR acTL PLTE fcTL IDAT fcTL fdAT IEND");
  EXPECT_EQ(big_endian(chunks[3].data, 20, 2), 65535u);
}

TEST_F(AnimatedPngFile, RefusesFramesThatDiffer) {
  IndexedPicture dark{.width = 4, .height = 4};
  dark.indices.assign(16, 0);
  dark.palette.assign(3, 0);
  IndexedPicture light = dark;
  light.palette.assign(3, 255);
  {
    AnimatedPng file(path(), 2, 40);
    file.add(as_png(dark), "");
    EXPECT_THROW(file.add(as_png(light), ""), Error);
  }
  EXPECT_TRUE(is_empty());
  try {
    AnimatedPng file(path(), 2, 40);
    add(Picture(8, 4), file);
    add(Picture(8, 5), file);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("frame 1 is 8x5, the first is 8x4"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(is_empty());
}

TEST_F(AnimatedPngFile, UnfinishedFilesVanish) {
  {
    AnimatedPng file(path(), 2, 40);
    add(Picture(8, 4), file);
  }
  EXPECT_TRUE(is_empty());
  std::ofstream(path()) << "old";
  {
    AnimatedPng file(path(), 2, 40);
    add(Picture(8, 4), file);
  }
  EXPECT_EQ(content(), "old");
}

}  // namespace
}  // namespace tessera::program::animated_png_test
