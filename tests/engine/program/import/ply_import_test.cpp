// Import of PLY files in all formats and types: triangles, strips, lines and points.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "engine/program/import/model_file.h"
#include "engine/program/import/ply.h"
#include "tests/engine/program/import/model_picture.h"
#include "tests/engine/program/import/ply_writer.h"

namespace tessera::ply_import_test {
using namespace program;
using ply_writer::Format;
using ply_writer::header;
using ply_writer::value;
namespace {

using Corner = std::array<float, 3>;
constexpr Format kFormats[] = {Format::ascii, Format::little, Format::big};
const std::vector<std::string> kTypes = {"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                         "float", "double", "int8",    "uint8",  "int16", "uint16",
                                         "int32", "uint32", "float32", "float64"};
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

Model read(const std::string& bytes, ModelUse use = ModelUse::display) {
  ModelFile file("m.ply", bytes);
  return read_ply(file, use);
}

/// A text file of four vertices, the corners of a unit square, with one more property.
std::string square(const std::string& properties, const std::vector<std::string>& values,
                   const std::string& rest_of_header = "", const std::string& rest = "") {
  std::string text = header(Format::ascii, "element vertex 4\n" + kXyz + properties + rest_of_header);
  const char* const corners[] = {"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
  for (std::size_t i = 0; i < 4; ++i)
    text += std::string(corners[i]) + " " + values[i % values.size()] + "\n";
  return text + rest;
}

std::string message_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

Corner at(const std::vector<float>& values, std::uint32_t index, std::size_t components = 3) {
  const float* const v = &values[components * index];
  return {v[0], v[1], v[2]};
}

TEST(PlyImport, ReadsAllTypesInAllFormats) {
  for (const Format format : kFormats)
    for (const std::string& type : kTypes) {
      std::string bytes = header(format, "element vertex 3\nproperty " + type + " x\nproperty " + type +
                                             " y\nproperty double z\n" +
                                             "element face 1\nproperty list uchar uint vertex_indices\n");
      const double coordinates[] = {0, 0, -1.5, 100, 3, 0.25, 7, 90, 1e9};
      for (std::size_t i = 0; i < 9; ++i)
        bytes += value(coordinates[i], i % 3 == 2 ? "double" : type, format);
      bytes += value(3, "uchar", format);
      for (const double index : {2, 0, 1}) bytes += value(index, "uint", format);
      const Model model = read(bytes);
      EXPECT_EQ(model.mesh.positions, (std::vector<float>{0, 0, -1.5f, 100, 3, 0.25f, 7, 90, 1e9f})) << type;
      EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{2, 0, 1})) << type;
    }
}

TEST(PlyImport, ReadsAllTypesOfLists) {
  for (const Format format : kFormats)
    for (const std::string count : {"char", "uchar", "short", "ushort", "int", "uint"})
      for (const std::string& index : kTypes) {
        std::string bytes =
            header(format, "element vertex 3\n" + kXyz + "element face 2\nproperty list " + count + " " +
                               index + " vertex_index\nproperty float quality\n");
        for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) bytes += value(x, "float", format);
        for (const int last : {2, 1}) {
          bytes += value(3, count, format);
          for (const int i : {0, 3 - last, last}) bytes += value(i, index, format);
          bytes += value(0.5, "float", format);
        }
        EXPECT_EQ(read(bytes).mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1})) << count << index;
      }
}

TEST(PlyImport, ReadsColorsOfAllNamesAndTypes) {
  struct Case {
    const char *properties, *values;
    std::array<float, 4> expected;
  };
  const Case cases[] = {
      {"property uchar red\nproperty uchar green\nproperty uchar blue\n", "51 255 0", {0.2f, 1, 0, 1}},
      {"property uchar r\nproperty uchar g\nproperty uchar b\nproperty uchar a\n",
       "51 255 0 102",
       {0.2f, 1, 0, 0.4f}},
      {"property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n",
       "0 51 102",
       {0, 0.2f, 0.4f, 1}},
      {"property float red\nproperty float green\nproperty float blue\nproperty float alpha\n",
       "0.25 0.5 0.75 0.125",
       {0.25f, 0.5f, 0.75f, 0.125f}},
      {"property ushort red\nproperty ushort green\nproperty ushort blue\n",
       "13107 65535 0",
       {0.2f, 1, 0, 1}},
      {"property int red\nproperty int green\nproperty int blue\n", "51 255 0", {0.2f, 1, 0, 1}},
      {"property uchar blue\nproperty uchar alpha\nproperty uchar green\nproperty uchar red\n",
       "255 255 0 51",
       {0.2f, 0, 1, 1}}};
  for (const Case& c : cases) {
    const Model model = read(square(c.properties, {c.values}));
    ASSERT_EQ(model.mesh.colors.size(), 16u) << c.properties;
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(model.mesh.colors[k], c.expected[k % 4]) << c.properties;
    EXPECT_TRUE(model.parts.at(0).uses_colors);
    EXPECT_EQ(model.parts[0].alpha, c.expected[3] < 1 ? ModelAlpha::blend : ModelAlpha::opaque)
        << c.properties;
  }
  EXPECT_TRUE(read(square("property uchar red\n", {"5"})).mesh.colors.empty());
  const Model unset =
      read(square("property uchar r\nproperty uchar g\nproperty uchar b\nproperty uchar a\n", {"1 2 3 0"}));
  EXPECT_EQ(unset.mesh.colors[3], 1) << "alpha 0 of all vertices hides nothing";
  EXPECT_EQ(unset.parts.at(0).alpha, ModelAlpha::opaque);
}

