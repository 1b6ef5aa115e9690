// Errors of frame buffers, palettes, renderers and matrices: each message names the value found and the value
// expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/engine/frame/api_support.h"

namespace tessera::api_error_formats_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

struct Misuse {
  const char* what;
  std::function<void()> act;
  std::vector<std::string> substrings;  ///< all substrings of the message
};

void expect_errors(const std::vector<Misuse>& misuses) {
  for (const Misuse& misuse : misuses) {
    SCOPED_TRACE(misuse.what);
    const std::optional<std::string> error = error_of(misuse.act);
    if (!error) {
      ADD_FAILURE() << "no error was thrown";
      continue;
    }
    for (const std::string& words : misuse.substrings) EXPECT_THAT(*error, HasSubstr(words));
  }
}

std::function<void()> make(FrameBufferFormat format) {
  return [format] { FrameBuffer{format}; };
}
FrameBufferFormat index_format(int bits, std::vector<Color> palette) {
  return {.width = 4,
          .height = 4,
          .color_mode = ColorMode::index,
          .color_bits = bits,
          .palette = std::move(palette)};
}

TEST(ErrorsOfFrameBuffers, NameSizesAndBitsOutOfRange) {
  expect_errors({
      {"width 0", make({.width = 0}), {"width", "0 px", "1 to 16384"}},
      {"width -5", make({.width = -5}), {"width", "-5", "1 to 16384"}},
      {"width 16385", make({.width = 16385}), {"width", "16385", "1 to 16384"}},
      {"height 0", make({.height = 0}), {"height", "0 px", "1 to 16384"}},
      {"height 16385", make({.height = 16385}), {"height", "16385", "1 to 16384"}},
      {"both huge", make({.width = 1 << 30, .height = 1 << 30}), {"width", "1073741824"}},
      {"0 colour bits", make({.color_bits = 0}), {"color_bits is 0", "1 to 24"}},
      {"25 colour bits", make({.color_bits = 25}), {"color_bits is 25", "1 to 24"}},
      {"-1 colour bits", make({.color_bits = -1}), {"color_bits is -1", "1 to 24"}},
      {"25 index bits", make(index_format(25, {})), {"color_bits is 25", "1 to 24"}},
      {"9 stencil bits", make({.stencil_bits = 9}), {"stencil_bits is 9", "0 to 8"}},
      {"-1 stencil bits", make({.stencil_bits = -1}), {"stencil_bits is -1", "0 to 8"}},
  });
}

TEST(ErrorsOfFrameBuffers, NameMissingPlanesAndSamples) {
  const std::vector<Misuse> misuses{
      {"4 alpha bits", make({.alpha_bits = 4}), {"alpha_bits is 4", "0 or 8"}},
      {"-8 alpha bits", make({.alpha_bits = -8}), {"alpha_bits is -8", "0 or 8"}},
      {"alpha of indices",
       make({.color_mode = ColorMode::index, .color_bits = 8, .alpha_bits = 8}),
       {"alpha planes", "index", "rgb"}},
      {"0 samples", make({.samples = 0}), {"samples is 0", "1, 4 or 8"}},
      {"2 samples", make({.samples = 2}), {"samples is 2", "1, 4 or 8"}},
      {"16 samples", make({.samples = 16}), {"samples is 16", "1, 4 or 8"}},
      {"samples of indices",
       make({.color_mode = ColorMode::index, .color_bits = 8, .samples = 4}),
       {"samples", "index", "no mean"}},
      {"24 accumulation bits", make({.accumulation_bits = 24}), {"accumulation_bits is 24", "0, 16 or 32"}},
      {"-16 accumulation bits",
       make({.accumulation_bits = -16}),
       {"accumulation_bits is -16", "0, 16 or 32"}},
      {"accumulation of indices",
       make({.color_mode = ColorMode::index, .color_bits = 8, .accumulation_bits = 16}),
       {"accumulation buffer", "index", "rgb"}},
  };
  expect_errors(misuses);
  // The first allocation of the planes reports the same error, whichever call makes it.
  const auto bytes = [](FrameBufferFormat format) {
    return [format] { (void)FrameBuffer::memory_bytes(format); };
  };
  expect_errors({
      {"5 alpha bits", bytes({.alpha_bits = 5}), {"alpha_bits is 5", "0 or 8"}},
      {"6 samples", bytes({.samples = 6}), {"samples is 6", "1, 4 or 8"}},
      {"8 accumulation bits", bytes({.accumulation_bits = 8}), {"accumulation_bits is 8", "0, 16 or 32"}},
  });
}

