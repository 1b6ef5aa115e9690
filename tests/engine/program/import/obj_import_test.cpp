// Import of OBJ and MTL files, valid and broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/import/obj.h"
#include "engine/program/scene/model_scene.h"
#include "tests/engine/program/import/obj_folder.h"

namespace tessera::obj_import_test {
using namespace program;
namespace {

class ObjImport : public ObjFolder {};

TEST_F(ObjImport, TriangulatesFacesAndSharesVertices) {
  const Model model = import_model(
      write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0\nf 1 2 3 4\nf -3 -1 -2\n"));
  EXPECT_EQ(model.mesh.triangle_count(), 3u);
  EXPECT_EQ(model.mesh.vertex_count(), 5u);
  EXPECT_TRUE(model.mesh.normals.empty());
  EXPECT_TRUE(model.mesh.colors.empty());
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].index_count, 9u);
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(ObjImport, SplitsVerticesWithDifferentNormals) {
  const Model model = import_model(
      write("n.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n"));
  EXPECT_EQ(model.mesh.vertex_count(), 5u);
  EXPECT_EQ(model.mesh.normals.size(), 15u);
}

TEST_F(ObjImport, SplitsVerticesWithDifferentTextureCoordinates) {
  write("t.mtl", "newmtl a\nnewmtl b\n");
  const Model model =
      import_model(write("t.obj",
                         "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt -3 2 "
                         "0\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/2 4/-1\n"));
  EXPECT_EQ(model.mesh.vertex_count(), 5u) << "the third position has two texture coordinates";
  EXPECT_EQ(model.mesh.texcoords, (std::vector<float>{0, 0, 1, 0.25f, -3, 2, 1, 0.25f, -3, 2}));
  EXPECT_TRUE(model.mesh.normals.empty());
  const std::vector<MeshData> parts = split_into_parts(model);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].texcoords, (std::vector<float>{0, 0, 1, 0.25f, -3, 2}));
}

TEST_F(ObjImport, CornersWithoutTextureCoordinatesGetZero) {
  for (const char* corners : {"1 2 3", "1/ 2/ 3/", "1/0 2/0 3/0", "1// 2// 3//", "1/9 2/9 3/9"}) {
    const Model model = mesh_of(std::string(kTriangle) + "vt 0.5 1\nf 1/1 2/1 3/1\nf " + corners + "\n");
    EXPECT_EQ(model.mesh.texcoords, (std::vector<float>{0.5f, 1, 0.5f, 1, 0.5f, 1, 0, 0, 0, 0, 0, 0}))
        << corners;
    ASSERT_EQ(model.warnings.size(), 1u) << corners;
    EXPECT_NE(model.warnings[0].find("only some corners have texture coordinates"), std::string::npos);
  }
}

