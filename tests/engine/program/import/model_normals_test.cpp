// Generated normals of a cube and a fan, against geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/program/import/model_normals.h"

namespace tessera::model_normals_test {
using namespace program;
namespace {

// A cube of eight shared vertices, counter-clockwise as viewed from outside.
MeshData cube() {
  MeshData mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.insert(mesh.positions.end(), {static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                                 static_cast<float>(i >> 2)});
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

std::array<float, 3> normal(const MeshData& mesh, std::size_t index) {
  const float* const n = &mesh.normals[3 * std::size_t{mesh.indices[index]}];
  return {n[0], n[1], n[2]};
}

TEST(CreasedNormals, SplitsCubeVerticesIntoFlatFaces) {
  MeshData mesh = cube();
  mesh.colors.assign(4 * 8, 0.5f);
  mesh.texcoords.assign(2 * 8, 0.5f);
  add_creased_normals(mesh);
  EXPECT_EQ(mesh.vertex_count(), 24u);
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.colors.size(), 4 * mesh.vertex_count());
  EXPECT_EQ(mesh.texcoords.size(), 2 * mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::array<float, 3> n = normal(mesh, i);
    EXPECT_EQ(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1) << "along an axis";
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(normal(mesh, i + corner), n);
      // Outward.
      const float* const p = &mesh.positions[3 * std::size_t{mesh.indices[i + corner]}];
      EXPECT_GT(n[0] * (p[0] - 0.5f) + n[1] * (p[1] - 0.5f) + n[2] * (p[2] - 0.5f), 0);
    }
  }
}

TEST(CreasedNormals, WideAngleSmoothsCube) {
  MeshData mesh = cube();
  add_creased_normals(mesh, 100);
  EXPECT_EQ(mesh.vertex_count(), 8u);
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_GT(std::abs(mesh.normals[3 * v] * mesh.normals[3 * v + 1] * mesh.normals[3 * v + 2]), 0.05)
        << "between three faces";
}

TEST(CreasedNormals, WeightsByAreaAcrossCoincidentVertices) {
  // Two triangles without shared vertices that meet at a right angle; the second is twice as large.
  MeshData mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ -0.0f, 0, 0, 0, 1, 0, 0, 0, 2};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  add_creased_normals(mesh, 90);
  EXPECT_NEAR(mesh.normals[2], 1 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(mesh.normals[0], 2 / std::sqrt(5.0), 1e-6);
  EXPECT_EQ(mesh.normals[3 * 1 + 2], 1);
  EXPECT_EQ(mesh.normals[3 * 5 + 0], 1);
}

TEST(CreasedNormals, KeepsGivenNormalsAndToleratesNonFinitePositions) {
  MeshData mesh = cube();
  mesh.normals.assign(3 * 8, 0);
  mesh.normals[3 * 5 + 1] = -1;
  mesh.positions.insert(mesh.positions.end(), {NAN, 0, 0, INFINITY, 0, 0, 0, 0, 0});
  mesh.normals.resize(mesh.positions.size());
  mesh.indices.insert(mesh.indices.end(), {8, 9, 10});
  add_creased_normals(mesh);
  EXPECT_EQ(mesh.normals[3 * 5 + 1], -1);
  EXPECT_EQ(normal(mesh, 0), (std::array<float, 3>{0, 0, -1}))
      << "a triangle with non-finite positions is ignored";
}

// Above the limit for comparing triangles at one position, all of them form a smooth surface.
TEST(CreasedNormals, HandlesLargeFansInTime) {
  constexpr std::uint32_t kTriangles = 300000;
  MeshData mesh;
  mesh.positions = {0, 0, 1};
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kTriangles;
    mesh.positions.insert(mesh.positions.end(),
                          {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % kTriangles});
  }
  add_creased_normals(mesh);
  EXPECT_NEAR(mesh.normals[2], 1, 1e-4);
}

TEST(WindByNormals, ReversesTrianglesAgainstTheirNormals) {
  Model model{.mesh = cube()};
  MeshData& mesh = model.mesh;
  model.parts.push_back({.index_count = mesh.indices.size()});
  add_creased_normals(mesh);
  const std::vector<std::uint32_t> right = mesh.indices;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 6)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  orient_by_normals(model);
  EXPECT_EQ(mesh.indices, right);
}

/// The rule of add_creased_normals(), applied to each corner on its own by comparing it with all others.
std::array<double, 3> expected_normal(const MeshData& mesh, const std::vector<std::uint32_t>& groups,
                                      std::size_t corner) {
  const auto position = [&](std::size_t i) {
    const float* const p = &mesh.positions[3 * std::size_t{mesh.indices[i]}];
    return std::array<double, 3>{p[0], p[1], p[2]};
  };
  const auto area = [&](std::size_t i) {
    const auto a = position(i / 3 * 3), b = position(i / 3 * 3 + 1), c = position(i / 3 * 3 + 2);
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      n[k] = (b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l]);
    }
    return n;
  };
  const auto length = [](const std::array<double, 3>& n) { return std::hypot(n[0], n[1], n[2]); };
  const auto own = area(corner);
  const std::uint32_t group = groups.empty() ? 0 : groups[corner / 3];
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (position(i) != position(corner) || (!groups.empty() && groups[i / 3] != group)) continue;
    const auto n = area(i);
    const double cosine = (n[0] * own[0] + n[1] * own[1] + n[2] * own[2]) / (length(n) * length(own));
    if (group == 0 && cosine < std::cos(kCreaseDegrees * 3.14159265358979 / 180)) continue;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  const double l = length(sum);
  return {sum[0] / l, sum[1] / l, sum[2] / l};
}

// A rough grid with vertices that are shared, repeated, and in different smoothing groups.
TEST(CreasedNormals, AgreeWithComparingAllCorners) {
  constexpr std::uint32_t kSide = 9;
  std::uint32_t random = 7;
  const auto next = [&random] { return (random = random * 1664525 + 1013904223) >> 16; };
  for (const bool has_groups : {false, true}) {
    MeshData mesh;
    std::vector<std::uint32_t> groups;
    const auto height = [](std::uint32_t x, std::uint32_t y) {
      return static_cast<float>((x * 7 + y * 5 + x * y) % 4) * 0.4f;
    };
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> vertices;
    const auto corner = [&](std::uint32_t x, std::uint32_t y) {
      const auto found = vertices.find({x, y});
      if (found != vertices.end() && next() % 3 != 0) return mesh.indices.push_back(found->second);
      mesh.indices.push_back(vertices[{x, y}] = static_cast<std::uint32_t>(mesh.vertex_count()));
      mesh.positions.insert(mesh.positions.end(),
                            {static_cast<float>(x), static_cast<float>(y), height(x, y)});
    };
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        corner(x, y), corner(x + 1, y), corner(x, y + 1);
        corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1);
        for (int i = 0; i < 2 && has_groups; ++i) groups.push_back(next() % 3);
      }
    const MeshData before = mesh;
    double last = -1;
    add_creased_normals(mesh, kCreaseDegrees, groups, [&last](double done) {
      EXPECT_GE(done, last);
      last = done;
    });
    EXPECT_GE(last, 0);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      const auto expected = expected_normal(before, groups, i);
      const std::array<float, 3> found = normal(mesh, i);
      for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(found[k], expected[k], 1e-6) << i;
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(mesh.positions[3 * std::size_t{mesh.indices[i]} + k],
                  before.positions[3 * std::size_t{before.indices[i]} + k]);
    }
  }
}

}  // namespace
}  // namespace tessera::model_normals_test
