// `tessera color`.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/engine/program/program.h"

namespace tessera::color_program_test {
namespace {

class ColorProgram : public Program {
 protected:
  /// Values that `tessera color` prints for one colour.
  std::string converted(const std::string& arguments) const {
    const Result result = run("color " + arguments);
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err, "") << arguments;
    return result.out;
  }
};

TEST_F(ColorProgram, ConvertsColors) {
  EXPECT_EQ(converted("0.5 1 1 --from rgb --to hsv"), "180 0.5 1\n");
  EXPECT_EQ(converted("180 0.5 1 --from hsv --to rgb"), "0.5 1 1\n");
  EXPECT_EQ(converted("'#00ff00' --to photoycc-8"), "107 91 57\n");
  EXPECT_EQ(converted("1 0 0 --to yiq-1953"), "0.3 0.599 0.213\n");
  EXPECT_EQ(converted("1 1 1 --to lab"), "100 0 0\n");
  EXPECT_EQ(converted("50 -0 -0.0 --from lab --to lab"), "50 0 0\n");
  EXPECT_EQ(converted("0.7 0.7 0.7 --to yuv"), "0.7 0 0\n");  // without the rounding error 6e-17
}

TEST_F(ColorProgram, TakesSeveralColors) {
  const std::string three = "54 123 232\n107 91 57\n21 255 122\n";
  EXPECT_EQ(converted("1 0 0 '#00ff00' 0,0,1 --to photoycc-8"), three);
  write("colors.txt", "1 0 0\n\n  #00ff00\r\n0, 0, 1");
  EXPECT_EQ(converted("--to photoycc-8 < colors.txt"), three);
  EXPECT_EQ(converted("--to hsv < /dev/null"), "");
}

TEST_F(ColorProgram, SpacesTakeCurves) {
  EXPECT_EQ(converted("0.5 0.5 0.5 --from rgb:curve=linear --to linear"), "0.5 0.5 0.5\n");
  EXPECT_EQ(converted("0.5 0.5 0.5 --from rgb:curve=2 --to linear"), "0.25 0.25 0.25\n");
  const std::string tube = converted("0.5 0.5 0.5 --from rgb:curve=bt1886,black=0.001 --to xyz");
  EXPECT_TRUE(contains(tube, " 0.216049")) << tube;  // 21.60491 of 100 cd/m^2
  // The first column of the matrix from SMPTE C to BT.709.
  const std::string red = converted("1 0 0 --from smpte-c:curve=linear --to linear");
  EXPECT_EQ(red.substr(0, 7), "0.93954") << red;
  EXPECT_NE(converted("0.2 0.2 0.2 --from rgb:curve=bt1886-1 --to linear"),
            converted("0.2 0.2 0.2 --from rgb:curve=bt1886 --to linear"));
}

TEST_F(ColorProgram, AdaptsWhitesOnRequest) {
  EXPECT_EQ(converted("1 1 1 --from trinitron-9300 --to rgb --adapt bradford"), "1 1 1\n");
  const std::string kept = converted("1 1 1 --from trinitron-9300 --to rgb");
  EXPECT_EQ(kept, converted("1 1 1 --from trinitron-9300 --to rgb --adapt none"));
  EXPECT_EQ(kept.substr(0, 3), "0.9") << kept;
}

TEST_F(ColorProgram, PrintsJsonWithAllDigits) {
  const auto json = nlohmann::json::parse(converted("0.2 0.4 0.7 '#ff0000' --to hsi --json"));
  EXPECT_EQ(json["from"], "rgb");
  EXPECT_EQ(json["to"], "hsi");
  ASSERT_EQ(json["colors"].size(), 2u);
  EXPECT_EQ(json["colors"][0]["from"][1], 0.4);
  EXPECT_NEAR(json["colors"][0]["to"][1].get<double>(), 1 - 0.2 / (1.3 / 3), 1e-15);
  EXPECT_EQ(json["colors"][1]["to"][1], 1.0);
}

TEST_F(ColorProgram, ListsSpaces) {
  const std::string text = converted("--list");
  for (const char* part : {"hsv             H 0..360 degrees, S 0..1, V 0..1", "curve power 2.8",
                           "SMPTE 170M", "photoycc-8      Y 0..255 code", "Ottosson 2020"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  const auto json = nlohmann::json::parse(converted("--list --json"));
  ASSERT_GE(json["spaces"].size(), 20u);
  for (const auto& space : json["spaces"]) {
    EXPECT_EQ(space["components"].size(), 3u);
    EXPECT_FALSE(space["source"].get<std::string>().empty());
    const std::string name = space["name"];
    EXPECT_EQ(run("color 0 0 0 --from rgb --to " + name).code, 0) << name;
    EXPECT_TRUE(contains(run("color --help").out, "\n  " + name + " ")) << name;
  }
  EXPECT_TRUE(contains(run("color --help").out, "  hsi             H 0..360 degrees, S 0..1, I 0..1\n"));
}

TEST_F(ColorProgram, RefusesWrongArguments) {
  const struct {
    const char* arguments;
    int code;
    const char* fragment;
  } kBad[] = {
      {"1 1 1 --to hvs", 2, "--to: found \"hvs\", expected one of rgb, linear,"},
      {"1 1 1 --to hvs", 2, "did you mean \"hsv\"?"},
      {"1 1 1 --from okalb --to rgb", 2, "did you mean \"oklab\"?"},
      {"1 1 1", 2, "--to: found no space, expected one of rgb,"},
      {"1 1 --to hsv", 2, "found 2 values, expected 3 values per colour (R' G' B')"},
      {"1 --to hsv --from lab", 2, "found 1 value, expected 3 values per colour (L* a* b*)"},
      {"1 1 1 1 --to hsv", 2, "found 4 values, expected 3 values per colour"},
      {"1 1 red --to hsv", 2, "found \"red\", expected a number from -1e6 to 1e6"},
      {"1 1 1x --to hsv", 2, "found \"1x\", expected a number"},
      {"1 1 nan --to hsv", 2, "found \"nan\", expected a number"},
      {"1 1 inf --to hsv", 2, "found \"inf\", expected a number"},
      {"1 1 -1000001 --to hsv", 2, "found \"-1000001\", expected a number"},
      {"'#12345' --to hsv", 2, "found \"#12345\", expected # and six hexadecimal digits"},
      {"'#12345g' --to hsv", 2, "expected # and six hexadecimal digits"},
      {"'#-12345' --to hsv", 2, "expected # and six hexadecimal digits"},
      {"1 '#123456' --to hsv", 2, "found \"#123456\" after 1 value of a colour"},
      {"'#123456' --from hsv --to rgb", 2, "#RRGGBB is for spaces of R'G'B'"},
      {"1 1 1 --to hsv:curve=srgb", 2, "hsv has no parameters"},
      {"1 1 1 --to rgb:gamma=2", 2, "found \"gamma=2\", expected curve=NAME or black=LIGHT"},
      {"1 1 1 --to rgb:curve=", 2, "found \"curve=\", expected curve=NAME"},
      {"1 1 1 --to rgb:curve=bt1887", 2, "did you mean \"bt1886\"?"},
      {"1 1 1 --to rgb:curve=11", 2, "or an exponent from 0.1 to 10"},
      {"1 1 1 --to rgb:black=0.1", 2, "the curve is sRGB, expected curve=bt1886"},
      {"1 1 1 --to rgb:curve=bt1886,black=1", 2, "black: found \"1\", expected a number from 0 to 0.99"},
      {"1 1 1 --to hsv --adapt cat02", 2, "expected one of none, bradford"},
      {"1 1 1 --to hsv --jsn", 2, "did you mean \"--json\"?"},
      {"--to hsv < bad.txt", 1, "standard input, line 2: found 2 values, expected 3"},
      {"--to hsv < two.txt", 1, "standard input, line 1: found 2 colours, expected one colour per line"},
  };
  write("bad.txt", "1 1 1\n1 1\n");
  write("two.txt", "1 1 1 0 0 0\n");
  for (const auto& row : kBad) {
    const Result result = run("color " + std::string(row.arguments));
    EXPECT_EQ(result.code, row.code) << row.arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, row.fragment)) << row.arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(result.out, "") << row.arguments;
  }
}

}  // namespace
}  // namespace tessera::color_program_test
#endif
