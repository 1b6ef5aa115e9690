// Import of STL files, text and binary, whole and damaged.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "engine/program/import/model_file.h"
#include "engine/program/import/stl.h"
#include "tests/engine/program/import/model_picture.h"

namespace tessera::stl_import_test {
using namespace program;
namespace {

using Corner = std::array<float, 3>;
struct Facet {
  Corner normal{};
  std::array<Corner, 3> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  std::uint16_t attribute = 0;
};

std::string binary(const std::vector<Facet>& facets, std::uint32_t count, std::string header = "") {
  header.resize(80, ' ');
  std::string bytes = header;
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Facet& facet : facets) {
    bytes.append(reinterpret_cast<const char*>(&facet.normal), 12);
    bytes.append(reinterpret_cast<const char*>(&facet.corners), 36);
    bytes.append(reinterpret_cast<const char*>(&facet.attribute), 2);
  }
  return bytes;
}

Model read(const std::string& bytes, ModelUse use = ModelUse::display) {
  ModelFile file("m.stl", bytes);
  return read_stl(file, use);
}

std::string message_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

std::array<float, 3> at(const std::vector<float>& values, std::uint32_t index, std::size_t components = 3) {
  const float* const v = &values[components * index];
  return {v[0], v[1], v[2]};
}

constexpr const char* kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 3 0\nendloop\nendfacet\n";

TEST(StlImport, ReadsCapitals) {
  const auto capitals = model_picture::draw_model("stl/upper_case.stl");
  EXPECT_EQ(capitals.rgba, model_picture::draw_model("stl/plain/upper_case.stl").rgba);
  EXPECT_EQ(read("Solid A\nFACET Normal 0 0 1\nOuter LOOP\nVertex 0 0 0\nVERTEX 1 0 0\nvertex 0 1 "
                 "0\nENDLOOP\nEndFacet\nEndSolid A\n")
                .mesh.indices.size(),
            3u);
}

TEST(StlImport, ReadsWhatWritersPutAroundFacets) {
  const std::string facet = kFacet;
  for (const std::string& text :
       {"\n\n; comment\n# another\n\nsolid x\n" + facet + "endsolid x\n", "solid\n" + facet + "endsolid\n",
        "solid facet normal 1 2 3\n" + facet + "endsolid facet\n",
        "\xef\xbb\xbfsolid \xe4\xf6\n" + facet + "endsolid", "solid x\n  // comment\n" + facet, facet,
        "solid empty\nendsolid empty\nsolid x\n" + facet + "endsolid x\ntrailing words\n"}) {
    const Model model = read(text);
    EXPECT_EQ(model.mesh.indices.size(), 3u) << text;
    EXPECT_EQ(model.mesh.vertex_count(), 3u) << text;
    EXPECT_TRUE(model.warnings.empty()) << text;
  }
  std::string carriage_returns = "solid name\n" + facet + "endsolid name\n";
  std::ranges::replace(carriage_returns, '\n', '\r');
  EXPECT_EQ(read(carriage_returns).mesh.indices.size(), 3u);
}

TEST(StlImport, DrawsAllSolids) {
  const std::string solid = std::string("solid a\n") + kFacet + "endsolid a\n";
  std::string moved = solid;
  moved.replace(moved.find("vertex 0 0 0"), 12, "vertex 0 0 7");
  const Model model = read(solid + moved);
  EXPECT_EQ(model.mesh.indices.size(), 6u);
  EXPECT_EQ(model.parts.size(), 1u);
}

TEST(StlImport, DividesLargerLoops) {
  const Model model = read(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid");
  EXPECT_EQ(model.mesh.indices.size(), 6u);
  EXPECT_EQ(model.mesh.vertex_count(), 4u);
}

TEST(StlImport, SkipsTrailingBytes) {
  const auto trailing = model_picture::draw_model("stl/trailing_bytes.stl");
  EXPECT_EQ(trailing.rgba, model_picture::draw_model("stl/plain/trailing_bytes.stl").rgba);
  const Model model = read(binary({Facet{}, Facet{}}, 1));
  EXPECT_EQ(model.mesh.indices.size(), 3u);
  EXPECT_EQ(model.warnings, std::vector<std::string>{"m.stl: 50 bytes after 1 facet are left out"});
}

TEST(StlImport, DrawsWholeFacetsOfFilesWithWrongCount) {
  const std::string two = binary({Facet{}, Facet{}}, 5);
  const Model larger = read(two);
  EXPECT_EQ(larger.mesh.indices.size(), 6u);
  EXPECT_EQ(larger.warnings,
            std::vector<std::string>{"m.stl: counts 5 facets and holds 2 facets, which are drawn"});
  EXPECT_EQ(read(two.substr(0, two.size() - 1)).mesh.indices.size(), 3u) << "a facet is cut off";
  EXPECT_EQ(read(binary({Facet{}, Facet{}}, 0)).mesh.indices.size(), 6u);
  EXPECT_EQ(read(binary({Facet{}}, 0xffffffff)).mesh.indices.size(), 3u);
}

TEST(StlImport, RecognizesBinaryFilesThatBeginWithSolid) {
  for (const std::uint32_t count : {1u, 2u}) {
    EXPECT_EQ(read(binary({Facet{}}, count, "solid made by a program")).mesh.indices.size(), 3u);
    EXPECT_EQ(read(binary({Facet{}}, count, "solid\nfacet normal 0 0 1")).mesh.indices.size(), 3u);
  }
}

TEST(StlImport, DrawsWholeFacetsOfTextThatIsCutOff) {
  const std::string text = std::string("solid x\n") + kFacet + kFacet;
  for (const char* const end : {"endfacet\n", "\nendloop\nendfacet\n", "3 0\nendloop\nendfacet\n", "outer"}) {
    const Model model = read(text.substr(0, text.rfind(end)));
    EXPECT_EQ(model.mesh.indices.size(), 3u) << end;
    EXPECT_EQ(model.warnings.size(), 1u) << end;
  }
}

TEST(StlImport, ReadsColorsOfMagics) {
  ModelFile file(model_picture::kModels + "stl/magics_colors.stl");
  const Model model = read_stl(file, ModelUse::display);
  ASSERT_EQ(model.mesh.indices.size(), 36u);
  EXPECT_TRUE(model.parts.at(0).uses_colors);
  int red = 0;
  for (std::size_t i = 0; i < 36; i += 3) {
    const std::array<float, 3> a = at(model.mesh.positions, model.mesh.indices[i]);
    const std::array<float, 3> b = at(model.mesh.positions, model.mesh.indices[i + 1]);
    const std::array<float, 3> c = at(model.mesh.positions, model.mesh.indices[i + 2]);
    const bool faces_x = a[0] == b[0] && b[0] == c[0];
    red += faces_x ? 1 : 0;
    const std::array<float, 3> expected = faces_x ? Corner{1, 0, 0} : Corner{0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(at(model.mesh.colors, model.mesh.indices[i + k], 4), expected) << i;
  }
  EXPECT_EQ(red, 4);
}

TEST(StlImport, ReadsColorOfWholeObject) {
  Facet facet{.attribute = 0x8000};
  const Model opaque = read(binary({facet}, 1, "made by COLOR=" + std::string("\x33\x66\xff\xff", 4)));
  EXPECT_FALSE(opaque.parts.at(0).uses_colors);
  EXPECT_EQ(opaque.parts[0].material.diffuse.r, 0.2f);
  EXPECT_EQ(opaque.parts[0].material.diffuse.g, 0.4f);
  EXPECT_EQ(opaque.parts[0].material.ambient.b, 1);
  EXPECT_EQ(opaque.parts[0].alpha, ModelAlpha::opaque);
  const Model clear = read(binary({facet}, 1, "COLOR=" + std::string("\x33\x66\xff\x33", 4)));
  EXPECT_EQ(clear.parts[0].material.diffuse.a, 0.2f);
  EXPECT_EQ(clear.parts[0].alpha, ModelAlpha::blend);
  const Model unset = read(binary({facet}, 1, "COLOR=" + std::string("\x33\x66\xff\x00", 4)));
  EXPECT_EQ(unset.parts[0].material.diffuse.a, 1) << "alpha 0 does not hide the object";
}

TEST(StlImport, ReadsColorsOfVisCam) {
  const Facet plain{.attribute = 0x001f};
  EXPECT_TRUE(read(binary({plain}, 1)).mesh.colors.empty()) << "bit 15 is not set";
  const Facet red{.attribute = 0x8000 | 31 << 10};
  const Facet other{.corners = {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}}, .attribute = 0x8000 | 31 << 5 | 31};
  const Model model = read(binary({plain, red, other}, 3));
  ASSERT_EQ(model.mesh.indices.size(), 9u);
  const std::array<Corner, 3> expected = {{{1, 1, 1}, {1, 0, 0}, {0, 1, 1}}};
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_EQ(at(model.mesh.colors, model.mesh.indices[i], 4), expected[i / 3]) << i;
}

// A cube's facet normals are those of its sides, whatever the file says in their direction.
TEST(StlImport, ComputesNormalsOfPlanes) {
  const Model model = read(binary({Facet{.normal = {0.1f, 0, 0.7f}}}, 1));
  for (const std::uint32_t index : model.mesh.indices)
    EXPECT_EQ(at(model.mesh.normals, index), (Corner{0, 0, 1}));
  ModelFile file(model_picture::kModels + "stl/plain/upper_case.stl");
  const Model cube = read_stl(file, ModelUse::mesh);
  EXPECT_EQ(cube.mesh.vertex_count(), 24u) << "corners of a side are shared";
}

TEST(StlImport, WindsFacetsToMatchNormals) {
  const Facet turned{.normal = {0, 0, -1}};
  const Model model = read(binary({turned}, 1));
  EXPECT_EQ(at(model.mesh.normals, 0), (Corner{0, 0, -1}));
  EXPECT_EQ(at(model.mesh.positions, model.mesh.indices[1]), (Corner{0, 1, 0})) << "corners are exchanged";
  const Model unturned = read(binary({Facet{}}, 1));
  EXPECT_EQ(at(unturned.mesh.normals, 0), (Corner{0, 0, 1}));
}

// Two facets that meet at 20 degrees.
TEST(StlImport, IsFlatIfFileHasNormals) {
  const float rise = 0.36f;
  Facet left{.corners = {{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}}};
  Facet right{.corners = {{{0, 0, 0}, {1, 0, rise}, {0, 1, 0}}}};
  EXPECT_EQ(read(binary({left, right}, 2)).mesh.vertex_count(), 4u) << "smooth";
  left.normal = {0, 0, 1};
  EXPECT_EQ(read(binary({left, right}, 2)).mesh.vertex_count(), 6u) << "flat";
}

TEST(StlImport, SharesVerticesOfVeryManyFacets) {
  constexpr int kSide = 800;
  std::vector<Facet> facets;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto corner = [](int i, int j) {
        const auto u = static_cast<float>(i), v = static_cast<float>(j);
        return Corner{u, v, u * u / 100000};
      };
      facets.push_back({{0, 0, 1}, {corner(x, y), corner(x + 1, y), corner(x, y + 1)}});
      facets.push_back({{0, 0, 1}, {corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)}});
    }
  ASSERT_GT(facets.size(), kMaxFlatFacets);
  const Model model = read(binary(facets, static_cast<std::uint32_t>(facets.size())));
  EXPECT_EQ(model.mesh.indices.size(), 3 * facets.size());
  EXPECT_EQ(model.mesh.vertex_count(), (kSide + 1) * std::size_t{kSide + 1});
}