TEST(PlyImport, ReadsNormalsAndTextureCoordinates) {
  for (const char* const names :
       {"s\nproperty float t\n", "u\nproperty float v\n", "texture_u\nproperty float texture_v\n"}) {
    const Model model = read(square(
        std::string("property float nx\nproperty float ny\nproperty float nz\nproperty float ") + names,
        {"0 0.6 0.8 0.25 0.75"}, "element face 1\n" + kFaces, "4 0 1 2 3\n"));
    ASSERT_EQ(model.mesh.texcoords.size(), 8u) << names;
    EXPECT_EQ(model.mesh.texcoords[6], 0.25f);
    EXPECT_EQ(model.mesh.texcoords[7], 0.75f);
    EXPECT_EQ(at(model.mesh.normals, 3), (Corner{0, 0.6f, 0.8f}));
    EXPECT_TRUE(model.images.empty());
  }
  std::string textured =
      square("property float s\nproperty float t\n", {"0 1"}, "element face 1\n" + kFaces, "4 0 1 2 3\n");
  textured.insert(textured.find("element"), "comment TextureFile a b.png\n");
  const Model model = read(textured);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].name, "a b.png");
  EXPECT_EQ(model.parts.at(0).texture, 0u);
}

// As MeshLab writes them: two triangles of a square with a seam at one vertex.
TEST(PlyImport, SplitsVerticesAtTextureCoordinatesOfFaces) {
  const Model model =
      read(square("", {""}, "element face 2\n" + kFaces + "property list uchar float texcoord\n",
                  "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0.5 1 1 0 1\n"));
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 4}));
  EXPECT_EQ(model.mesh.texcoords, (std::vector<float>{0, 0, 1, 0, 1, 1, 0.5f, 0.5f, 0, 1}));
  EXPECT_EQ(at(model.mesh.positions, 3), at(model.mesh.positions, 0));
}

