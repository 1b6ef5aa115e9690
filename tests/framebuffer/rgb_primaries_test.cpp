// Matrices of primaries: published values, and the whites and chromaticities they were derived from.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framebuffer/tessera/color.hpp"

namespace tessera::rgb_primaries_test {
namespace {

void expect_near(const ColorValues& found, const ColorValues& expected, double tolerance,
                 const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance) << what << ", value " << i;
}
void expect_rows(const ColorMatrix& found, const ColorMatrix& expected, double tolerance) {
  for (std::size_t row = 0; row < 3; ++row)
    expect_near(found.rows[row], expected.rows[row], tolerance, "row " + std::to_string(row));
}
Chromaticity chromaticity_of(const ColorValues& xyz) {
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}
void expect_chromaticity(const ColorValues& xyz, Chromaticity expected) {
  EXPECT_NEAR(chromaticity_of(xyz).x, expected.x, 1e-14);
  EXPECT_NEAR(chromaticity_of(xyz).y, expected.y, 1e-14);
}

const RgbPrimaries kAll[] = {kBt709Primaries,    kSmpteCPrimaries,    kEbuPrimaries,
                             kNtsc1953Primaries, kTrinitronPrimaries, kHitachiPrimaries};

TEST(RgbPrimaries, LuminancesAreThePublishedOnes) {
  const ColorValues kLuminances[] = {{.212639, .715169, .072192}, {.212376, .701060, .086564},
                                     {.222004, .706655, .071341}, {.298967, .586421, .114612},
                                     {.250882, .668859, .080259}, {.245485, .676856, .077658}};
  for (std::size_t i = 0; i < std::size(kAll); ++i)
    expect_near(xyz_from_rgb_light(kAll[i]).rows[1], kLuminances[i], .5001e-6, std::to_string(i));
}

TEST(RgbPrimaries, MatricesReproduceTheirChromaticities) {
  for (const RgbPrimaries& primaries : kAll) {
    const ColorMatrix xyz_from_rgb = xyz_from_rgb_light(primaries);
    expect_chromaticity(xyz_from_rgb * ColorValues{1, 0, 0}, primaries.red);
    expect_chromaticity(xyz_from_rgb * ColorValues{0, 1, 0}, primaries.green);
    expect_chromaticity(xyz_from_rgb * ColorValues{0, 0, 1}, primaries.blue);
    expect_chromaticity(xyz_from_rgb * ColorValues{1, 1, 1}, primaries.white);
    EXPECT_NEAR((xyz_from_rgb * ColorValues{1, 1, 1})[1], 1, 1e-15);
    expect_rows(inverse(xyz_from_rgb) * xyz_from_rgb, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, 1e-14);
  }
}

TEST(RgbPrimaries, TelevisionConvertsToBt709ByThePublishedMatrices) {
  const ColorMatrix rgb_from_xyz = inverse(xyz_from_rgb_light(kBt709Primaries));
  expect_rows(rgb_from_xyz * xyz_from_rgb_light(kSmpteCPrimaries),
              {{{{.93954, .05018, .01028}, {.01777, .96579, .01643}, {-.00162, -.00437, 1.00599}}}},
              .5001e-5);
  expect_rows(rgb_from_xyz * xyz_from_rgb_light(kEbuPrimaries),
              {{{{1.04404, -.04404, 0}, {0, 1, 0}, {0, .01179, .98821}}}}, .5001e-5);
}

// XYZ of sRGB in ICC profiles, under D50: IEC 61966-2-1, annex, and the profiles of HP and Adobe.
TEST(Adaptation, BradfordGivesTheColorantsOfSrgbProfiles) {
  const ColorMatrix adapted = adaptation_matrix(kWhiteD65, kWhiteD50, ChromaticAdaptation::bradford) *
                              xyz_from_rgb_light(kBt709Primaries);
  expect_rows(adapted, {{{{.4361, .3851, .1431}, {.2225, .7169, .0606}, {.0139, .0971, .7142}}}}, 2e-4);
}

TEST(Adaptation, MovesTheWhiteAndInvertsItself) {
  const auto bradford = ChromaticAdaptation::bradford;
  const ColorMatrix forth = adaptation_matrix(kWhite9300K, kWhiteD65, bradford);
  expect_near(forth * xyz_of(kWhite9300K), xyz_of(kWhiteD65), 1e-14, "white");
  const ColorMatrix identity{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  expect_rows(adaptation_matrix(kWhiteD65, kWhite9300K, bradford) * forth, identity, 1e-14);
  expect_rows(adaptation_matrix(kWhiteD65, kWhite9300K, ChromaticAdaptation::none), identity, 0);
}

}  // namespace
}  // namespace tessera::rgb_primaries_test
