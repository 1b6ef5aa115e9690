// Hue models, luma and colour differences: published values, coefficients and ranges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framebuffer/tessera/color.hpp"

namespace tessera::color_models_test {
namespace {

constexpr double kHalfDigit4 = 0.5001e-4;  // half of the last of four digits

void expect_near(const ColorValues& found, const ColorValues& expected, double tolerance,
                 const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance) << what << ", value " << i;
}

/// The eight colours with components 0 and 1.
std::vector<ColorValues> full_colors() {
  std::vector<ColorValues> colors;
  for (const double r : {0.0, 1.0})
    for (const double g : {0.0, 1.0})
      for (const double b : {0.0, 1.0}) colors.push_back({r, g, b});
  return colors;
}

/// Coefficients of a linear model: row i has those of value i.
ColorMatrix coefficients(ColorValues (*function)(const ColorValues&)) {
  ColorMatrix matrix;
  for (std::size_t column = 0; column < 3; ++column) {
    ColorValues unit{};
    unit[column] = 1;
    const ColorValues values = function(unit);
    for (std::size_t row = 0; row < 3; ++row) matrix.rows[row][column] = values[row];
  }
  return matrix;
}
void expect_rows(const ColorMatrix& found, const ColorMatrix& expected, double tolerance) {
  for (std::size_t row = 0; row < 3; ++row)
    expect_near(found.rows[row], expected.rows[row], tolerance, "row " + std::to_string(row));
}

struct HueRow {
  ColorValues rgb;
  double hue, circular_hue, chroma, value, lightness, intensity, s_hsv, s_hsl, s_hsi;
};
// Computed from the definitions in exact arithmetic, rounded to four digits.
const HueRow kHueTable[] = {
    {{1, 0, 0}, 0, 0, 1, 1, .5, .3333, 1, 1, 1},
    {{.75, .75, 0}, 60, 60, .75, .75, .375, .5, 1, 1, 1},
    {{0, .5, 0}, 120, 120, .5, .5, .25, .1667, 1, 1, 1},
    {{.5, 1, 1}, 180, 180, .5, 1, .75, .8333, .5, 1, .4},
    {{.5, .5, 1}, 240, 240, .5, 1, .75, .6667, .5, 1, .25},
    {{.75, .25, .75}, 300, 300, .5, .75, .5, .5833, .6667, .5, .5714},
    {{.628, .643, .142}, 61.7964, 61.5078, .501, .643, .3925, .4710, .7792, .6382, .6985},
    {{.255, .104, .918}, 251.1302, 250.0416, .814, .918, .511, .4257, .8867, .8323, .7557},
    {{.116, .675, .255}, 134.9195, 133.8160, .559, .675, .3955, .3487, .8281, .7067, .6673},
    {{.941, .785, .053}, 49.4595, 50.5308, .888, .941, .497, .5930, .9437, .8934, .9106},
    {{.704, .187, .897}, 283.6901, 284.7601, .71, .897, .542, .5960, .7915, .7751, .6862},
    {{.931, .463, .316}, 14.3415, 13.2299, .615, .931, .6235, .5700, .6606, .8167, .4456},
    {{.998, .974, .532}, 56.9099, 57.3788, .466, .998, .765, .8347, .4669, .9915, .3626},
    {{.099, .795, .591}, 162.4138, 163.4363, .696, .795, .447, .4950, .8755, .7785, .8000},
    {{.211, .149, .597}, 248.3036, 247.3371, .448, .597, .373, .3190, .7504, .6005, .5329},
    {{.495, .493, .721}, 240.5263, 240.4372, .228, .721, .607, .5697, .3162, .2901, .1346},
};

TEST(HueModels, AgreeWithTheTableToItsLastDigit) {
  for (const HueRow& row : kHueTable) {
    const std::string what =
        std::to_string(row.rgb[0]) + " " + std::to_string(row.rgb[1]) + " " + std::to_string(row.rgb[2]);
    expect_near(hsv_from_rgb(row.rgb), {row.hue, row.s_hsv, row.value}, kHalfDigit4, "HSV of " + what);
    expect_near(hsl_from_rgb(row.rgb), {row.hue, row.s_hsl, row.lightness}, kHalfDigit4, "HSL of " + what);
    expect_near(hsi_from_rgb(row.rgb), {row.circular_hue, row.s_hsi, row.intensity}, kHalfDigit4,
                "HSI of " + what);
    expect_near(hvc_from_rgb(row.rgb), {row.hue, row.value, row.chroma}, kHalfDigit4, "HVC of " + what);
    expect_near(rgb_from_hsv(hsv_from_rgb(row.rgb)), row.rgb, 1e-14, "from HSV: " + what);
    expect_near(rgb_from_hsl(hsl_from_rgb(row.rgb)), row.rgb, 1e-14, "from HSL: " + what);
    expect_near(rgb_from_hsi(hsi_from_rgb(row.rgb)), row.rgb, 1e-14, "from HSI: " + what);
    expect_near(rgb_from_hvc(hvc_from_rgb(row.rgb)), row.rgb, 1e-14, "from HVC: " + what);
  }
}

TEST(HueModels, GreysHaveHueAndSaturationZero) {
  for (const double grey : {0.0, 0.25, 1.0}) {
    const ColorValues rgb{grey, grey, grey}, expected{0, 0, grey};
    EXPECT_EQ(hsv_from_rgb(rgb), expected);
    EXPECT_EQ(hsl_from_rgb(rgb), expected);
    EXPECT_EQ(hsi_from_rgb(rgb), expected);
    EXPECT_EQ(hvc_from_rgb(rgb), (ColorValues{0, grey, 0}));
  }
}

TEST(HueModels, HuesWrapAround) {
  for (const double turn : {-720.0, -360.0, 360.0, 3600.0}) {
    expect_near(rgb_from_hsv({turn + 200, .5, .75}), rgb_from_hsv({200, .5, .75}), 1e-12, "HSV");
    expect_near(rgb_from_hsi({turn + 200, .5, .75}), rgb_from_hsi({200, .5, .75}), 1e-12, "HSI");
  }
  const double just_below_red = hsv_from_rgb({1, 0, 1e-18})[0];
  EXPECT_TRUE(just_below_red >= 0 && just_below_red < 360) << just_below_red;
}

TEST(Yuv, HasTheCoefficientsAndTheRangesOfSmpte170M) {
  const ColorMatrix forward = coefficients(yuv_from_rgb);
  expect_near(forward.rows[0], {.299, .587, .114}, 1e-15, "luma");
  for (const ColorValues& rgb : full_colors()) {
    const ColorValues yuv = yuv_from_rgb(rgb);
    EXPECT_NEAR(yuv[1], .492111 * (rgb[2] - yuv[0]), 1e-15);
    EXPECT_NEAR(yuv[2], .877283 * (rgb[0] - yuv[0]), 1e-15);
  }
  EXPECT_NEAR(yuv_from_rgb({0, 0, 1})[1], .43601, .5001e-5);
  EXPECT_NEAR(yuv_from_rgb({1, 0, 0})[2], .61498, .5001e-5);
  expect_rows(coefficients(rgb_from_yuv), {{{{1, 0, 1.139883}, {1, -.394642, -.580622}, {1, 2.032062, 0}}}},
              .5001e-6);
}

TEST(Yiq, HasTheCoefficientsAndTheRangesOfSmpte170M) {
  expect_rows(coefficients(yiq_from_rgb),
              {{{{.299, .587, .114}, {.595901, -.274557, -.321344}, {.211537, -.522736, .311200}}}},
              .5001e-6);
  expect_rows(coefficients(rgb_from_yiq),
              {{{{1, .955986, .620825}, {1, -.272013, -.647204}, {1, -1.106740, 1.704230}}}}, .5001e-6);
  double max_i = 0, max_q = 0;
  for (const ColorValues& rgb : full_colors()) {
    max_i = std::max(max_i, std::abs(yiq_from_rgb(rgb)[1]));
    max_q = std::max(max_q, std::abs(yiq_from_rgb(rgb)[2]));
  }
  EXPECT_NEAR(max_i, .59590, .5001e-5);
  EXPECT_NEAR(max_q, .52274, .5001e-5);
}

TEST(Yiq, HasTheCoefficientsOfTheFcc) {
  expect_rows(coefficients(yiq_1953_from_rgb),
              {{{{.30, .59, .11}, {.599, -.2773, -.3217}, {.213, -.5251, .3121}}}}, 1e-15);
}

TEST(PhotoYcc, HasTheCodesOfFullPrimaries) {
  const struct {
    ColorValues rgb, code;
  } kBars[] = {{{1, 1, 1}, {182, 156, 137}}, {{1, 1, 0}, {161, 57, 152}}, {{0, 1, 1}, {128, 189, 42}},
               {{0, 1, 0}, {107, 91, 57}},   {{1, 0, 1}, {75, 221, 217}}, {{1, 0, 0}, {54, 123, 232}},
               {{0, 0, 1}, {21, 255, 122}},  {{0, 0, 0}, {0, 156, 137}}};
  for (const auto& [rgb, code] : kBars) {
    EXPECT_EQ(photo_ycc_8bit_from_photo_ycc(photo_ycc_from_rgb(rgb)), code);
    // Half a code is 0.0069 of the largest coefficient's range: B' = Y + C1.
    expect_near(rgb_from_photo_ycc(photo_ycc_from_photo_ycc_8bit(code)), rgb, 0.0075, "bar");
  }
}

TEST(PhotoYcc, CodesConvertBackAndAreClamped) {
  for (int code = 0; code <= 255; ++code) {
    const ColorValues codes(
        {static_cast<double>(code), static_cast<double>((code + 85) % 256), static_cast<double>(255 - code)});
    EXPECT_EQ(photo_ycc_8bit_from_photo_ycc(photo_ycc_from_photo_ycc_8bit(codes)), codes);
  }
  EXPECT_EQ(photo_ycc_8bit_from_photo_ycc({2, 2, -2}), (ColorValues{255, 255, 0}));
  EXPECT_EQ(photo_ycc_8bit_from_photo_ycc({-1, -2, 2}), (ColorValues{0, 0, 255}));
}

TEST(PhotoYcc, InverseHasItsCoefficients) {
  expect_rows(coefficients(rgb_from_photo_ycc), {{{{1, 0, 1}, {1, -.19421, -.50937}, {1, 1, 0}}}}, .5001e-5);
}

TEST(PhotoYcc, KodaksDisplayConstantsAre969ThousandthsOfTheInverse) {
  for (int i = 0; i < 1000; ++i) {
    const ColorValues code{20.0 + i % 160, 60.0 + i % 150, 60.0 + i % 140};
    const ColorValues display = photo_cd_display_levels(code);
    const ColorValues true_inverse = rgb_from_photo_ycc(photo_ycc_from_photo_ycc_8bit(code));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(display[c], .969 * 255 * true_inverse[c], .0002 * (255 + std::abs(display[c])));
  }
  const ColorValues white = photo_cd_display_levels({182, 156, 137});
  expect_near(white, {247, 247, 247}, .5, "white");
  EXPECT_NEAR(photo_cd_display_levels({255, 156, 137})[1], 346, .5);
}

}  // namespace
}  // namespace tessera::color_models_test
