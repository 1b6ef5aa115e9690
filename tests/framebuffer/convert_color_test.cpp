// Conversions between any two spaces, and the table of named spaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <string>

#include "framebuffer/tessera/color.hpp"

namespace tessera::convert_color_test {
namespace {

ColorSpace space_of(std::string_view name) { return find_color_space(name).value().space; }
ColorValues convert(const ColorValues& values, std::string_view from, std::string_view to) {
  return convert_color(values, space_of(from), space_of(to));
}
void expect_near(const ColorValues& found, const ColorValues& expected, double tolerance,
                 const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance) << what << ", value " << i;
}

class RandomColors {
 public:
  ColorValues next() { return {unit(), unit(), unit()}; }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_{4};
};

bool is_rounded(const NamedColorSpace& named) { return named.space.model == ColorModel::photo_ycc_8bit; }

/// Largest difference of a component relative to its range; differences of hues by a whole turn are none.
double difference(const ColorValues& a, const ColorValues& b, const NamedColorSpace& named) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ColorComponent& component = named.components[i];
    double distance = std::abs(a[i] - b[i]);
    if (component.unit == "degrees") distance = std::min(distance, 360 - distance);
    largest = std::max(largest, distance / (component.max - component.min));
  }
  return largest;
}

TEST(ConvertColor, MillionColorsGoToEverySpaceAndBack) {
  const NamedColorSpace rgb = find_color_space("rgb").value();
  for (const NamedColorSpace& other : color_spaces()) {
    if (is_rounded(other)) continue;
    RandomColors colors;
    double largest = 0;
    for (int i = 0; i < 1000000; ++i) {
      const ColorValues color = colors.next();
      const ColorValues there = convert_color(color, rgb.space, other.space);
      largest = std::max(largest, difference(convert_color(there, other.space, rgb.space), color, rgb));
    }
    EXPECT_LT(largest, 1e-6) << other.name;
  }
}

// Colours of sRGB, in the first space of a pair: saturated enough that hues are defined.
TEST(ConvertColor, EveryPairOfSpacesGoesThereAndBack) {
  const int colors_per_pair = std::getenv("TESSERA_LONG") != nullptr ? 100000 : 2000;
  for (const NamedColorSpace& from : color_spaces())
    for (const NamedColorSpace& to : color_spaces()) {
      if (is_rounded(from) || is_rounded(to)) continue;
      RandomColors colors;
      double largest = 0;
      for (int i = 0; i < colors_per_pair; ++i) {
        const ColorValues rgb = colors.next();
        if (hsv_from_rgb(rgb)[1] * rgb[0] < 0.01) continue;
        const ColorValues color = convert_color(rgb, space_of("rgb"), from.space);
        const ColorValues there = convert_color(color, from.space, to.space);
        largest = std::max(largest, difference(convert_color(there, to.space, from.space), color, from));
      }
      EXPECT_LT(largest, 1e-6) << from.name << " to " << to.name;
    }
}

TEST(ConvertColor, CodesOfPhotoYccComeBack) {
  for (const ColorValues code : {ColorValues{182, 156, 137}, {107, 91, 57}, {100, 150, 140}, {3, 156, 137}})
    for (const NamedColorSpace& other : color_spaces())
      EXPECT_EQ(convert_color(convert_color(code, space_of("photoycc-8"), other.space), other.space,
                              space_of("photoycc-8")),
                code)
          << other.name;
}

TEST(ConvertColor, FollowsTheChainFromSignalToLightToXyz) {
  // sRGB 188 is linear .502886, of which BT.709 makes 1.099 L^.45 - .099.
  const double light = .502886458032569;
  const double camera = 1.099 * std::pow(light, .45) - .099;
  const ColorValues grey{188 / 255.0, 188 / 255.0, 188 / 255.0};
  expect_near(convert(grey, "rgb", "linear"), {light, light, light}, 1e-14, "light");
  expect_near(convert(grey, "rgb", "bt709"), {camera, camera, camera}, 1e-12, "BT.709");
  expect_near(convert(grey, "rgb", "photoycc"), {camera, 0, 0}, 1e-12, "PhotoYCC");
  const ColorValues code{std::floor(255 / 1.402 * camera + .5), 156, 137};
  EXPECT_EQ(convert(grey, "rgb", "photoycc-8"), code);
  expect_near(convert(grey, "rgb", "smpte-c"), {camera, camera, camera}, 1e-12, "SMPTE C");
  const double ebu = std::pow(light, 1 / 2.8), tube = std::pow(light, 1 / 2.4);
  expect_near(convert(grey, "rgb", "ebu"), {ebu, ebu, ebu}, 1e-12, "EBU");
  expect_near(convert(grey, "rgb", "trinitron"), {tube, tube, tube}, 1e-12, "tube");
  EXPECT_NEAR(convert(grey, "rgb", "xyz")[1], light, 1e-14);
  EXPECT_NEAR(convert(grey, "rgb", "lab")[0], 116 * std::cbrt(light) - 16, 1e-11);
  EXPECT_NEAR(convert({1, 0, 0}, "rgb", "xyz")[1], .212639, .5001e-6);
  EXPECT_NEAR(convert({1, 0, 0}, "ntsc-1953", "xyz")[1], .298967, .5001e-6);
  expect_near(convert({.5, 1, 1}, "rgb", "hsv"), {180, .5, 1}, 1e-13, "HSV");
  expect_near(convert({180, .5, 1}, "hsv", "yiq"), yiq_from_rgb({.5, 1, 1}), 1e-14, "HSV to YIQ");
}

