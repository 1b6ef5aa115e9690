// `tessera compare`: text, JSON, error map, errors.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/program/compare/flip.h"
#include "engine/program/compare/picture_errors.h"
#include "engine/program/imageio/picture.h"
#include "tests/engine/program/compare/known_flip_pairs.h"
#include "tests/engine/program/program.h"

namespace tessera::compare_command_test {
namespace {

using program::known_flip_pairs;
using program::KnownFlipPair;

class CompareCommand : public Program {
 protected:
  void write_ppm(const std::string& name, const program::RgbPicture& picture) const {
    write(name, "P6 " + std::to_string(picture.width) + " " + std::to_string(picture.height) + " 255\n" +
                    std::string(picture.rgb.begin(), picture.rgb.end()));
  }
  void write_pair(const KnownFlipPair& pair) const {
    write_ppm("a.ppm", pair.reference);
    write_ppm("b.ppm", pair.test);
  }
};

TEST_F(CompareCommand, PrintsTextAndSucceedsWhetherOrNotPicturesDiffer) {
  write_pair(known_flip_pairs()[3]);  // grey 128 and grey 140
  const Result different = run("compare a.ppm b.ppm");
  EXPECT_EQ(different.code, 0) << different.err;
  EXPECT_EQ(different.err, "");
  EXPECT_EQ(different.out.substr(0, different.out.find("FLIP")),
            "size                    64x64\n"
            "largest error           12 of 255 levels\n"
            "RMS error               12.000000 levels\n"
            "PSNR                    26.5472 dB\n"
            "more than 1 level off   4096 of 4096 (100.0000 %)\n"
            "more than 2 levels off  4096 of 4096 (100.0000 %)\n");
  EXPECT_TRUE(contains(different.out, "FLIP, mean              0.1691")) << different.out;
  EXPECT_TRUE(contains(different.out, " at 67.02 pixels per degree\n")) << different.out;
  const Result equal = run("compare a.ppm a.ppm");
  EXPECT_EQ(equal.code, 0) << equal.err;
  EXPECT_TRUE(contains(equal.out, "PSNR                    inf\n")) << equal.out;
  EXPECT_TRUE(contains(equal.out, "FLIP, largest           0.000000\n")) << equal.out;
}

TEST_F(CompareCommand, PrintsJson) {
  const program::RgbPicture reference(64, 64, [](int x, int y) { return program::Rgb{4 * x, 4 * y, 128}; });
  const program::RgbPicture test(64, 64, [](int x, int y) {
    return program::Rgb{4 * x + x % 4, 4 * y, 128};
  });
  write_ppm("a.ppm", reference);
  write_ppm("b.ppm", test);
  const Result result = run("compare a.ppm b.ppm --ppd 20 --json");
  EXPECT_EQ(result.code, 0) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  const program::PictureErrors levels = program::picture_errors(test.view(), reference.view());
  const program::FlipErrors flip =
      program::flip_errors(test.view(), reference.view(), {.pixels_per_degree = 20});
  EXPECT_EQ(json["width"], 64);
  EXPECT_EQ(json["height"], 64);
  EXPECT_EQ(json["largest"], levels.largest);
  EXPECT_EQ(json["rms"], levels.rms);
  EXPECT_EQ(json["psnr_db"], levels.psnr_db);
  EXPECT_EQ(json["pixels_over_1"], 2048);
  EXPECT_EQ(json["pixels_over_2"], 1024);
  EXPECT_EQ(json["share_over_1"], 0.5);
  EXPECT_EQ(json["share_over_2"], 0.25);
  EXPECT_TRUE(json["largest_alpha"].is_null());
  EXPECT_EQ(json["flip"]["pixels_per_degree"], 20);
  EXPECT_EQ(json["flip"]["mean"], flip.mean);
  EXPECT_EQ(json["flip"]["percentile_99"], flip.percentile_99);
  EXPECT_EQ(json["flip"]["largest"], flip.largest);
  const nlohmann::json equal = nlohmann::json::parse(run("compare a.ppm a.ppm --json").out);
  EXPECT_TRUE(equal["psnr_db"].is_null());
  EXPECT_EQ(equal["flip"]["mean"], 0);
}

TEST_F(CompareCommand, PrintsTheSameBytesForAnyNumberOfThreads) {
  write_pair(known_flip_pairs()[9]);
  const std::string one = run("compare a.ppm b.ppm --json --threads 1").out;
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(run("compare a.ppm b.ppm --json --threads 3").out, one);
}

TEST_F(CompareCommand, WritesErrorMap) {
  const KnownFlipPair pair = known_flip_pairs()[11];  // a white pixel on 65x65
  write_pair(pair);
  const Result result = run("compare a.ppm b.ppm --map map.png");
  EXPECT_EQ(result.code, 0) << result.err;
  const program::Picture map = program::read_picture((folder_ / "map.png").string());
  EXPECT_EQ(map.width, 65);
  EXPECT_EQ(map.height, 65);
  const auto color_at = [&map](int x, int y) {
    const std::uint8_t* const rgba = &map.rgba[4 * static_cast<std::size_t>(65 * y + x)];
    return rgba[0] << 16 | rgba[1] << 8 | rgba[2];
  };
  EXPECT_EQ(color_at(0, 0), 0x000004);    // error 0
  EXPECT_EQ(color_at(32, 32), 0xfebf84);  // error 0.8649, entry 221
}

// 1x1 RGBA as a TIFF file; decoded by OpenImageIO.
TEST_F(CompareCommand, ComparesAlphaIfAFileHasAny) {
  std::string tiff("II*\0\x0c\0\0\0", 8);
  tiff += std::string("\x10\x20\x30\x40", 4);
  const auto add_16 = [&tiff](int value) {
    tiff += {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)};
  };
  const auto add_entry = [&](int tag, int type, int count, int value) {
    for (const int word : {tag, type, count, 0, value, 0}) add_16(word);
  };
  constexpr int kShort = 3, kLong = 4;
  constexpr int kBitsOffset = 12 + 2 + 10 * 12 + 4;
  add_16(10);
  add_entry(256, kShort, 1, 1);            // width
  add_entry(257, kShort, 1, 1);            // height
  add_entry(258, kShort, 4, kBitsOffset);  // bits per sample
  add_entry(259, kShort, 1, 1);            // no compression
  add_entry(262, kShort, 1, 2);            // RGB
  add_entry(273, kLong, 1, 8);             // offset of the pixels
  add_entry(277, kShort, 1, 4);            // samples per pixel
  add_entry(278, kShort, 1, 1);            // rows per strip
  add_entry(279, kLong, 1, 4);             // bytes of the strip
  add_entry(338, kShort, 1, 2);            // alpha, not premultiplied
  for (const int word : {0, 0, 8, 8, 8, 8}) add_16(word);
  write("alpha.tif", tiff);
  write("opaque.ppm", "P6 1 1 255\n\x10\x20\x30");
  const Result result = run("compare alpha.tif opaque.ppm");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "largest error           0 of 255 levels\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "largest error of alpha  191 of 255 levels\n")) << result.out;
  EXPECT_EQ(nlohmann::json::parse(run("compare alpha.tif opaque.ppm --json").out)["largest_alpha"], 191);
}

TEST_F(CompareCommand, ReportsFailuresInOneLineAndExitsWith1) {
  write_pair(known_flip_pairs()[0]);
  write("small.ppm", "P6 1 1 255 abc");
  write("deep.ppm", "P6 1 1 65535 abcdef");
  const struct {
    const char* arguments;
    const char* message;
  } kFailing[] = {
      {"a.ppm small.ppm", "\"a.ppm\" is 64x64, \"small.ppm\" is 1x1; both must have the same size"},
      {"a.ppm missing.ppm", "cannot read \"missing.ppm\": No such file or directory"},
      {"deep.ppm small.ppm", "cannot read \"deep.ppm\": the header must hold width, height and 255"},
      {"a.ppm b.ppm --map b.ppm",
       "the picture \"b.ppm\" would overwrite the input \"b.ppm\"; name another file with --map"},
      {"a.ppm b.ppm --map map", "cannot write \"map\": the name has no extension"},
      {"a.ppm b.ppm --map no/map.ppm", "there is no folder \"no\""},
  };
  for (const auto& [arguments, message] : kFailing) {
    const Result result = run("compare " + std::string(arguments));
    EXPECT_EQ(result.code, 1) << arguments;
    EXPECT_TRUE(contains(result.err, message)) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(CompareCommand, ReportsWrongUsageInOneLineAndExitsWith2) {
  write_pair(known_flip_pairs()[0]);
  const struct {
    const char* arguments;
    const char* message;
  } kBad[] = {
      {"a.ppm b.ppm --ppd 0.5", "--ppd: found \"0.5\", expected a number from 1 to 1000"},
      {"a.ppm b.ppm --ppd nan", "found \"nan\", expected a number from 1 to 1000"},
      {"a.ppm b.ppm --ppd 20px", "found \"20px\", expected a number from 1 to 1000"},
      {"a.ppm b.ppm --threads 0", "expected an integer from 1 to 1024"},
      {"a.ppm ''", "found \"\", expected a picture's name"},
      {"a.ppm b.ppm --mpa x.png", "did you mean \"--map\"?"},
      {"a.ppm", "B is required"},
      {"", "A is required"},
      {"a.ppm b.ppm a.ppm", "unexpected argument \"a.ppm\""},
  };
  for (const auto& [arguments, message] : kBad) {
    const Result result = run("compare " + std::string(arguments));
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, message)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

}  // namespace
}  // namespace tessera::compare_command_test
#endif