TEST(PlyImport, ReadsColorsOfFaces) {
  ModelFile file(model_picture::kModels + "ply/face_colors.ply");
  const Model model = read_ply(file, ModelUse::display);
  ASSERT_EQ(model.mesh.indices.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(at(model.mesh.colors, model.mesh.indices[i], 4), (i < 3 ? Corner{1, 0, 0} : Corner{0, 0, 1}));
  // Faces of one color share their corners; a property follows the list.
  const Model equal = read(
      square("", {""}, "element face 2\nproperty float r\nproperty float g\n" + kFaces + "property float b\n",
             "0 1 3 0 1 2 0.5\n0 1 3 0 2 3 0.5\n"));
  EXPECT_EQ(equal.mesh.vertex_count(), 4u);
  EXPECT_EQ(at(equal.mesh.colors, 3, 4), (Corner{0, 1, 0.5f}));
}

TEST(PlyImport, MixesFacesWithAndWithoutColors) {
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const Model model =
      read(square("", {""}, "element face 1\n" + kFaces + "element face 1\n" + kFaces + colors,
                  "3 0 1 2\n3 0 2 3 255 0 0\n"));
  ASSERT_EQ(model.mesh.vertex_count(), 6u);
  for (std::uint32_t i = 0; i < 6; ++i)
    EXPECT_EQ(at(model.mesh.colors, model.mesh.indices[i], 4), (i < 3 ? Corner{1, 1, 1} : Corner{1, 0, 0}));
}

// The triangles of an arrow-shaped and of a comb-shaped polygon have its winding and sum up to its area.
TEST(PlyImport, DividesConcavePolygons) {
  const std::vector<std::array<int, 2>> shapes[] = {
      {{0, 0}, {4, 4}, {0, 8}, {2, 4}},
      {{0, 0}, {9, 0}, {9, 5}, {8, 5}, {8, 1}, {5, 1}, {5, 5}, {4, 5}, {4, 1}, {1, 1}, {1, 5}, {0, 5}}};
  for (const auto& shape : shapes)
    for (std::size_t first = 0; first < shape.size(); ++first) {
      const std::string n = std::to_string(shape.size());
      std::string text =
          header(Format::ascii, "element vertex " + n + "\n" + kXyz + "element face 1\n" + kFaces);
      int area = 0;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const auto [x, y] = shape[i];
        const auto [next_x, next_y] = shape[(i + 1) % shape.size()];
        area += x * next_y - y * next_x;
        text += std::to_string(x) + " 5 " + std::to_string(-y) + "\n";
      }
      text += n;
      for (std::size_t i = 0; i < shape.size(); ++i) text += " " + std::to_string((first + i) % shape.size());
      const Model model = read(text + "\n");
      ASSERT_EQ(model.mesh.indices.size(), 3 * (shape.size() - 2));
      double sum = 0;
      for (std::size_t i = 0; i < model.mesh.indices.size(); i += 3) {
        const Corner a = at(model.mesh.positions, model.mesh.indices[i]);
        const Corner b = at(model.mesh.positions, model.mesh.indices[i + 1]);
        const Corner c = at(model.mesh.positions, model.mesh.indices[i + 2]);
        const double triangle = (b[0] - a[0]) * -(c[2] - a[2]) + (b[2] - a[2]) * (c[0] - a[0]);
        EXPECT_GE(triangle * area, 0) << first;
        sum += triangle;
      }
      EXPECT_EQ(sum, area) << first;
    }
}

TEST(PlyImport, IgnoresFacesOfFewCorners) {
  const Model model = read(square("", {""}, "element face 4\n" + kFaces, "0\n1 3\n2 0 1\n3 0 1 2\n"));
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(PlyImport, ReadsTriangleStrips) {
  const auto strips = model_picture::draw_model("ply/triangle_strips.ply");
  EXPECT_EQ(strips.rgba, model_picture::draw_model("ply/plain/triangle_strips.ply").rgba);
  const Model model = read(square("", {""}, "element tristrips 2\nproperty list uchar int vertex_indices\n",
                                  "7 -1 0 1 2 3 -1 0\n5 2 2 1 3 0\n"));
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 1, 2, 3, 1, 3, 0}))
      << "repeated corners keep the order";
}

TEST(PlyImport, ReadsPoints) {
  ModelFile file(model_picture::kModels + "ply/point_cloud.ply");
  const Model model = read_ply(file, ModelUse::display);
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].primitive, Primitive::points);
  EXPECT_TRUE(model.parts[0].is_unlit);
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(at(model.mesh.colors, 2, 4), (Corner{0, 0, 1}));
  std::string scan = square("property float nx\nproperty float ny\nproperty float nz\n", {"0 0 1"},
                            "element face 0\n" + kFaces);
  scan.replace(scan.find("1 1 0 "), 5, "nan nan nan");
  const Model valid = read(scan);
  EXPECT_EQ(valid.mesh.indices, (std::vector<std::uint32_t>{0, 1, 3})) << "without the missing point";
  EXPECT_FALSE(valid.parts[0].is_unlit);
}

TEST(PlyImport, ReadsEdgesOfFilesWithoutFaces) {
  const std::string edges =
      "element edge 2\nproperty int vertex1\nproperty uchar kind\nproperty int vertex2\n";
  const Model model = read(square("", {""}, edges, "0 9 1\n3 9 2\n"));
  EXPECT_EQ(model.parts.at(0).primitive, Primitive::lines);
  EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 3, 2}));
  const Model faces = read(square("", {""}, edges + "element face 1\n" + kFaces, "0 9 1\n3 9 2\n3 0 1 2\n"));
  EXPECT_EQ(faces.parts.at(0).primitive, Primitive::triangles);
}