TEST(ErrorsOfFrameBuffers, NameTheFaultOfAPalette) {
  expect_errors({
      {"palette of an RGB buffer", make({.palette = {Color{}}}), {"palette", "rgb", "index"}},
      {"3 entries in 1 bit", make(index_format(1, {{}, {}, {}})), {"3 entries", "1 bit", "at most 2"}},
      {"above 1", make(index_format(2, {{}, {0, 1.5f, 0, 1}})), {"entry 1", "1.5", "0 to 1"}},
      {"below 0", make(index_format(2, {{0, 0, -0.5f, 1}})), {"entry 0", "-0.5", "0 to 1"}},
      {"not a number", make(index_format(2, {{}, {}, {kNanF, 0, 0, 1}})), {"entry 2", "nan", "0 to 1"}},
      {"alpha above 1", make(index_format(2, {{0, 0, 0, 2}})), {"entry 0", "2", "0 to 1"}},
      {"a name that there is not",
       [] { named_palette("vga", 8); },
       {"\"vga\"", "bw", "gray", "ega16", "vga256", "web216"}},
      {"no name", [] { named_palette("", 8); }, {"unknown"}},
      {"vga256 in 7 bits", [] { named_palette("vga256", 7); }, {"256 entries", "7 bits", "128"}},
      {"web216 in 7 bits", [] { named_palette("web216", 7); }, {"216 entries", "7 bits", "128"}},
      {"ega16 in 3 bits", [] { named_palette("ega16", 3); }, {"16 entries", "3 bits", "8"}},
      {"0 bits", [] { named_palette("gray", 0); }, {"color_bits is 0", "1 to 24"}},
      {"25 bits", [] { named_palette("gray", 25); }, {"color_bits is 25", "1 to 24"}},
      {"default of 0 bits", [] { default_palette(0); }, {"color_bits is 0", "1 to 24"}},
      {"default of 25 bits", [] { default_palette(25); }, {"color_bits is 25", "1 to 24"}},
  });
}

std::function<void()> start(RendererOptions options) {
  return [options] { Renderer{options}; };
}

TEST(ErrorsOfRenderers, NameOptionsOutOfRange) {
  expect_errors({
      {"-1 threads", start({.threads = -1}), {"threads is -1", "0", "1024"}},
      {"1025 threads", start({.threads = 1025}), {"threads is 1025", "1024"}},
      {"tiles of 33", start({.tile_size = 33}), {"tile_size is 33", "32, 64 or 128"}},
      {"tiles of -64", start({.tile_size = -64}), {"tile_size is -64", "32, 64 or 128"}},
      {"tiles of 256", start({.tile_size = 256}), {"tile_size is 256", "32, 64 or 128"}},
      {"no instruction set at all",
       start({.instruction_set = static_cast<InstructionSet>(77)}),
       {"instruction set", "scalar"}},
  });
}

TEST(ErrorsOfRenderers, NameAMissingInstructionSet) {
  const std::vector<InstructionSet> there = available_instruction_sets();
  ASSERT_EQ(there.back(), InstructionSet::scalar);
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512}) {
    const auto error = error_of(start({.threads = 1, .instruction_set = set}));
    const bool has = std::find(there.begin(), there.end(), set) != there.end();
    EXPECT_EQ(!error, has) << name(set);
    if (!has) {
      EXPECT_THAT(error.value_or(""), testing::AllOf(HasSubstr(std::string(name(set))),
                                                     HasSubstr(std::string(name(there.front())))));
    }
  }
}

