// Memory of display modes, read back by unpackers that share nothing with the library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/tessera.hpp"

namespace tessera::display_memory_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A mode with the size of its memory, and the value of pixel (x, y) in it.
struct ModeMemory {
  std::string name;
  std::size_t bytes;
  std::uint32_t (*pixel)(const Bytes& memory, std::size_t x, std::size_t y);
};

std::uint32_t cga4(const Bytes& m, std::size_t x, std::size_t y) {
  const std::uint8_t byte = m[(y % 2 == 1 ? 0x2000 : 0) + y / 2 * 80 + x / 4];
  return byte >> (6 - 2 * (x % 4)) & 3;
}
std::uint32_t cga2(const Bytes& m, std::size_t x, std::size_t y) {
  return m[(y % 2 == 1 ? 0x2000 : 0) + y / 2 * 80 + x / 8] >> (7 - x % 8) & 1;
}
std::uint32_t hercules(const Bytes& m, std::size_t x, std::size_t y) {
  return m[y % 4 * 0x2000 + y / 4 * 90 + x / 8] >> (7 - x % 8) & 1;
}
template <std::size_t row_bytes, std::size_t rows, int planes>
std::uint32_t planar(const Bytes& m, std::size_t x, std::size_t y) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < planes; ++k)
    if ((m[k * row_bytes * rows + y * row_bytes + x / 8] & (0x80 >> x % 8)) != 0) value += 1u << k;
  return value;
}
template <std::size_t row_bytes, std::size_t bits>
std::uint32_t packed_bits(const Bytes& m, std::size_t x, std::size_t y) {
  std::uint32_t value = 0;
  for (std::size_t i = x * bits; i < (x + 1) * bits; ++i)
    value = 2 * value + (m[y * row_bytes + i / 8] >> (7 - i % 8) & 1);
  return value;
}
template <std::size_t width>
std::uint32_t chunky(const Bytes& m, std::size_t x, std::size_t y) {
  return m[y * width + x];
}
std::uint32_t unchained(const Bytes& m, std::size_t x, std::size_t y) {
  return m[(x & 3) * 19200 + y * 80 + (x >> 2)];
}
template <std::size_t width, std::size_t bytes>
std::uint32_t little(const Bytes& m, std::size_t x, std::size_t y) {
  std::uint32_t value = 0;
  for (std::size_t k = bytes; k-- > 0;) value = value * 256 + m[(y * width + x) * bytes + k];
  return value;
}
template <std::size_t width, std::size_t bytes>
std::uint32_t big(const Bytes& m, std::size_t x, std::size_t y) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < bytes; ++k) value = value * 256 + m[(y * width + x) * bytes + k];
  return value;
}

const ModeMemory kMemories[] = {
    {"hercules", 32768, hercules},
    {"mono", 38400, packed_bits<80, 1>},
    {"cga", 16384, cga4},
    {"cga-hi", 16384, cga2},
    {"ega-lo", 4 * 8000, planar<40, 200, 4>},
    {"ega", 4 * 28000, planar<80, 350, 4>},
    {"vga", 4 * 38400, planar<80, 480, 4>},
    {"vga13h", 64000, chunky<320>},
    {"vga-x", 4 * 19200, unchained},
    {"svga56", 480000, chunky<800>},
    {"svga", 480000, chunky<800>},
    {"8514a", 786432, chunky<1024>},
    {"xga", 786432, chunky<1024>},
    {"vga15", 614400, little<640, 2>},
    {"vga15:bytes=big", 614400, big<640, 2>},
    {"vga16", 614400, little<640, 2>},
    {"vga16:bytes=big", 614400, big<640, 2>},
    {"vga24", 921600, little<640, 3>},
    {"vga24:bytes=big", 921600, big<640, 3>},
    {"svga15", 960000, little<800, 2>},
    {"svga16", 960000, little<800, 2>},
    {"svga24", 1440000, little<800, 3>},
    {"xga24", 2359296, little<1024, 3>},
    {"sxga", 3932160, little<1280, 3>},
    {"uxga", 5760000, little<1600, 3>},
    {"vesa1920", 8294400, little<1920, 3>},
    {"amiga", 51200, planar<40, 256, 5>},
    {"amiga-ntsc", 40000, planar<40, 200, 5>},
    {"gray1", 12000, packed_bits<50, 1>},
    {"gray2", 19200, packed_bits<80, 2>},
    {"gray4", 240000, packed_bits<400, 4>},
    // Rows that end within a byte.
    {"13x5x1", 2 * 5, packed_bits<2, 1>},
    {"13x5x2", 4 * 5, packed_bits<4, 2>},
    {"13x5x4", 7 * 5, packed_bits<7, 4>},
    {"13x5x8", 13 * 5, chunky<13>},
    {"13x5x3", 2 * 5 * 3, planar<2, 5, 3>},
    {"13x5x7", 2 * 5 * 7, planar<2, 5, 7>},
    {"13x5x9", 2 * 13 * 5, little<13, 2>},
    {"13x5x17:bytes=big", 3 * 13 * 5, big<13, 3>},
};