TEST_F(ObjImport, GroupsTrianglesByMaterial) {
  write("m.mtl",
        "newmtl red\nKa 0.1 0.2 0.3\nKd 1 0 0\nKs 0.5 0.5 0.5\nKe 0 0 0.25\nNs 50\nd 0.5\nnewmtl hot\nKd 0 1 "
        "0\nNs 99999\n");
  const Model model = import_model(
      write("m.obj", "mtllib m.mtl\n" + std::string(kTriangle) +
                         "v 0 0 5\nusemtl red\nf 1 2 3\nusemtl hot\nf 1 2 4\nusemtl red\nf 2 3 4\n"));
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.parts[0].material_name, "red");
  EXPECT_EQ(model.parts[0].index_count, 6u);
  EXPECT_EQ(model.parts[1].first_index, 6u);
  const Material& red = model.parts[0].material;
  EXPECT_FLOAT_EQ(red.ambient.g, 0.2f);
  EXPECT_FLOAT_EQ(red.diffuse.r, 1);
  EXPECT_FLOAT_EQ(red.diffuse.a, 0.5f);
  EXPECT_FLOAT_EQ(red.specular.b, 0.5f);
  EXPECT_FLOAT_EQ(red.emission.b, 0.25f);
  EXPECT_FLOAT_EQ(red.shininess, 50);
  EXPECT_FLOAT_EQ(model.parts[1].material.shininess, 16384);
  EXPECT_EQ(model.parts[0].alpha, ModelAlpha::blend);
  EXPECT_EQ(model.parts[1].alpha, ModelAlpha::opaque);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("Ns of material \"hot\""), std::string::npos);
  const MeshData hot = split_into_parts(model)[1];
  EXPECT_EQ(hot.vertex_count(), 3u);
  EXPECT_EQ(hot.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(ObjImport, DefaultsMissingMaterialColors) {
  write("few.mtl", "newmtl nothing\nNs 5\nnewmtl green\nKd 0 0.5 0\nnewmtl dark\nKa 0 0 0\nKd 0 0 0\n");
  const Model model = import_model(
      write("few.obj", "mtllib few.mtl\n" + std::string(kTriangle) +
                           "usemtl nothing\nf 1 2 3\nusemtl green\nf 1 2 3\nusemtl dark\nf 1 2 3\n"));
  ASSERT_EQ(model.parts.size(), 3u);
  EXPECT_FLOAT_EQ(model.parts[0].material.diffuse.g, 0.8f);
  EXPECT_FLOAT_EQ(model.parts[0].material.ambient.g, 0.8f);
  EXPECT_FLOAT_EQ(model.parts[1].material.diffuse.r, 0);
  EXPECT_FLOAT_EQ(model.parts[1].material.ambient.g, 0.5f);
  EXPECT_FLOAT_EQ(model.parts[2].material.diffuse.g, 0);
  EXPECT_FLOAT_EQ(model.parts[2].material.ambient.g, 0);
}

TEST_F(ObjImport, AcceptsNamesWithSpaces) {
  write("my materials.mtl", "\xef\xbb\xbfnewmtl dark red \nKd 0.5 0 0\n");
  const Model model = import_model(write(
      "my model.obj", "mtllib my materials.mtl\n" + std::string(kTriangle) + "usemtl dark red\nf 1 2 3\n"));
  EXPECT_EQ(model.parts.at(0).material_name, "dark red");
  EXPECT_FLOAT_EQ(model.parts[0].material.diffuse.r, 0.5f);
  EXPECT_TRUE(model.warnings.empty());
  write("a.mtl", "newmtl a\nKd 1 0 0\n");
  write("b.mtl", "newmtl b\nKd 0 1 0\n");
  const Model two = import_model(write(
      "two.obj", "mtllib a.mtl b.mtl\n" + std::string(kTriangle) + "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"));
  EXPECT_FLOAT_EQ(two.parts.at(0).material.diffuse.g, 1);
  EXPECT_FLOAT_EQ(two.parts.at(1).material.diffuse.r, 1);
}

TEST_F(ObjImport, ReadsGreyColorsAndSkipsSpectralOnes) {
  write("k.mtl", "newmtl grey\nKd 0.5\nnewmtl curve\nKd spectral x.rfl\n");
  const Model model = import_model(write(
      "k.obj", "mtllib k.mtl\n" + std::string(kTriangle) + "usemtl grey\nf 1 2 3\nusemtl curve\nf 1 2 3\n"));
  EXPECT_FLOAT_EQ(model.parts.at(0).material.diffuse.b, 0.5f);
  EXPECT_FLOAT_EQ(model.parts.at(1).material.diffuse.b, 0.8f);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("Kd of material \"curve\""), std::string::npos);
}

TEST_F(ObjImport, IllumBelow2DisablesHighlight) {
  write("i.mtl",
        "newmtl dull\nKs 1 1 1\nNs 9\nillum 1\nnewmtl shiny\nKs 1 1 1\nNs 9\nillum 2\nnewmtl missing\nKs 1 1 "
        "1\nNs 9\n");
  const Model model = import_model(
      write("i.obj", "mtllib i.mtl\n" + std::string(kTriangle) +
                         "usemtl dull\nf 1 2 3\nusemtl shiny\nf 1 2 3\nusemtl missing\nf 1 2 3\n"));
  EXPECT_EQ(model.parts.at(0).material.specular.r, 0);
  EXPECT_EQ(model.parts.at(1).material.specular.r, 1);
  EXPECT_EQ(model.parts.at(2).material.specular.r, 1);
}