TEST(ErrorsOfMatrices, NameEmptyAndNonFiniteVolumes) {
  expect_errors({
      {"axis 0", [] { rotate(10, 0, 0, 0); }, {"axis"}},
      {"axis nan", [] { rotate(10, kNan, 0, 1); }, {"axis"}},
      {"axis infinite", [] { rotate(10, 0, kInfinity, 1); }, {"axis"}},
      {"angle nan", [] { rotate(kNan, 0, 0, 1); }, {"angle"}},
      {"angle infinite", [] { rotate(kInfinity, 0, 0, 1); }, {"angle"}},
      {"eye in the target",
       [] {
         look_at({1, 2, 3}, {1, 2, 3}, {0, 1, 0});
       },
       {"eye", "target", "up"}},
      {"up along the view",
       [] {
         look_at({0, 5, 0}, {0, 0, 0}, {0, 1, 0});
       },
       {"eye", "target", "up"}},
      {"up 0",
       [] {
         look_at({0, 0, 5}, {0, 0, 0}, {0, 0, 0});
       },
       {"up"}},
      {"eye nan",
       [] {
         look_at({kNan, 0, 5}, {0, 0, 0}, {0, 1, 0});
       },
       {"eye"}},
      {"fovy 0", [] { perspective(0, 1, 1, 2); }, {"fovy", "0", "180"}},
      {"fovy 180", [] { perspective(180, 1, 1, 2); }, {"fovy", "180"}},
      {"fovy nan", [] { perspective(kNan, 1, 1, 2); }, {"fovy", "nan"}},
      {"aspect 0", [] { perspective(45, 0, 1, 2); }, {"aspect is 0"}},
      {"aspect infinite", [] { perspective(45, kInfinity, 1, 2); }, {"aspect", "inf"}},
      {"near 0", [] { perspective(45, 1, 0, 2); }, {"0"}},
      {"near -1", [] { perspective(45, 1, -1, 2); }, {"near", "-1", "above 0"}},
      {"far -1", [] { perspective(45, 1, 1, -1); }, {"far", "-1", "above 0"}},
      {"near = far", [] { perspective(45, 1, 2, 2); }, {"near is 2", "far is 2", "differ"}},
      {"near infinite", [] { perspective(45, 1, kInfinity, 2); }, {"inf"}},
      {"far nan", [] { perspective(45, 1, 1, kNan); }, {"far", "nan"}},
      {"far minus infinite", [] { frustum(-1, 1, -1, 1, 1, -kInfinity); }, {"far", "inf"}},
      {"left = right", [] { frustum(1, 1, -1, 1, 1, 2); }, {"left is 1", "right is 1", "differ"}},
      {"bottom = top", [] { frustum(-1, 1, 3, 3, 1, 2); }, {"bottom is 3", "top is 3", "differ"}},
      {"right infinite", [] { frustum(-1, kInfinity, -1, 1, 1, 2); }, {"right", "inf"}},
      {"orthographic far infinite", [] { orthographic(-1, 1, -1, 1, 0, kInfinity); }, {"far", "inf"}},
      {"orthographic near = far", [] { orthographic(-1, 1, -1, 1, 3, 3); }, {"near is 3", "differ"}},
      {"orthographic left = right", [] { orthographic(2, 2, -1, 1, 0, 1); }, {"left is 2", "differ"}},
      {"orthographic top nan", [] { orthographic(-1, 1, -1, kNan, 0, 1); }, {"top", "nan"}},
  });
}

TEST(NamedMaterials, UnknownNamesAreNotAnError) {
  EXPECT_FALSE(named_material("cheese"));
  EXPECT_FALSE(named_material(""));
  for (const std::string_view known : material_names()) EXPECT_TRUE(named_material(known)) << known;
  EXPECT_EQ(material_names().size(), 19u);
}

}  // namespace
}  // namespace tessera::api_error_formats_test
