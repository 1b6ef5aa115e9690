// 3MF packages: what their resources, components and properties mean, and broken ones.
#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/engine/program/import/model_picture.h"
#include "tests/engine/program/import/threemf_folder.h"

namespace tessera::threemf_import_test {
using namespace program;
using namespace model_picture;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ThreemfImport : public ThreemfFolder {};

std::string file_content(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Positions of the model's triangles, corner by corner.
std::vector<std::array<float, 3>> corners_of(const Model& model) {
  std::vector<std::array<float, 3>> corners;
  for (const std::uint32_t i : model.mesh.indices)
    corners.push_back(
        {model.mesh.positions[3 * i], model.mesh.positions[3 * i + 1], model.mesh.positions[3 * i + 2]});
  return corners;
}

std::array<float, 4> color_at(const Model& model, std::size_t corner) {
  const std::size_t i = 4 * std::size_t{model.mesh.indices[corner]};
  return {model.mesh.colors[i], model.mesh.colors[i + 1], model.mesh.colors[i + 2], model.mesh.colors[i + 3]};
}

// The twins are OBJ files of the same box.
TEST_F(ThreemfImport, FilesEqualTheirPlainTwins) {
  const Picture red = draw_model("threemf/plain/red_box.obj");
  EXPECT_EQ(draw_model("threemf/color_group.3mf").rgba, red.rgba);
  EXPECT_EQ(draw_model("threemf/zip64.3mf").rgba, red.rgba);
  EXPECT_EQ(draw_model("threemf/thumbnail.3mf").rgba, draw_model("threemf/plain/box.obj").rgba);
  EXPECT_GT(count_pixels(red, [](Pixel p) { return p[0] > 60 && p[1] == 0 && p[2] == 0; }), 3000);
}

// x' = x m00 + y m10 + z m20 + m30: first the component's transform, then the item's.
TEST_F(ThreemfImport, ComponentsAndItemsAreTransformed) {
  const std::string assembly =
      "<object id=\"2\"><components><component objectid=\"1\" transform=\"0 2 0 -2 0 0 0 0 2 1 0 0\"/>"
      "<component objectid=\"1\"/></components></object>";
  const Model model = model_of(triangle("id=\"1\"") + assembly,
                               "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 10 20 30\"/>");
  EXPECT_THAT(corners_of(model),
              ElementsAre(ElementsAre(11, 20, 30), ElementsAre(11, 22, 30), ElementsAre(9, 20, 30),
                          ElementsAre(10, 20, 30), ElementsAre(11, 20, 30), ElementsAre(10, 21, 30)));
}

TEST_F(ThreemfImport, MirroredObjectsKeepTheirOutsideOut) {
  const Model model =
      model_of(triangle("id=\"1\""), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>");
  EXPECT_THAT(corners_of(model),
              ElementsAre(ElementsAre(0, 0, 0), ElementsAre(0, 1, 0), ElementsAre(-1, 0, 0)));
}

TEST_F(ThreemfImport, BaseMaterialsBecomeParts) {
  const std::string materials =
      "<basematerials id=\"5\"><base name=\"Red\" displaycolor=\"#FF0000\"/>"
      "<base name=\"Glass\" displaycolor=\"#00FF0080\"/></basematerials>";
  const Model model = model_of(
      materials + triangle("id=\"1\" pid=\"5\" pindex=\"0\"") + triangle("id=\"2\"", "pid=\"5\" p1=\"1\""),
      "<item objectid=\"1\"/><item objectid=\"2\"/>");
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.parts[0].material_name, "Red");
  EXPECT_THAT(model.parts[0].material.diffuse, testing::FieldsAre(1, 0, 0, 1));
  EXPECT_EQ(model.parts[1].material_name, "Glass");
  EXPECT_THAT(model.parts[1].material.diffuse, testing::FieldsAre(0, 1, 0, 128.0f / 255));
  EXPECT_EQ(model.parts[1].alpha, ModelAlpha::blend);
}

TEST_F(ThreemfImport, ColorGroupsGiveEachCornerItsColor) {
  const std::string colors =
      "<m:colorgroup id=\"5\"><m:color color=\"#FF0000\"/><m:color color=\"#00FF00\"/>"
      "<m:color color=\"#0000FF33\"/></m:colorgroup>";
  const Model model = model_of(colors + triangle("id=\"1\"", "pid=\"5\" p1=\"2\" p2=\"0\" p3=\"1\""));
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_TRUE(model.parts[0].uses_colors);
  EXPECT_THAT(color_at(model, 0), ElementsAre(0, 0, 1, 0.2f));
  EXPECT_THAT(color_at(model, 1), ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(color_at(model, 2), ElementsAre(0, 1, 0, 1));
}

// Composite: 0.25 of red and 0.75 of blue. The layers' first one is the composite.
TEST_F(ThreemfImport, CompositesAreMixedAndFirstLayersDrawn) {
  const std::string properties =
      "<basematerials id=\"5\"><base name=\"r\" displaycolor=\"#FF0000\"/>"
      "<base name=\"b\" displaycolor=\"#0000FF\"/></basematerials>"
      "<m:compositematerials id=\"6\" matid=\"5\" matindices=\"0 1\"><m:composite values=\"1 0\"/>"
      "<m:composite values=\"0.25 0.75\"/></m:compositematerials>"
      "<m:multiproperties id=\"7\" pids=\"6 5\"><m:multi pindices=\"1 0\"/></m:multiproperties>";
  for (const char* const use : {"pid=\"6\" p1=\"1\"", "pid=\"7\" p1=\"0\""})
    EXPECT_THAT(color_at(model_of(properties + triangle("id=\"1\"", use)), 0),
                ElementsAre(0.25f, 0, 0.75f, 1))
        << use;
}

TEST_F(ThreemfImport, TexturesComeFromThePackage) {
  const std::string texture =
      "<m:texture2d id=\"4\" path=\"/3D/Textures/check.png\" contenttype=\"image/png\" tilestyleu=\"mirror\" "
      "tilestylev=\"clamp\" filter=\"nearest\"/><m:texture2dgroup id=\"5\" texid=\"4\"><m:tex2coord u=\"0\" "
      "v=\"0.5\"/><m:tex2coord u=\"1\" v=\"2\"/></m:texture2dgroup>";
  const std::string resources = texture + triangle("id=\"1\"", "pid=\"5\" p1=\"1\" p2=\"0\" p3=\"0\"");
  // The name in the archive differs in the case of letters.
  const Model model =
      model_of(resources, kItem, {{"3d/textures/Check.PNG", file_content(kModels + "gltf/check.png")}});
  EXPECT_THAT(model.warnings, IsEmpty());
  ASSERT_TRUE(model.parts[0].texture);
  const ModelTexture& used = model.textures[*model.parts[0].texture];
  EXPECT_EQ(used.sampler.wrap_s, TextureWrap::mirrored_repeat);
  EXPECT_EQ(used.sampler.wrap_t, TextureWrap::clamp_to_edge);
  EXPECT_EQ(used.sampler.mag, TextureFilter::nearest);
  EXPECT_GT(model.images[used.image].width, 0);
  const std::size_t first = 2 * std::size_t{model.mesh.indices[0]};
  EXPECT_EQ(model.mesh.texcoords[first], 1);
  EXPECT_EQ(model.mesh.texcoords[first + 1], 2);

  const Model without = model_of(resources);
  EXPECT_FALSE(without.parts[0].texture);
  EXPECT_THAT(without.warnings, ElementsAre(HasSubstr("lacks the image \"/3D/Textures/check.png\"")));
}

TEST_F(ThreemfImport, ObjectsOfOtherModelPartsAreRead) {
  const std::string other = "<model><resources>" + triangle("id=\"1\"") + "</resources></model>";
  const Model model = model_of(
      "<object id=\"8\"><components><component p:path=\"/3D/Objects/o.model\" "
      "objectid=\"1\"/></components></object>",
      "<item objectid=\"8\"/><item p:path=\"/3D/Objects/o.model\" objectid=\"1\"/>",
      {{"3D/Objects/o.model", other}});
  EXPECT_EQ(model.mesh.indices.size(), 6u);
}

TEST_F(ThreemfImport, UndefinedPropertiesAndUnreadExtensionsAreWarnings) {
  EXPECT_THAT(model_of(triangle("id=\"1\" pid=\"5\" pindex=\"0\"")).warnings,
              ElementsAre(HasSubstr("properties that are not defined")));
  const std::string path =
      write_package(triangle("id=\"1\""), kItem, {},
                    "requiredextensions=\"b m\" xmlns:b=\"http://example.org/beams\" "
                    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\"");
  EXPECT_THAT(import_model(path).warnings,
              ElementsAre(HasSubstr("requires the extension http://example.org/beams")));
}

TEST_F(ThreemfImport, MistakesAreErrorsOfOneLine) {
  const std::string valid = triangle("id=\"1\"");
  const std::string cycle = "<object id=\"1\"><components><component objectid=\"1\"/></components></object>";
  const auto error_of = [&](const std::string& resources, const std::string& items = kItem) {
    return message_of(write_package(resources, items));
  };
  EXPECT_THAT(error_of(valid, "<item objectid=\"9\"/>"), HasSubstr("has no object with the id \"9\""));
  EXPECT_THAT(error_of(valid, "<item/>"), HasSubstr("lacks the attribute \"objectid\""));
  EXPECT_THAT(error_of(valid, ""), HasSubstr("holds no triangle"));
  EXPECT_THAT(error_of(cycle), HasSubstr("nested deeper than 500 levels"));
  EXPECT_THAT(error_of(valid, "<item objectid=\"1\" transform=\"1 0 0\"/>"),
              HasSubstr("expected 12 finite numbers"));
  EXPECT_THAT(
      error_of(
          "<object id=\"1\"><mesh><vertices><vertex x=\"a\" y=\"0\" z=\"0\"/></vertices></mesh></object>"),
      HasSubstr("has the x \"a\", expected a finite number"));
  EXPECT_THAT(error_of("<object id=\"1\"><mesh><vertices/><triangles><triangle v1=\"0\" v2=\"1\" "
                       "v3=\"2\"/></triangles></mesh></object>"),
              HasSubstr("refers to vertex 0, there are 0"));
  EXPECT_THAT(error_of("<basematerials id=\"5\"><base displaycolor=\"red\"/></basematerials>"),
              HasSubstr("\"red\", expected #RRGGBB or #RRGGBBAA"));
  EXPECT_THAT(error_of("<basematerials id=\"5\"><base displaycolor=\"#\x01\n0000\"/></basematerials>"),
              HasSubstr("\"#??0000\", expected #RRGGBB"));
  EXPECT_THAT(error_of("<object"), HasSubstr("\"/3D/m.model\" is not XML"));
  EXPECT_THAT(message_of(write_archive({{"a", "b"}})), HasSubstr("lacks \"_rels/.rels\""));
  EXPECT_THAT(message_of(write_archive({{"_rels/.rels", "<Relationships/>"}})),
              HasSubstr("names no 3D model"));
  EXPECT_THAT(message_of(write_archive({{"_rels/.rels", kRelationships}})),
              HasSubstr("lacks the model part \"/3D/m.model\""));
  std::ofstream(folder_ / "text.3mf") << "not an archive";
  EXPECT_THAT(message_of((folder_ / "text.3mf").string()), HasSubstr("is not a ZIP archive"));
}

// Flips each byte of an archive: a picture or an error, never a crash.
TEST_F(ThreemfImport, DamagedArchivesAreReadOrRefused) {
  const std::string archive = file_content(kModels + "threemf/color_group.3mf");
  const std::string path = (folder_ / "damaged.3mf").string();
  int refused = 0;
  for (std::size_t at = 0; at < archive.size(); at += 7) {
    std::string damaged = archive;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    std::ofstream(path, std::ios::binary) << damaged;
    const std::string message = message_of(path);
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
    EXPECT_THAT(message, testing::Not(HasSubstr("crashed"))) << "byte " << at;
    refused += message == "(no error)" ? 0 : 1;
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace tessera::threemf_import_test