TEST(DisplayMemory, HoldsEveryPixelWhereTheHardwareHasIt) {
  std::mt19937 random(1);
  for (const ModeMemory& expected : kMemories) {
    const DisplayMode mode = display_mode(expected.name);
    ASSERT_EQ(memory_bytes(mode), expected.bytes) << mode.name;
    const auto width = static_cast<std::size_t>(mode.width), height = static_cast<std::size_t>(mode.height);
    std::vector<std::uint32_t> words(width * height);
    for (std::uint32_t& word : words) word = random();  // the bits above the mode's are to be ignored
    Bytes memory(expected.bytes, 0xa5);
    write_memory(mode, words, memory);
    std::size_t wrong = 0;
    std::uint64_t set_bits = 0, set_bits_in_memory = 0;
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint32_t word = words[y * width + x] & ((1u << mode.color_bits) - 1);
        wrong += expected.pixel(memory, x, y) != word ? 1u : 0u;
        set_bits += static_cast<std::uint64_t>(__builtin_popcount(word));
      }
    for (const std::uint8_t byte : memory)
      set_bits_in_memory += static_cast<std::uint64_t>(__builtin_popcount(byte));
    EXPECT_EQ(wrong, 0u) << mode.name;
    EXPECT_EQ(set_bits, set_bits_in_memory) << mode.name << ": bits of no pixel must be 0";
  }
}

TEST(DisplayMemory, TheTableOfTheTestHasEveryMode) {
  for (const DisplayMode& mode : display_modes())
    EXPECT_TRUE(mode.name == "mda" || std::any_of(std::begin(kMemories), std::end(kMemories),
                                                  [&](const ModeMemory& m) { return m.name == mode.name; }))
        << mode.name;
}

TEST(DisplayMemory, FifteenBitsAreRedGreenBlueFromAboveBelowAZero) {
  const DisplayMode mode = display_mode("1x1x15");
  const std::vector<std::uint32_t> words{0b10000'00100'00001};
  Bytes memory(2);
  write_memory(mode, words, memory);
  EXPECT_EQ(memory, (Bytes{0b100'00001, 0b0'10000'00})) << "GGGBBBBB 0RRRRRGG";
}

TEST(DisplayMemory, RefusesOtherSizes) {
  const DisplayMode mode = display_mode("cga");
  std::vector<std::uint32_t> words(320 * 200);
  Bytes memory(16384);
  EXPECT_NO_THROW(write_memory(mode, words, memory));
  memory.resize(16000);
  EXPECT_THROW(write_memory(mode, words, memory), Error);
  memory.resize(16384);
  words.pop_back();
  EXPECT_THROW(write_memory(mode, words, memory), Error);
  EXPECT_THROW(memory_bytes(display_mode("mda")), Error);
}

}  // namespace
}  // namespace tessera::display_memory_test
