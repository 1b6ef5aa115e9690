// Materials of OBJ models: highlights, transparency, and textures with their options.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/engine/program/import/model_picture.h"
#include "tests/engine/program/import/obj_folder.h"

namespace tessera::obj_materials_test {
using namespace program;
namespace {

class ObjMaterials : public ObjFolder {};

/// Opacity of each part.
std::vector<float> alphas(const Model& model) {
  std::vector<float> found;
  for (const ModelPart& part : model.parts) {
    found.push_back(part.material.diffuse.a);
    EXPECT_EQ(part.alpha, part.material.diffuse.a < 1 ? ModelAlpha::blend : ModelAlpha::opaque);
  }
  return found;
}

/// The only image that import_obj() names for an MTL file: read for ModelUse::mesh, which decodes none.
class NamedTexture {
 public:
  explicit NamedTexture(Model&& model) : model_(std::move(model)) {
    EXPECT_EQ(model_.images.size(), 1u);
    EXPECT_EQ(model_.textures.size(), 1u);
    EXPECT_EQ(model_.parts.at(0).texture, 0u);
  }
  const ModelImage& image() const { return model_.images.at(0); }
  const TextureSampler& sampler() const { return model_.textures.at(0).sampler; }

 private:
  Model model_;
};

TEST_F(ObjMaterials, NoShininessMeansNoHighlight) {
  const Model model = shown_with(
      "newmtl zero\nKs 1 1 1\nNs 0\nillum 2\nnewmtl missing\nKs 1 1 1\nillum 2\nnewmtl negative\nKs 1 1 "
      "1\nNs -5\n"
      "newmtl shiny\nKs 1 1 1\nNs 20\n",
      {"zero", "missing", "negative", "shiny"});
  ASSERT_EQ(model.parts.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(model.parts[i].material.specular.r, 0) << i;
  EXPECT_EQ(model.parts[3].material.specular.r, 1);
}

TEST_F(ObjMaterials, DissolveIsOpacity) {
  EXPECT_EQ(
      alphas(shown_with("newmtl a\nd 0.25\nnewmtl b\nd 1\nnewmtl c\nd -halo 0.5\nnewmtl e\nnewmtl f\nd 7\n",
                        {"a", "b", "c", "e", "f"})),
      (std::vector<float>{0.25f, 1, 0.5f, 1, 1}));
}

TEST_F(ObjMaterials, TrIsTransparency) {
  EXPECT_EQ(alphas(shown_with("newmtl glass\nTr 0.75\nnewmtl wall\nTr 0\n", {"glass", "wall"})),
            (std::vector<float>{0.25f, 1}));
  EXPECT_EQ(alphas(shown_with("newmtl hidden\nTr 1\nnewmtl wall\nTr 0\n", {"hidden", "wall"})),
            (std::vector<float>{0, 1}));
}

TEST_F(ObjMaterials, DissolveOutranksTr) {
  EXPECT_EQ(alphas(shown_with("newmtl a\nd 0.5\nTr 1\nnewmtl b\nTr 1\nd 1\n", {"a", "b"})),
            (std::vector<float>{0.5f, 1}));
}

// MeshLab writes the opacity as Tr.
TEST_F(ObjMaterials, TrIsOpacityInFilesWhereOpaqueIsOne) {
  EXPECT_EQ(alphas(shown_with("newmtl a\nTr 1.000000\n")), (std::vector<float>{1}));
  EXPECT_EQ(alphas(shown_with("newmtl wall\nTr 1\nnewmtl glass\nTr 0.25\n", {"wall", "glass"})),
            (std::vector<float>{1, 0.25f}));
}

TEST_F(ObjMaterials, InvisibleModelsAreDrawnOpaque) {
  const Model all = shown_with("newmtl a\nd 0\nnewmtl b\nd 0\nnewmtl unused\nd 1\n", {"a", "b"});
  EXPECT_EQ(alphas(all), (std::vector<float>{1, 1}));
  ASSERT_EQ(all.warnings.size(), 1u);
  EXPECT_NE(all.warnings[0].find("opacity of all materials is 0"), std::string::npos);
  const Model colored = shown("mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  EXPECT_EQ(alphas(colored), (std::vector<float>{1}));
  EXPECT_EQ(colored.mesh.colors.at(3), 1);
  EXPECT_EQ(alphas(shown_with("newmtl a\nd 0\nnewmtl b\nd 0.5\n", {"a", "b"})),
            (std::vector<float>{0, 0.5f}));
}

TEST_F(ObjMaterials, MapsNameImages) {
  const struct {
    std::string map, name;
    bool is_clamped = false;
  } kMaps[] = {
      {"map_Kd t.png", "t.png"},
      {"map_Kd my texture (1).png  ", "my texture (1).png"},
      {"map_Kd tex\\sub\\t.png", "tex\\sub\\t.png"},
      {"map_Kd C:\\tex\\a b.jpg", "C:\\tex\\a b.jpg"},
      {"map_kd t.png", "t.png"},
      {"\tmap_Kd\t-clamp on t.png", "t.png", true},
      {"map_Kd -clamp off t.png", "t.png"},
      {"map_Kd -s 1 1 1 -o 0 0 0 t.png", "t.png"},
      {"map_Kd -blendu off -blendv on -bm 0.5 -boost 2 -cc on -imfchan m -mm 0 1 -texres 512 -type sphere "
       "-t 1 1 -clamp on 2 b.png",
       "2 b.png", true},
      {"map_Kd -s 2 2 7", "7"}};
  for (const auto& [map, name, is_clamped] : kMaps) {
    write("m.mtl", "newmtl a\nmap_Ka other.png\n" + map + "\n");
    const NamedTexture texture(mesh_of(std::string("mtllib m.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n"));
    EXPECT_EQ(texture.image().name, name) << map;
    EXPECT_EQ(texture.sampler().wrap_s, is_clamped ? TextureWrap::clamp_to_edge : TextureWrap::repeat) << map;
    EXPECT_EQ(texture.sampler().wrap_t, texture.sampler().wrap_s) << map;
  }
}

TEST_F(ObjMaterials, OpacityMapsJoinTheTexture) {
  const auto texture_of = [this](const std::string& maps) {
    write("m.mtl", "newmtl a\n" + maps);
    return NamedTexture(mesh_of(std::string("mtllib m.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n"));
  };
  const NamedTexture both = texture_of("map_d leaf alpha.png\nmap_Kd leaf.png\n");
  EXPECT_EQ(both.image().name, "leaf.png");
  EXPECT_EQ(both.image().alpha_name, "leaf alpha.png");
  const NamedTexture alone = texture_of("map_d -clamp on leaf.png\n");
  EXPECT_EQ(alone.image().name, "");
  EXPECT_EQ(alone.image().alpha_name, "leaf.png");
  EXPECT_EQ(alone.sampler().wrap_s, TextureWrap::clamp_to_edge);
}

TEST_F(ObjMaterials, OpacityMapsBlend) {
  write("white.ppm", "P6\n1 1\n255\n\xff\xff\xff");
  EXPECT_EQ(shown_with("newmtl a\nmap_d white.ppm\n").parts[0].alpha, ModelAlpha::blend);
  EXPECT_EQ(shown_with("newmtl a\nmap_Kd white.ppm\n").parts[0].alpha, ModelAlpha::opaque);
}

TEST_F(ObjMaterials, OpacityMapsAreDecoded) {
  write("color.ppm", std::string("P6\n2 1\n255\n\x10\x20\x30\x40\x50\x60"));
  write("alpha.ppm", std::string("P6\n2 1\n255\n\xff\xff\xff\x80\x80\x80"));
  const auto pixels = [this](const std::string& maps) {
    return shown_with("newmtl a\n" + maps).images.at(0).pixels;
  };
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(pixels("map_Kd color.ppm\nmap_d alpha.ppm\n"), (Bytes{16, 32, 48, 255, 64, 80, 96, 128}));
  EXPECT_EQ(pixels("map_d alpha.ppm\n"), (Bytes{255, 255, 255, 255, 255, 255, 255, 128}));
  EXPECT_EQ(pixels("map_Kd color.ppm\nmap_d nowhere.ppm\n"), (Bytes{16, 32, 48, 255, 64, 80, 96, 255}));
  const Model none = shown_with("newmtl a\nmap_d nowhere.ppm\n");
  EXPECT_FALSE(none.parts.at(0).texture);
  EXPECT_EQ(none.warnings.size(), 1u);
}

// Alpha that is given twice is not squared.
TEST_F(ObjMaterials, OneFileMayBeColorAndOpacity) {
  // Uncompressed TGA of one pixel: blue, green, red, alpha.
  std::string tga(18, '\0');
  tga[2] = 2, tga[12] = 1, tga[14] = 1, tga[16] = 32, tga[17] = 0x28;
  write("leaf.tga", tga + "\x50\x50\x50\x80");
  const Model model = shown_with("newmtl a\nmap_Kd leaf.tga\nmap_d leaf.tga\n");
  EXPECT_EQ(model.images.at(0).pixels.at(3), 0x80);
  EXPECT_EQ(model.parts.at(0).alpha, ModelAlpha::blend);
}

// 0 0 is the lower left corner of an image.
TEST_F(ObjMaterials, ImagesStandUpright) {
  write("t.ppm", std::string("P6\n2 2\n255\n\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 23));
  write("m.mtl", "newmtl a\nmap_Kd t.ppm\n");
  const Model model = shown(
      "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
      "vt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n");
  const Picture picture = model_picture::draw(model_scene(model, "m.obj", 240, 180));
  const auto main_component = [&](int x, int y) {
    const model_picture::Pixel p = model_picture::pixel(picture, x, y);
    return std::ranges::max_element(p) - p.begin();
  };
  EXPECT_EQ(main_component(85, 55), 0) << "red, upper left";
  EXPECT_EQ(main_component(155, 55), 1) << "green, upper right";
  EXPECT_EQ(main_component(85, 115), 2) << "blue, lower left";
}

TEST_F(ObjMaterials, MaterialsShareImages) {
  write("m.mtl", "newmtl a\nmap_Kd t.png\nnewmtl b\nmap_Kd t.png\nnewmtl c\nmap_Kd -clamp on t.png\n");
  const Model model = mesh_of(std::string("mtllib m.mtl\n") + kTriangle +
                              "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
  EXPECT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.textures.size(), 2u);
  EXPECT_EQ(model.parts[0].texture, model.parts[1].texture);
  EXPECT_NE(model.parts[0].texture, model.parts[2].texture);
}

TEST_F(ObjMaterials, ImagesAreRelativeToTheMaterialFile) {
  std::filesystem::create_directories(folder_ / "sub");
  write("sub/m.mtl", "newmtl a\nmap_Kd t.png\n");
  const NamedTexture texture(mesh_of(std::string("mtllib sub/m.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n"));
  EXPECT_EQ(texture.image().name, "sub/t.png");
}

TEST_F(ObjMaterials, ScaleAndOffsetChangeTextureCoordinates) {
  write("t.ppm", "P6\n1 1\n255\nabc");
  const auto texcoords = [this](const std::string& options) {
    return shown_with("newmtl a\nmap_Kd " + options + " t.ppm\n").mesh.texcoords;
  };
  EXPECT_EQ(texcoords(""), (std::vector<float>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(texcoords("-s 2 3"), (std::vector<float>{0, 0, 2, 0, 0, 3}));
  EXPECT_EQ(texcoords("-s 2"), (std::vector<float>{0, 0, 2, 0, 0, 1}));
  EXPECT_EQ(texcoords("-o 0.5 -0.25 0"), (std::vector<float>{0.5f, -0.25f, 1.5f, -0.25f, 0.5f, 0.75f}));
  EXPECT_EQ(texcoords("-o 0.5 -s 2 2 1"), (std::vector<float>{0.5f, 0, 2.5f, 0, 0.5f, 2}));
}

TEST_F(ObjMaterials, BlackOrMissingDiffuseIsWhiteUnderATexture) {
  write("t.ppm", "P6\n1 1\n255\nabc");
  const Model model = shown_with(
      "newmtl black\nKa 0 0 0\nKd 0 0 0\nmap_Kd t.ppm\nnewmtl missing\nmap_Kd t.ppm\n"
      "newmtl half\nKa 0 0 0\nKd 0.5 0.5 0.5\nmap_Kd t.ppm\nnewmtl plain\nKd 0 0 0\n",
      {"black", "missing", "half", "plain"});
  ASSERT_EQ(model.parts.size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(model.parts[i].material.diffuse.g, 1) << i;
    EXPECT_EQ(model.parts[i].material.ambient.g, 1) << i;
    EXPECT_TRUE(model.parts[i].texture) << i;
  }
  EXPECT_EQ(model.parts[2].material.diffuse.g, 0.5f);
  EXPECT_EQ(model.parts[2].material.ambient.g, 0);
  EXPECT_EQ(model.parts[3].material.diffuse.g, 0);
}

TEST_F(ObjMaterials, MissingImagesLeaveTheColor) {
  const Model model = shown_with(
      "newmtl a\nKd 0 0 0\nmap_Kd nowhere.png\nnewmtl b\nKd 0.5 0 0\nmap_Kd nowhere.png\n", {"a", "b"});
  EXPECT_FALSE(model.parts.at(0).texture);
  EXPECT_EQ(model.parts.at(0).material.diffuse.r, 1);
  EXPECT_EQ(model.parts.at(1).material.diffuse.r, 0.5f);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("nowhere.png"), std::string::npos) << model.warnings[0];
}

TEST_F(ObjMaterials, WarnsOfTexturesWithoutCoordinates) {
  write("t.ppm", "P6\n1 1\n255\nabc");
  write("m.mtl", "newmtl a\nmap_Kd t.ppm\nnewmtl b\n");
  const std::string begin = std::string("mtllib m.mtl\n") + kTriangle + "vt 1 1\nusemtl a\n";
  for (const char* faces : {"f 1 2 3\n", "f 1/1 2/1 3\n"}) {
    const Model model = shown(begin + faces);
    ASSERT_EQ(model.warnings.size(), 1u) << faces;
    EXPECT_NE(model.warnings[0].find("have no texture coordinates"), std::string::npos) << faces;
    EXPECT_EQ(model.mesh.texcoords.size(), 6u) << faces;
  }
  EXPECT_TRUE(shown(begin + "f 1/1 2/1 3/1\nusemtl b\nf 1 2 3\n").warnings.empty());
}

TEST_F(ObjMaterials, UndefinedMaterialsCountAsNone) {
  write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n");
  const Model model = shown(std::string(kTriangle) + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nmtllib m.mtl\n");
  EXPECT_EQ(model.parts.at(0).material.diffuse.r, 1) << "the first definition counts, wherever mtllib stands";
  EXPECT_EQ(model.parts.at(1).material_name, "");
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("material \"b\" is not defined"), std::string::npos);
}

}  // namespace
}  // namespace tessera::obj_materials_test
