// The built-in meshes: closed solids, wound outwards, with matching normals.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "engine/program/scene/builtin_mesh.h"

namespace tessera::builtin_mesh_test {
using namespace program;
namespace {

using Position = std::array<float, 3>;

Position position(const MeshData& mesh, std::size_t vertex) {
  return {mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]};
}

// The length is twice the triangle's area.
Vec3 face_normal(const MeshData& mesh, std::size_t triangle) {
  const Position a = position(mesh, mesh.indices[3 * triangle]);
  const Position b = position(mesh, mesh.indices[3 * triangle + 1]);
  const Position c = position(mesh, mesh.indices[3 * triangle + 2]);
  const double u[3] = {double{b[0]} - a[0], double{b[1]} - a[1], double{b[2]} - a[2]};
  const double v[3] = {double{c[0]} - a[0], double{c[1]} - a[1], double{c[2]} - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double volume(const MeshData& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 n = face_normal(mesh, t);
    const Position a = position(mesh, mesh.indices[3 * t]);
    sum += (n.x * a[0] + n.y * a[1] + n.z * a[2]) / 6;
  }
  return sum;
}

struct Topology {
  std::size_t vertices;
  std::size_t open_edges;
  long euler;  // V - E + F
};

// Returns the topology after merging vertices at the same position. An edge is open if no triangle uses it in
// the opposite direction.
Topology topology(const MeshData& mesh) {
  std::map<Position, std::size_t> welded;
  const auto id = [&](std::uint32_t vertex) {
    return welded.try_emplace(position(mesh, vertex), welded.size()).first->second;
  };
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{id(mesh.indices[i + k]), id(mesh.indices[i + (k + 1) % 3])}];
  std::size_t open = 0;
  std::size_t pairs = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (back == edges.end() || back->second != count) ++open;
    else ++pairs;
  }
  const long edge_count = static_cast<long>(open + pairs / 2);
  return {welded.size(), open,
          static_cast<long>(welded.size()) - edge_count + static_cast<long>(mesh.triangle_count())};
}

// The largest angle, in degrees, between a triangle and the normals at its corners.
double worst_angle(const MeshData& mesh) {
  double worst = 1;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 n = face_normal(mesh, t);
    const double length = std::hypot(n.x, n.y, n.z);
    for (std::size_t k = 0; k < 3; ++k) {
      const float* v = &mesh.normals[3 * mesh.indices[3 * t + k]];
      worst = std::min(worst, (n.x * v[0] + n.y * v[1] + n.z * v[2]) / length);
    }
  }
  return std::acos(worst) * 180 / 3.14159265358979;
}

TEST(BuiltinMesh, UnitNormalsAgreeWithTriangles) {
  for (const std::string_view name : kBuiltinMeshNames)
    for (const int detail : {min_mesh_detail(name), 3, 8, 16}) {
      const MeshData mesh = builtin_mesh(name, detail);
      ASSERT_GT(mesh.triangle_count(), 0u) << name;
      ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << name;
      for (std::size_t i = 0; i < mesh.normals.size(); i += 3)
        EXPECT_NEAR(std::hypot(mesh.normals[i], mesh.normals[i + 1], mesh.normals[i + 2]), 1, 1e-6)
            << name << " " << detail << " vertex " << i / 3;
      for (const std::uint32_t index : mesh.indices) EXPECT_LT(index, mesh.vertex_count());
      if (detail >= 8) {
        EXPECT_LT(worst_angle(mesh), name == "teapot" ? 80 : 25) << name << " " << detail;
      }  // the teapot bends sharply at its rim and knob
    }
}

TEST(BuiltinMesh, SolidsAreClosedWithExpectedVolume) {
  const struct {
    const char* name;
    double volume;
    long euler;
  } kSolids[] = {{"sphere", 4.18879, 2},
                 {"torus", 1.24363, 0},
                 {"cube", 8, 2},
                 {"cylinder", 6.28319, 2},
                 {"cone", 2.09440, 2}};
  for (const auto& [name, exact, euler] : kSolids)
    for (const int detail : {3, 7, 16, 64}) {
      const MeshData mesh = builtin_mesh(name, detail);
      const Topology found = topology(mesh);
      EXPECT_EQ(found.open_edges, 0u) << name << " " << detail;
      EXPECT_EQ(found.euler, euler) << name << " " << detail;
      EXPECT_GT(volume(mesh), 0) << name << " " << detail;
      if (detail == 64) {
        EXPECT_NEAR(volume(mesh) / exact, 1, 0.005) << name;
      }
    }
}

