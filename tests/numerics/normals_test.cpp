// Normalization at vertices and at pixels against long double: the largest error in units in the last place
// (ulp) of the exact value. All floats are split into quarters, so that long runs are parallel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "raster/eye_transform.h"
#include "raster/vertex_transform.h"
#include "shading/lighting.h"
#include "tests/numerics/bounds.h"
#include "tests/numerics/every_float.h"

namespace tessera::test::normals_test {
using namespace detail;
namespace {

constexpr float kLargest = 3.4028234e38f;

/// Two more components for each first one: of about its size, or much smaller, at most `largest`.
struct Vectors {
  std::vector<float> xyz;
  Vectors(const std::vector<float>& first, double largest, std::mt19937_64& random) {
    xyz.reserve(3 * first.size());
    for (const float x : first) {
      xyz.push_back(x);
      for (int k = 0; k < 2; ++k) {
        const std::uint64_t bits = random();
        const std::uint64_t octaves_down = (bits & 0xffff) % 40;
        const double size = std::bit_cast<double>((1024 - octaves_down) << 52);
        const double other = x * size * (1 + static_cast<double>(bits >> 32) * 0x1p-32);
        xyz.push_back(static_cast<float>((bits >> 16) % 16 == 0 ? 0 : std::min(other, largest)));
      }
    }
  }
  std::array<long double, 3> unit(std::size_t i) const {
    const long double x = xyz[3 * i];
    const long double y = xyz[3 * i + 1];
    const long double z = xyz[3 * i + 2];
    const long double inverse = 1 / std::sqrt(x * x + y * y + z * z);
    return {x * inverse, y * inverse, z * inverse};
  }
};

/// One quarter of the floats from `first` to `last`.
static_assert(kFloatBatch % kVertexBatch == 0);
class Normalization : public testing::TestWithParam<unsigned> {
 protected:
  /// @param found normalizes a batch of vectors (x y z each) and stores the results in three arrays
  template <class Found>
  long double worst(float first, float last, const Found& found) {
    const std::uint64_t quarter = GetParam();
    const std::uint64_t all = bits_of(last) - bits_of(first) + 1;
    const auto border = [&](std::uint64_t n) {
      return static_cast<std::uint32_t>(bits_of(first) + n * all / 4);
    };
    std::mt19937_64 random(6 + quarter);
    long double most = 0;
    for_floats(border(quarter), border(quarter + 1) - 1, [&](const std::vector<float>& floats) {
      const Vectors vectors(floats, last, random);
      for (std::size_t at = 0; at < floats.size(); at += kFloatBatch) {
        float unit[3][kFloatBatch];
        found(vectors.xyz.data() + 3 * at, unit);
        for (std::size_t i = 0; i < kFloatBatch; ++i) {
          const std::array<long double, 3> exact = vectors.unit(at + i);
          for (std::size_t k = 0; k < 3; ++k)
            if (exact[k] != 0) update_worst(most, ulps(unit[k][i], exact[k]));
        }
      }
    });
    return most;
  }
  std::string row(const std::string& what) const {
    return what + ", quarter " + std::to_string(GetParam() + 1) + " of 4";
  }
};

// Computed in double, so that the square of every float is finite: 3.5 roundings of 2^-53 before the rounding
// to float.
TEST_P(Normalization, AtVertices) {
  EyeTransform transform;
  for (int k = 0; k < 3; ++k) transform.normal_matrix[4 * k] = 1;
  const auto found = [&](const float* xyz, float(&unit)[3][kFloatBatch]) {
    for (std::size_t at = 0; at < kFloatBatch; at += kVertexBatch)
      eye_normals(available_isas().front())(transform, {xyz + 3 * at, 3}, kVertexBatch, unit[0] + at,
                                            unit[1] + at, unit[2] + at);
  };
  expect_within(row("normalize at vertices, every float"), worst(0x1p-149f, kLargest, found), 0.50001L,
                "ulp");
}

/// A program with lights along x, y and z, whose diffuse parts show the normal in red, green and blue.
LightingProgram normals_as_colors() {
  std::vector<EyeLight> lights(3);
  for (std::size_t k = 0; k < 3; ++k) {
    lights[k].position = lights[k].diffuse = lights[k].specular = {0, 0, 0};
    lights[k].position[k] = lights[k].diffuse[k] = 1;
  }
  LightingProgram program = plan_lighting({.ambient = {0, 0, 0}, .diffuse = {1, 1, 1}}, {}, lights,
                                          {.scene_ambient = {0, 0, 0}}, nullptr);
  program.renormalize = true;
  return program;
}

// Computed in float: 3 roundings of the squared length, half of which remain; one each of the root, its
// reciprocal and the product.
TEST_P(Normalization, AtPixels) {
  const LightingProgram program = normals_as_colors();
  const auto found = [&](const float* xyz, float(&unit)[3][kFloatBatch]) {
    ShadingBatch batch{};
    for (std::size_t i = 0; i < kFloatBatch; ++i)
      for (std::size_t k = 0; k < 3; ++k) batch.field[kNormalX + k][i] = xyz[3 * i + k];
    light_points(available_isas().front())(program, batch, kBatchPoints);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(batch.field[kColorR + k], kFloatBatch, unit[k]);
  };
  expect_within(row("normalize at pixels, lengths of 2^-60 to 2^60"), worst(0x1p-60f, 0x1p60f, found), 4.5,
                "ulp");
}

INSTANTIATE_TEST_SUITE_P(Quarters, Normalization, testing::Range(0u, 4u));

}  // namespace
}  // namespace tessera::test::normals_test