TEST(ConvertColor, NamedDisplaysHaveTheirPrimariesAndWhites) {
  const struct {
    std::string_view name;
    double red_luminance;
    Chromaticity green, white;
  } kDisplays[] = {{"rgb", .212639, {.300, .600}, {.3127, .3290}},
                   {"linear", .212639, {.300, .600}, {.3127, .3290}},
                   {"bt709", .212639, {.300, .600}, {.3127, .3290}},
                   {"smpte-c", .212376, {.310, .595}, {.3127, .3290}},
                   {"ebu", .222004, {.290, .600}, {.3127, .3290}},
                   {"ntsc-1953", .298967, {.210, .710}, {.310, .316}},
                   {"trinitron", .250882, {.281, .606}, {.3127, .3290}},
                   {"hitachi", .245485, {.285, .604}, {.3127, .3290}},
                   {"trinitron-9300", 0, {.281, .606}, {.2831, .2971}},
                   {"hitachi-9300", 0, {.285, .604}, {.2831, .2971}}};
  const auto expect_chromaticity = [](const ColorValues& xyz, Chromaticity expected, std::string_view name) {
    EXPECT_NEAR(xyz[0] / (xyz[0] + xyz[1] + xyz[2]), expected.x, 1e-12) << name;
    EXPECT_NEAR(xyz[1] / (xyz[0] + xyz[1] + xyz[2]), expected.y, 1e-12) << name;
  };
  for (const auto& [name, red_luminance, green, white] : kDisplays) {
    if (red_luminance > 0) {
      EXPECT_NEAR(convert({1, 0, 0}, name, "xyz")[1], red_luminance, .5001e-6) << name;
    }
    expect_chromaticity(convert({0, 1, 0}, name, "xyz"), green, name);
    expect_chromaticity(convert({1, 1, 1}, name, "xyz"), white, name);
  }
}

TEST(ConvertColor, ModelsOfOneSignalKeepExactValues) {
  const ColorValues color{.25, .5, .75};
  EXPECT_EQ(convert(color, "rgb", "rgb"), color);
  EXPECT_EQ(convert({120, 1, 1}, "hsv", "rgb"), (ColorValues{0, 1, 0}));
  EXPECT_EQ(convert({1, 0, 0}, "rgb", "linear"), (ColorValues{1, 0, 0}));
}

TEST(ConvertColor, WhitesKeepTheirLightUnlessAdapted) {
  const ColorValues bluish = convert({1, 1, 1}, "trinitron-9300", "rgb");
  EXPECT_GT(bluish[2], 1.05);
  EXPECT_LT(bluish[0], bluish[1]);
  ColorSpace adapted = space_of("trinitron-9300");
  adapted.adaptation = ChromaticAdaptation::bradford;
  expect_near(convert_color({1, 1, 1}, adapted, space_of("rgb")), {1, 1, 1}, 1e-12, "to rgb");
  expect_near(convert_color({1, 1, 1}, space_of("rgb"), adapted), {1, 1, 1}, 1e-12, "from rgb");
  expect_near(convert({1, 1, 1}, "rgb", "lab-d50"), {100, 0, 0}, 1e-11, "Lab under D50");
  expect_near(convert({1, 1, 1}, "rgb", "lab"), {100, 0, 0}, 1e-11, "Lab");
}

// Lab under D50 of sRGB's primaries, as colour management systems give them.
TEST(ConvertColor, LabUnderD50AgreesWithColorManagement) {
  expect_near(convert({1, 0, 0}, "rgb", "lab-d50"), {54.29, 80.81, 69.89}, .02, "red");
  expect_near(convert({0, 1, 0}, "rgb", "lab-d50"), {87.82, -79.29, 80.99}, .02, "green");
  expect_near(convert({0, 0, 1}, "rgb", "lab-d50"), {29.57, 68.30, -112.03}, .02, "blue");
}

TEST(ColorSpaces, TableIsComplete) {
  std::set<std::string_view> names;
  std::set<ColorModel> models;
  for (const NamedColorSpace& named : color_spaces()) {
    EXPECT_TRUE(names.insert(named.name).second) << named.name;
    models.insert(named.space.model);
    EXPECT_FALSE(named.description.empty() || named.source.empty()) << named.name;
    for (const ColorComponent& component : named.components) {
      EXPECT_FALSE(component.name.empty()) << named.name;
      EXPECT_LT(component.min, component.max) << named.name;
    }
    EXPECT_EQ(find_color_space(named.name)->name, named.name);
  }
  EXPECT_EQ(models.size(), static_cast<std::size_t>(ColorModel::oklab) + 1);
  EXPECT_FALSE(find_color_space("cmyk"));
}

TEST(ColorSpaces, RangesHoldTheColorsOfSrgb) {
  for (const NamedColorSpace& named : color_spaces()) {
    const bool is_other_gamut =
        named.space.model == ColorModel::rgb && !(named.space.primaries == kBt709Primaries);
    if (is_other_gamut) continue;
    RandomColors colors;
    for (int i = 0; i < 1000; ++i) {
      ColorValues rgb = colors.next();
      if (i < 8) rgb = {i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0};
      const ColorValues values = convert_color(rgb, space_of("rgb"), named.space);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& [name, unit, min, max] = named.components[c];
        EXPECT_TRUE(values[c] > min - 1e-4 && values[c] < max + 1e-4)
            << named.name << " " << name << values[c];
      }
    }
  }
}

}  // namespace
}  // namespace tessera::convert_color_test