// Text with coordinates that floats round to half a metre.
TEST(StlImport, KeepsPrecisionFarFromOrigin) {
  const std::string text =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 5000000.25 7 0\nvertex 5000001.5 7 0\nvertex 5000000.25 "
      "8.125 0\nendloop\nendfacet\nendsolid";
  const Model model = read(text);
  EXPECT_EQ(model.origin.x, 5000001);
  EXPECT_EQ(at(model.mesh.positions, 0), (Corner{-0.75f, -1, 0}));
  EXPECT_EQ(at(model.mesh.positions, 1), (Corner{0.5f, -1, 0}));
  const Model as_mesh = read(text, ModelUse::mesh);
  EXPECT_EQ(as_mesh.origin.x, 0);
  EXPECT_EQ(as_mesh.mesh.positions[0], 5000000.25f);
}

TEST(StlImport, NamesWhatIsWrong) {
  EXPECT_EQ(message_of(""), "m.stl: the file is empty");
  EXPECT_EQ(message_of("solid x\nendsolid x\n"), "m.stl: holds no triangle: expected facets after \"solid\"");
  EXPECT_EQ(message_of("solid x\nfacet normal 0 0 1\n outer loop\n  vertex 0 O 0\n"),
            "m.stl:4: found \"O\", expected a number");
  EXPECT_EQ(message_of("solid x\nfacet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n"),
            "m.stl:5: the facet has 2 vertices, expected 3");
  EXPECT_EQ(message_of("solid x\nface normal 0 0 1\n"),
            "m.stl:2: found \"face\", expected \"facet\" or \"endsolid\"");
  EXPECT_EQ(message_of(std::string("solid x\n") + kFacet + "\nfacet\nouter lop\n"),
            "m.stl:11: found \"lop\", expected \"normal\", \"outer loop\", \"vertex\", \"endloop\" or "
            "\"endfacet\"");
  EXPECT_EQ(
      message_of(std::string(60, '\0')),
      "m.stl: byte 0: the file has 60 bytes; expected \"solid\", or a header of 80 bytes and the number of "
      "facets");
  EXPECT_EQ(message_of("solid " + std::string(100000, 'x')),
            "m.stl: holds no triangle: expected facets after "
            "\"solid\"");
  EXPECT_EQ(message_of("solid x\nfacet normal " + std::string(100000, '1')),
            "m.stl:2: found a word of more than 65536 bytes");
}

}  // namespace
}  // namespace tessera::stl_import_test