TEST(BuiltinMesh, QuadAndGridAreSquares) {
  EXPECT_EQ(builtin_mesh("quad").triangle_count(), 2u);
  EXPECT_EQ(builtin_mesh("grid", 5).triangle_count(), 50u);
  EXPECT_EQ(builtin_mesh("grid", 5).vertex_count(), 36u);
  const MeshData quad = builtin_mesh("quad", 7);
  EXPECT_EQ(quad.positions, (std::vector<float>{-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0}));
  EXPECT_EQ(quad.indices,
            (std::vector<std::uint32_t>{0, 1, 3, 0, 3, 2}));  // the diagonal starts at the lowest s and t
}

TEST(BuiltinMesh, TriangleCountsFollowDetail) {
  EXPECT_EQ(builtin_mesh("cube", 4).triangle_count(), 6u * 4 * 4 * 2);
  EXPECT_EQ(builtin_mesh("sphere", 4).triangle_count(),
            2u * 8 * 4 - 2 * 8);  // one triangle less at each pole
  EXPECT_EQ(builtin_mesh("torus", 4).triangle_count(), 2u * 8 * 4);
  EXPECT_EQ(builtin_mesh("cylinder", 4).triangle_count(), 2u * 8 + 2 * 8);
  EXPECT_EQ(builtin_mesh("cone", 4).triangle_count(), 8u + 8);
}

TEST(BuiltinMesh, TeapotIsCentredAndSpansMinusOneToOne) {
  for (const int detail : {1, 5, 12}) {
    const MeshData pot = builtin_mesh("teapot", detail);
    std::array<float, 3> low{9, 9, 9}, high{-9, -9, -9};
    for (std::size_t i = 0; i < pot.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], pot.positions[i]);
      high[i % 3] = std::max(high[i % 3], pot.positions[i]);
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(low[k], -high[k], 1e-6);
    EXPECT_NEAR(high[0], 1, 1e-6);  // handle to spout
    EXPECT_LT(high[1], 0.6);
  }
}

// The teapot is open only where spout and handle pierce the body, and at the rim under the lid.
TEST(BuiltinMesh, TeapotIsWoundOutwardsWithoutGapsBetweenPatches) {
  const MeshData pot = builtin_mesh("teapot", 10);
  EXPECT_GT(volume(pot), 0);
  EXPECT_EQ(pot.vertex_count(), 32u * 11 * 11);
  EXPECT_EQ(pot.triangle_count(), 32u * 2 * 100 - 8 * 10);
  // Open rings of 4 patch edges (2 at each of the four ends of handle and spout), 10 segments each.
  EXPECT_LE(topology(pot).open_edges, (4u + 4 + 4 * 2) * 10);
}

TEST(BuiltinMesh, TeapotPoleNormalsPointAlongTheAxis) {
  const MeshData pot = builtin_mesh("teapot", 6);
  int poles = 0;
  for (std::size_t i = 0; i < pot.vertex_count(); ++i) {
    const Position p = position(pot, i);
    if (p[0] * p[0] + p[2] * p[2] > 0.1f * 0.1f || std::abs(pot.normals[3 * i + 1]) < 0.999999f) continue;
    ++poles;
    EXPECT_GT(pot.normals[3 * i + 1] * p[1], 0) << i;  // up on the lid's knob, down under the bottom
  }
  EXPECT_GE(poles, 8 * 7);
}

TEST(BuiltinMesh, RejectsUnknownNamesAndDetails) {
  EXPECT_THROW(builtin_mesh("teapots"), Error);
  EXPECT_THROW(builtin_mesh("cube", 0), Error);
  EXPECT_THROW(builtin_mesh("cube", 1025), Error);
  EXPECT_THROW(builtin_mesh("sphere", 1), Error);
}

}  // namespace
}  // namespace tessera::builtin_mesh_test