TEST_F(ObjImport, KeepsLineNumbersAcrossContinuedLines) {
  EXPECT_EQ(import_model(write("cont.obj", std::string(kTriangle) + "f 1 \\\n2 3\n")).mesh.vertex_count(),
            3u);
  const std::string message = message_of(std::string(kTriangle) + "f 1 \\\n2 3\nf 1 2 9\n");
  EXPECT_NE(message.find("bad.obj:6: index 9"), std::string::npos) << message;
}

TEST_F(ObjImport, WarnsOfMissingMaterialFile) {
  const Model model =
      import_model(write("w.obj", "mtllib nowhere.mtl\n" + std::string(kTriangle) + "usemtl red\nf 1 2 3\n"));
  ASSERT_FALSE(model.warnings.empty());
  EXPECT_NE(model.warnings[0].find("nowhere.mtl"), std::string::npos);
  EXPECT_FLOAT_EQ(model.parts.at(0).material.diffuse.r, 0.8f);
}

TEST_F(ObjImport, AcceptsWindowsPathsOfMaterialFiles) {
  std::filesystem::create_directories(folder_ / "sub");
  write("sub/a b.mtl", "newmtl red\nKd 1 0 0\n");
  std::filesystem::create_directories(folder_ / "(v2)");
  write("(v2)/a.mtl", "newmtl red\nKd 1 0 0\n");
  write("c.mtl", "newmtl blue\nKd 0 0 1\n");
  for (const std::string name : {"sub\\a b.mtl", ".\\sub\\a b.mtl", "sub\\a\\ b.mtl", "sub\\\\a b.mtl",
                                 ".\\(v2)\\a.mtl", ".\\(v2)\\a.mtl .\\c.mtl"}) {
    const Model model = import_model(
        write("w.obj", "mtllib " + name + "\n" + std::string(kTriangle) + "usemtl red\nf 1 2 3\n"));
    EXPECT_TRUE(model.warnings.empty()) << name << ": " << model.warnings.at(0);
    EXPECT_FLOAT_EQ(model.parts.at(0).material.diffuse.g, 0) << name;
  }
}

TEST_F(ObjImport, UnescapesNamesOfMaterialFiles) {
  write("my file(1).mtl", "newmtl red\nKd 1 0 0\n");
  write("a\\b.mtl", "newmtl red\nKd 1 0 0\n");
  for (const std::string name : {"my\\ file\\(1\\).mtl", "a\\\\b.mtl"}) {
    const Model model = import_model(
        write("e.obj", "mtllib " + name + "\n" + std::string(kTriangle) + "usemtl red\nf 1 2 3\n"));
    EXPECT_TRUE(model.warnings.empty()) << name << ": " << model.warnings.at(0);
    EXPECT_FLOAT_EQ(model.parts.at(0).material.diffuse.g, 0) << name;
  }
}

TEST_F(ObjImport, WarnsOfTooLongMaterialFileName) {
  const Model model = import_model(write(
      "long.obj", "mtllib " + std::string(300, 'x') + " y.mtl\n" + std::string(kTriangle) + "f 1 2 3\n"));
  EXPECT_EQ(model.mesh.indices.size(), 3u);
  ASSERT_FALSE(model.warnings.empty());
  EXPECT_NE(model.warnings[0].find("File name too long"), std::string::npos) << model.warnings[0];
}

TEST_F(ObjImport, AcceptsAnyLineEndsAndSpaces) {
  const Model model =
      import_model(write("crlf.obj", "# x\r\nv 0 0 0\r\nv\t1 0 0\r\n  v 0 +1. .0e1\r\nf 1/1 2/2 3\r\n"));
  EXPECT_EQ(model.mesh.triangle_count(), 1u);
}