TEST(PlyImport, SkipsWhatItDoesNotKnow) {
  for (const Format format : kFormats) {
    std::string bytes =
        header(format,
               "comment made by hand\nobj_info any\nelement camera 2\nproperty float f\nproperty list "
               "ushort double k\nelement nothing 5000000000\nelement vertex 3\nproperty int id\nproperty "
               "list uchar short x\n" +
                   kXyz + "element face 1\nproperty list uint float w\n" + kFaces +
                   "property double area\nelement material 1\nproperty uchar m\n");
    for (const int length : {0, 2}) {
      bytes += value(1, "float", format) + value(length, "ushort", format);
      for (int i = 0; i < length; ++i) bytes += value(i, "double", format);
    }
    for (const int x : {0, 1, 2}) {
      bytes += value(7, "int", format) + value(1, "uchar", format) + value(-3, "short", format);
      for (const int coordinate : {x, x * x, 0}) bytes += value(coordinate, "float", format);
    }
    bytes += value(1, "uint", format) + value(0.5, "float", format) + value(3, "uchar", format);
    for (const int i : {0, 1, 2}) bytes += value(i, "int", format);
    bytes += value(2, "double", format) + value(200, "uchar", format);
    const Model model = read(bytes);
    EXPECT_EQ(model.mesh.positions, (std::vector<float>{0, 0, 0, 1, 1, 0, 2, 4, 0}));
    EXPECT_EQ(model.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(PlyImport, ReadsFacesBeforeVertices) {
  const std::string text = header(Format::ascii, "element face 1\n" + kFaces + "element vertex 4\n" + kXyz) +
                           "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(read(text).mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(PlyImport, ReadsAllEndsOfLines) {
  for (const std::string end : {"\n", "\r\n", "\r"})
    for (const Format format : {Format::ascii, Format::little}) {
      std::string head =
          header(format, "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n");
      for (std::size_t i = head.find('\n'); i != head.npos; i = head.find('\n', i + end.size()))
        head.replace(i, 1, end);
      std::string body;
      for (const int x : {10, 1, 2, 3, 4, 5, 6, 7, 13}) body += value(x, "uchar", format);  // 10 is LF, 13 CR
      EXPECT_EQ(read(head + body).mesh.positions, (std::vector<float>{10, 1, 2, 3, 4, 5, 6, 7, 13}))
          << end.size() << (format == Format::ascii);
    }
}

TEST(PlyImport, WarnsOfUnknownLinesOfHeader) {
  std::string text = square("", {""});
  text.insert(text.find("element"), "Created by a program\n");
  EXPECT_EQ(read(text).warnings,
            std::vector<std::string>{"m.ply: line 3 of the header is left out: it begins with \"Created\""});
}

TEST(PlyImport, KeepsPrecisionFarFromOrigin) {
  ModelFile file(model_picture::kModels + "ply/far_from_origin.ply");
  const Model model = read_ply(file, ModelUse::display);
  // A ball with a radius of 3 m, written in steps of 1 mm.
  const double center[] = {512345.678 - model.origin.x, 5412345.25 - model.origin.y, 431.5 - model.origin.z};
  for (std::size_t i = 0; i < model.mesh.positions.size(); i += 3) {
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) squares += std::pow(model.mesh.positions[i + k] - center[k], 2);
    EXPECT_NEAR(std::sqrt(squares), 3, 0.001) << i;
  }
  const std::string binary = [] {
    std::string bytes =
        header(Format::little, "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n");
    for (const double x : {1e7 + 0.125, 0.0, 0.0, 1e7 + 2.25, 1.0, 0.0})
      bytes += value(x, "double", Format::little);
    return bytes;
  }();
  const Model points = read(binary);
  EXPECT_EQ(points.mesh.positions[3] - points.mesh.positions[0], 2.125f);
  EXPECT_EQ(read(binary, ModelUse::mesh).mesh.positions[0], 1e7f);
  const Model text =
      read(header(Format::ascii, "element vertex 2\n" + kXyz) + "5000000.25 0 0\n5000001.5 1 0\n");
  EXPECT_EQ(text.mesh.positions[3] - text.mesh.positions[0], 1.25f) << "text has more digits than its type";
}

TEST(PlyImport, GivesMeshesNormals) {
  const std::string text = square("", {""}, "element face 1\n" + kFaces, "4 0 1 2 3\n");
  EXPECT_TRUE(read(text).mesh.normals.empty()) << "import_model() generates them for display";
  const Model model = read(text, ModelUse::mesh);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(at(model.mesh.normals, i), (Corner{0, 0, 1}));
}

TEST(PlyImport, NamesWhatIsWrong) {
  const std::string faces = "element face 1\n" + kFaces;
  EXPECT_EQ(message_of(""), "m.ply: the file is empty");
  EXPECT_EQ(message_of("plx\n"), "m.ply:1: not a PLY file: expected \"ply\" in the first line");
  EXPECT_EQ(message_of("ply\nformat ascii 1.0\n"), "m.ply:2: the header ends without \"end_header\"");
  EXPECT_EQ(message_of("ply\nelement vertex 1\nend_header\n"), "m.ply:3: the header has no line \"format\"");
  EXPECT_EQ(message_of("ply\nformat text 1.0\n"),
            "m.ply:2: found format \"text\", expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(message_of("ply\nelement vertex many\n"),
            "m.ply:2: found \"many\", expected the number of elements \"vertex\"");
  EXPECT_EQ(message_of("ply\nproperty float x\n"), "m.ply:2: found a property before the first element");
  EXPECT_EQ(message_of("ply\nelement vertex 1\nproperty half x\n"),
            "m.ply:3: found type \"half\", expected char, uchar, short, ushort, int, uint, float or double");
  EXPECT_EQ(message_of(header(Format::ascii, "element vertex 1\nproperty float x\n") + "1\n"),
            "m.ply:5: the element \"vertex\" has no properties x, y and z");
  EXPECT_EQ(message_of(square("", {""}, faces, "3 0 1 4\n")), "m.ply:14: found vertex 4, the file has 4");
  EXPECT_EQ(message_of(square("", {""}, faces, "3 0 -1 2\n")), "m.ply:14: found vertex -1, the file has 4");
  EXPECT_EQ(message_of(square("", {""}, faces, "3 0 1 x\n")), "m.ply:14: found \"x\", expected an integer");
  EXPECT_EQ(message_of(square("", {""}, faces, "3 0 1\n")),
            "m.ply:15: the file ends before the last element that its header announces");
  EXPECT_EQ(message_of(square("", {""}, "element face 1\nproperty int a\n", "1\n")),
            "m.ply:13: the element \"face\" has no list vertex_indices");
  EXPECT_EQ(message_of(header(Format::ascii, "element vertex 0\n" + kXyz)), "m.ply: holds no vertex");
  EXPECT_EQ(message_of("ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty float x\r\nproperty float "
                       "y\r\nproperty float z\r\nend_header\r\n0 0 0\r\n0 0 x\r\n"),
            "m.ply:9: found \"x\", expected a number");
}

// Counts that the file cannot hold take no memory.
TEST(PlyImport, RejectsHostileCounts) {
  const std::string huge = "4294967290";
  for (const Format format : kFormats) {
    const std::string numbers = value(1, "float", format) + value(2, "float", format);
    EXPECT_NE(message_of(header(format, "element vertex " + huge + "\n" + kXyz) + numbers).find("file ends"),
              std::string::npos);
    std::string faces = header(format, "element vertex 1\n" + kXyz + "element face " + huge +
                                           "\nproperty list uint int vertex_indices\n");
    for (int i = 0; i < 3; ++i) faces += value(1, "float", format);
    EXPECT_NE(message_of(faces).find("file ends"), std::string::npos);
    EXPECT_NE(message_of(faces + value(4e9, "uint", format)).find("found a list of 4000000000 values"),
              std::string::npos);
  }
  EXPECT_NE(message_of(header(Format::ascii, "element vertex 99999999999\n" + kXyz)).find("must be at most"),
            std::string::npos);
  EXPECT_NE(message_of("ply\nelement vertex 99999999999999999999999\n").find("expected the number"),
            std::string::npos);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(PlyImport, StaysWithinMemoryLimit) {
  const auto path =
      std::filesystem::temp_directory_path() / ("hostile" + std::to_string(::getpid()) + ".ply");
  std::ofstream(path, std::ios::binary)
      << header(Format::little, "element vertex 2000000000\n" + kXyz) << std::string(3 << 20, '\0');
  std::string message;
  try {
    import_model(path.string(), ModelUse::display, {.memory_bytes = 64 << 20});
  } catch (const Error& error) {
    message = error.what();
  }
  std::filesystem::remove(path);
  EXPECT_NE(message.find("the file ends before"), std::string::npos) << message;
}
#endif

TEST(PlyImport, ReportsProgress) {
  const auto path =
      std::filesystem::temp_directory_path() / ("progress" + std::to_string(::getpid()) + ".ply");
  constexpr std::size_t kPoints = 500'000;
  std::ofstream(path, std::ios::binary)
      << header(Format::little, "element vertex " + std::to_string(kPoints) + "\n" + kXyz)
      << std::string(12 * kPoints, '\1');
  std::vector<double> shares;
  import_ply(path.string(), ModelUse::display, [&shares](double done) { shares.push_back(done); });
  std::filesystem::remove(path);
  ASSERT_GT(shares.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LE(shares.back(), 1);
}

}  // namespace
}  // namespace tessera::ply_import_test
