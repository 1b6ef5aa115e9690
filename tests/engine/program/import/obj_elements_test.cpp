// Lines and points of OBJ files, point clouds, vertex colours, and models far from the origin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/program/import/obj_folder.h"

namespace tessera::obj_elements_test {
using namespace program;
namespace {

using testing::ElementsAre;

class ObjElements : public ObjFolder {};

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The x and y of each corner of a part.
std::vector<std::array<float, 2>> corners(const Model& model, const ModelPart& part) {
  std::vector<std::array<float, 2>> positions;
  for (std::size_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
    const float* const p = &model.mesh.positions[3 * std::size_t{model.mesh.indices[i]}];
    positions.push_back({p[0], p[1]});
  }
  return positions;
}

TEST_F(ObjElements, PolylinesBecomeLines) {
  const Model model = shown(std::string(kSquare) + "l 1 2 3\nl -1 1/1 # closed\n");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].primitive, Primitive::lines);
  EXPECT_TRUE(model.parts[0].is_unlit);
  using P = std::array<float, 2>;
  EXPECT_THAT(corners(model, model.parts[0]),
              ElementsAre(P{0, 0}, P{1, 0}, P{1, 0}, P{1, 1}, P{0, 1}, P{0, 0}));
}

TEST_F(ObjElements, PointsStayPoints) {
  const Model model = shown(std::string(kSquare) + "p 2 4\np -2\n");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].primitive, Primitive::points);
  using P = std::array<float, 2>;
  EXPECT_THAT(corners(model, model.parts[0]), ElementsAre(P{1, 0}, P{0, 1}, P{1, 1}));
}

TEST_F(ObjElements, TrianglesComeFirstThenLinesThenPoints) {
  write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const Model model = shown("mtllib m.mtl\n" + std::string(kSquare) +
                            "usemtl red\np 1\nl 1 2\nusemtl blue\nl 2 3\nf 1 2 3\nusemtl red\nf 1 3 4\n");
  std::vector<std::pair<Primitive, std::string>> found;
  std::size_t next = 0;
  for (const ModelPart& part : model.parts) {
    found.emplace_back(part.primitive, part.material_name);
    EXPECT_EQ(part.first_index, next);
    next += part.index_count;
    EXPECT_EQ(part.is_unlit, part.primitive != Primitive::triangles);
  }
  EXPECT_EQ(next, model.mesh.indices.size());
  EXPECT_EQ(found, (std::vector<std::pair<Primitive, std::string>>{{Primitive::triangles, "blue"},
                                                                   {Primitive::triangles, "red"},
                                                                   {Primitive::lines, "red"},
                                                                   {Primitive::lines, "blue"},
                                                                   {Primitive::points, "red"}}));
  for (const std::uint32_t index : model.mesh.indices) ASSERT_LT(index, model.mesh.vertex_count());
  EXPECT_EQ(model.mesh.normals.size(), model.mesh.positions.size());
}

TEST_F(ObjElements, MeshesOfScenesHoldTrianglesAlone) {
  const Model model = mesh_of(std::string(kSquare) + "l 1 2\nf 1 2 3\np 4\n");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.mesh.vertex_count(), 3u);
  EXPECT_NE(message_of(std::string(kSquare) + "l 1 2\n").find("holds no triangle"), std::string::npos);
}

TEST_F(ObjElements, VerticesAloneAreAPointCloud) {
  const Model model = shown("vn 0 0 1\nv 1 2 3 1 0 0\nvn 0 1 0\nv 4 5 6 0 1 0.5\n");
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].primitive, Primitive::points);
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(model.parts[0].uses_colors);
  EXPECT_EQ(model.mesh.colors, (std::vector<float>{1, 0, 0, 1, 0, 1, 0.5f, 1}));
  EXPECT_THROW(shown("# nothing\nvn 0 0 1\n"), Error);
}

TEST_F(ObjElements, VertexColorsAreFactorsOfTheMaterial) {
  write("m.mtl", "newmtl half\nKd 0.5 1 0\nd 0.25\nnewmtl white\nKd 1 1 1\n");
  const std::string obj =
      "mtllib m.mtl\nv 0 0 0 1 0.5 0.25\nv 1 0 0 1 0.5 0.25\nv 0 1 0 1 0.5 0.25\n"
      "f 1 2 3\nusemtl half\nf 1 2 3\nusemtl white\nf 1 2 3\n";
  const Model model = shown(obj);
  ASSERT_EQ(model.parts.size(), 3u);
  const auto color = [&](std::size_t part) {
    EXPECT_TRUE(model.parts[part].uses_colors);
    const float* const c = &model.mesh.colors[4 * std::size_t{model.mesh.indices[3 * part]}];
    return std::array<float, 4>{c[0], c[1], c[2], c[3]};
  };
  EXPECT_THAT(color(0), ElementsAre(1, 0.5f, 0.25f, 1));
  EXPECT_THAT(color(1), ElementsAre(0.5f, 0.5f, 0, 0.25f));
  EXPECT_THAT(color(2), ElementsAre(1, 0.5f, 0.25f, 1));
  EXPECT_EQ(mesh_of(obj).mesh.colors,
            (std::vector<float>{1, 0.5f, 0.25f, 1, 1, 0.5f, 0.25f, 1, 1, 0.5f, 0.25f, 1}))
      << "draws of a scene have their own material";
}

TEST_F(ObjElements, VerticesWithoutColorAreWhite) {
  const Model model = shown(
      "v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1\nv 5 0 0\nv 5 1 0\nv 5 0 1\nf 1 2 3\n"
      "usemtl unknown\nf 4 5 6\n");
  EXPECT_EQ(std::vector<float>(model.mesh.colors.begin(), model.mesh.colors.begin() + 12),
            (std::vector<float>{1, 1, 1, 1, 0.5f, 0.5f, 0.5f, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(shown("v 0 0 0 1 0 x\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").parts[0].uses_colors);
}

TEST_F(ObjElements, FarModelsMoveToTheOrigin) {
  const std::string obj =
      "v 500000.125 5400000.5 -3\nv 500001.125 5400000.5 -3\nv 500000.125 5400001.25 -3\nf 1 2 3\n";
  const Model model = shown(obj);
  // Each coordinate of the file is the sum of origin and position, without rounding.
  const double origin[3] = {model.origin.x, model.origin.y, model.origin.z};
  const double expected[9] = {500000.125, 5400000.5,  -3,         500001.125, 5400000.5,
                              -3,         500000.125, 5400001.25, -3};
  ASSERT_EQ(model.mesh.positions.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(model.mesh.positions[i] + origin[i % 3], expected[i]) << i;
    EXPECT_LT(std::abs(model.mesh.positions[i]), 2) << i;
  }
  const Model mesh = mesh_of(obj);
  EXPECT_EQ(mesh.mesh.positions[0], 500000.125f);
  EXPECT_EQ(mesh.origin.x, 0);
}

TEST_F(ObjElements, NearModelsAndUnusedVerticesStay) {
  const Model near = shown("v 10 0 0\nv 11 0 0\nv 10 1 0\nf 1 2 3\n");
  EXPECT_EQ(near.origin.x, 0);
  EXPECT_EQ(near.mesh.positions[0], 10);
  const Model far = shown("v 0 0 0\nv 1000000 0 0\nv 1000001 0 0\nv 1000000 1 0\nf 2 3 4\n");
  EXPECT_NEAR(far.origin.x, 1000000, 1) << "the first vertex is not used";
}

}  // namespace
}  // namespace tessera::obj_elements_test