TEST_F(ObjImport, ErrorsNameFileAndLine) {
  const struct {
    std::string text;
    std::string place;
    std::string fragment;
  } kBroken[] = {
      {std::string(kTriangle) + "f 1 2 4\n", ":4: ", "index 4 is out of bounds, there are 3 vertices"},
      {std::string(kTriangle) + "f 1 2 -4\n", ":4: ", "index -4 is out of bounds"},
      {std::string(kTriangle) + "f 0 1 2\n", ":4: ", "index 0 is out of bounds"},
      {std::string(kTriangle) + "f 1//1 2//1 3//1\n", ":4: ", "there are 0 normals"},
      {std::string(kTriangle) + "f 1 2\n", ":4: ", "a face has 2 corners, expected at least 3"},
      {std::string(kTriangle) + "f 1 2 x\n", ":4: ", "found \"x\", expected an index"},
      {std::string(kTriangle) + "f 1 2 99999999999999999999\n", ":4: ", "expected an index"},
      {std::string(kTriangle) + "f 1/4294967297 2/1 3/1\n",
       ":4: ", "texture index 4294967297 is out of bounds"},
      {std::string(kTriangle) + "f 1/1 2/-9223372036854775808/1 3/1\n",
       ":4: ", "texture index -9223372036854775808 is out of bounds"},
      {std::string(kTriangle) + "l 1\n", ":4: ", "a line has 1 corners, expected at least 2"},
      {std::string(kTriangle) + "l 0 1\n", ":4: ", "index 0 is out of bounds"},
      {std::string(kTriangle) + "p 4\n", ":4: ", "index 4 is out of bounds"},
      {std::string(kTriangle) + "f 1/1/1/1 2 3\n", ":4: ", "found \"1/1\", expected an index"},
      {std::string(kTriangle) + "f 1/1 2/x 3/1\n", ":4: ", "found \"x\", expected an index"},
      {"v 0 0 nan\n", ":1: ", "found \"nan\" after \"v\", expected a finite number"},
      {"v 0 0 0\nv inf 0 0\n", ":2: ", "found \"inf\""},
      {"v 0 0 1e39\n", ":1: ", "found \"1e39\""},
      {"v 0 0\n", ":1: ", "\"v\" has 2 numbers, expected 3"},
      {"vn 0 0 one\n", ":1: ", "found \"one\" after \"vn\""},
      {"", ": ", "holds no triangle"},
      {kTriangle, ": ", "holds no triangle"},
      {"v 0 0 0\nv 1 1 1\nl 1 2\n", ": ", "holds no triangle"},
      {std::string("\0\x01\xff garbage\n", 13), ": ", "holds no triangle"},
  };
  for (const auto& [text, place, fragment] : kBroken) {
    const std::string message = message_of(text);
    EXPECT_TRUE(message.starts_with((folder_ / "bad.obj").string() + place)) << text << message;
    EXPECT_NE(message.find(fragment), std::string::npos) << text << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(ObjImport, ErrorsNameMaterialFile) {
  write("bad.mtl", "newmtl a\nKd 1 nan 0\n");
  const std::string message = message_of("mtllib bad.mtl\n" + std::string(kTriangle) + "f 1 2 3\n");
  EXPECT_NE(message.find("bad.mtl:2: found \"nan\" after \"Kd\""), std::string::npos) << message;
}

TEST_F(ObjImport, SkipsNonIntegerIllum) {
  const auto model_of = [this](const std::string& illum) {
    write("illum.mtl", "newmtl a\nKs 1 1 1\nNs 9\nillum" + illum + "\n");
    return import_model(
        write("illum.obj", "mtllib illum.mtl\n" + std::string(kTriangle) + "usemtl a\nf 1 2 3\n"));
  };
  for (const char* illum : {" 4294967297", " 1e9", " 1.0e1", " illum_1", " 1;", "", " # none"}) {
    const Model model = model_of(illum);
    EXPECT_EQ(model.parts.at(0).material.specular.r, 1) << illum;
    ASSERT_EQ(model.warnings.size(), 1u) << illum;
    EXPECT_NE(model.warnings[0].find("illum of material \"a\" is left out: found \"" +
                                     std::string(illum + (*illum != 0 ? 1 : 0)) + "\""),
              std::string::npos)
        << model.warnings[0];
  }
  for (const char* illum : {" 1", " +1", " 1.0", "\t0 # dull", " -3"}) {
    const Model model = model_of(illum);
    EXPECT_EQ(model.parts.at(0).material.specular.r, 0) << illum;
    EXPECT_TRUE(model.warnings.empty()) << illum;
  }
}

TEST_F(ObjImport, SkipsUnusedLines) {
  std::string groups = "f 1 2 3\n";
  for (int i = 0; i < 4000; ++i) groups += "g a\nf 1 2 3\n";
  for (const char* line : {"vw 0 -1 0.5\n", "l 1 2\n", "p 1\n", "t x 8192/8192/8192\n", "vp 1\n", "# \\\n"}) {
    const Model model = import_model(write("more.obj", kTriangle + (line + groups)));
    EXPECT_EQ(model.mesh.triangle_count(), 4001u) << line;
    EXPECT_TRUE(model.warnings.empty()) << line;
  }
}

TEST_F(ObjImport, ReportsProgress) {
  std::string text = kTriangle;
  for (int i = 0; i < 300000; ++i) text += "f 1 2 3\n";
  std::vector<double> reports;
  import_obj(write("long.obj", text), ModelUse::display, [&](double done) { reports.push_back(done); });
  ASSERT_GE(reports.size(), 8u);
  EXPECT_TRUE(std::ranges::is_sorted(reports));
  EXPECT_GT(reports.front(), 0);
  EXPECT_LT(reports.front(), 0.2);
  EXPECT_GT(reports.back(), 0.7);
  EXPECT_LE(reports.back(), 1);
}

TEST_F(ObjImport, RejectsMissingFilesFoldersAndUnknownFormats) {
  EXPECT_THROW(import_model((folder_ / "nothing.obj").string()), Error);
  std::filesystem::create_directories(folder_ / "folder.obj");
  EXPECT_THROW(import_model((folder_ / "folder.obj").string()), Error);
  EXPECT_THROW(import_model(write("x.txt", "solid")), Error);
}

TEST_F(ObjImport, DefaultCameraShowsWholeModel) {
  const Model model = import_model(
      write("far.obj", "v 100 0 0\nv 110 0 0\nv 100 3 0\nv 100 0 7\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n"));
  for (const auto& [width, height] : {std::pair{640, 480}, {100, 400}, {1000, 50}}) {
    const Scene scene = model_scene(model, "far.obj", width, height);
    const Camera camera = scene.camera.at_aspect(static_cast<double>(width) / height);
    const Matrix clip_from_world = camera.projection * camera.view;
    for (std::size_t i = 0; i < model.mesh.positions.size(); i += 3) {
      const double p[4] = {model.mesh.positions[i], model.mesh.positions[i + 1], model.mesh.positions[i + 2],
                           1};
      double clip[4] = {};
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 4; ++k) clip[row] += clip_from_world.m[4 * row + k] * p[k];
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LE(std::abs(clip[k]), clip[3]) << width << "x" << height << " vertex " << i / 3;
    }
    EXPECT_TRUE(scene.light_model.local_viewer);
    EXPECT_EQ(std::get<DrawCommand>(scene.frame.at(1).value).state.shading, Shading::phong);
  }
  EXPECT_THROW(model_scene(import_model(write("point.obj", "v 1 1 1\nf 1 1 1\n")), "point.obj"), Error);
}

TEST_F(ObjImport, ReadsStanfordBunnyIfInstalled) {
  const char* path = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "glmark2-data is not installed";
  const Model model = import_model(path);
  EXPECT_EQ(model.mesh.triangle_count(), 69666u);
  EXPECT_LT(model.mesh.vertex_count(), 69666u);
}

}  // namespace
}  // namespace tessera::obj_import_test
