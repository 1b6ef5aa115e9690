// Eye-space positions and normals: the kernels of all instruction sets bit for bit, and against doubles.
#include "raster/eye_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/raster/tile_harness.h"

namespace tessera::test::eye_transform_test {
using namespace detail;
namespace {

TEST(EyeTransform, LimitsNormalLengthsAndDividesByWOnEveryInstructionSet) {
  std::mt19937_64 generator(3);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  for (int round = 0; round < 500; ++round) {
    EyeTransform t;
    for (double& m : t.eye_from_object) m = random(-3, 3);
    const bool keeps_w = round % 4 < 2;
    for (std::size_t k = 0; k < 4 && keeps_w; ++k) t.eye_from_object[12 + k] = k == 3;
    for (double& m : t.normal_matrix) m = random(-3, 3);
    t.normal_lengths = std::array{kUnitNormals, kUnscaledNormals,
                                  NormalLengths{0.5, 2}}[static_cast<std::size_t>(round % 3)];
    std::vector<float> in(4 * kVertexBatch);
    for (float& p : in) p = static_cast<float>(random(-2, 2));
    if (round % 5 == 0) in[0] = in[1] = in[2] = 0;
    using Out = std::array<std::array<float, kVertexBatch>, 3>;
    const std::vector<InstructionSet> isas = available_isas();  // the last one is scalar
    std::vector<Out> normals(isas.size()), points(isas.size());
    const auto count = static_cast<std::size_t>(1 + round % kVertexBatch);
    const auto components = static_cast<std::size_t>(3 + round / kVertexBatch % 2);
    for (std::size_t set = 0; set < isas.size(); ++set) {
      const InstructionSet isa = isas[set];
      Out &n = normals[set], &p = points[set];
      eye_normals(isa)(t, {in.data(), 3}, count, n[0].data(), n[1].data(), n[2].data());
      eye_positions(isa)(t, {in.data(), components}, static_cast<int>(components), count, p[0].data(),
                         p[1].data(), p[2].data());
      for (std::size_t i = 0; i < count; ++i) {
        double exact[3], at[4], squared = 0;
        for (int r = 0; r < 3; ++r) {
          exact[r] = t.normal_matrix[3 * r] * in[3 * i] + t.normal_matrix[3 * r + 1] * in[3 * i + 1] +
                     t.normal_matrix[3 * r + 2] * in[3 * i + 2];
          squared += exact[r] * exact[r];
        }
        for (std::size_t r = 0; r < 4; ++r) {
          at[r] = 0;
          for (std::size_t k = 0; k < 4; ++k)
            at[r] += t.eye_from_object[4 * r + k] * (k < components ? in[components * i + k] : 1.0f);
        }
        const double w = at[3];
        const double whole = std::sqrt(squared);
        const double length =
            whole > 0 ? whole / std::clamp(whole, t.normal_lengths.shortest, t.normal_lengths.longest) : 1;
        for (std::size_t r = 0; r < 3; ++r) {
          ASSERT_NEAR(n[r][i], exact[r] / length, 1e-6 * std::max(1.0, whole / length));
          ASSERT_NEAR(p[r][i], at[r] / w, 1e-6 * (std::abs(at[r] / w) + 1e-3));
        }
      }
    }
    for (std::size_t set = 0; set < isas.size(); ++set)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(normals[set][r][i]),
                    std::bit_cast<std::uint32_t>(normals.back()[r][i]))
              << name_of(isas[set]);
          ASSERT_EQ(std::bit_cast<std::uint32_t>(points[set][r][i]),
                    std::bit_cast<std::uint32_t>(points.back()[r][i]))
              << name_of(isas[set]);
        }
  }
}
TEST(EyeTransform, DividesByOneIfWIsZero) {
  EyeTransform t;
  for (std::size_t k = 0; k < 3; ++k) t.eye_from_object[5 * k] = 1;
  const float position[4] = {1, -2, 3, 0};
  for (const InstructionSet isa : available_isas())
    for (const bool projects : {false, true}) {
      t.eye_from_object[15] = projects ? 0 : 1;
      float x[kVertexBatch], y[kVertexBatch], z[kVertexBatch];
      eye_positions(isa)(t, {position, 4}, projects ? 3 : 4, 1, x, y, z);
      EXPECT_TRUE(x[0] == 1 && y[0] == -2 && z[0] == 3)
          << name_of(isa) << ": " << x[0] << " " << y[0] << " " << z[0];
    }
}

}  // namespace
}  // namespace tessera::test::eye_transform_test
