// Image files that models name.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <unistd.h>

#include "engine/program/imageio/picture.h"
#include "engine/program/import/model_images.h"

namespace tessera::model_images_test {
using namespace program;
namespace {

namespace fs = std::filesystem;

class ModelImages : public testing::Test {
 protected:
  ModelImages()
      : folder_(fs::temp_directory_path() / ("tessera_model_images_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "models");
    fs::create_directories(folder_ / "images");
  }
  ~ModelImages() override { fs::remove_all(folder_); }

  void write_image(const std::string& file) const {
    Picture picture(1, 1);
    picture.rgba = {7, 8, 9, 255};
    write_picture(picture, (folder_ / file).string());
  }

  /// Decodes an image that models/ship.md2 names. Returns the warning; empty: it was found.
  std::string warning_of(const std::string& name) const {
    Model model;
    model.images = {ModelImage{.name = name}};
    model.textures = {{}};
    model.parts = {ModelPart{.texture = 0}};
    decode_images((folder_ / "models" / "ship.md2").string(), model);
    const std::vector<std::uint8_t> pixel{7, 8, 9, 255};
    EXPECT_TRUE(!model.warnings.empty() || model.images[0].pixels == pixel);
    return model.warnings.empty() ? "" : model.warnings[0];
  }

  fs::path folder_;
};

TEST_F(ModelImages, FindsFilesByTheirNames) {
  write_image("models/Hull.PPM");
  for (const char* name : {"Hull.PPM", "hull.ppm", "C:\\art\\hull.ppm", "/home/art/Hull.PPM", "art/Hull.PPM"})
    EXPECT_EQ(warning_of(name), "") << name;
  EXPECT_NE(warning_of("hulls.ppm"), "");
}

TEST_F(ModelImages, FindsFilesOfOtherFolders) {
  write_image("images/Hull.ppm");
  for (const char* name : {"../images/Hull.ppm", "..\\images\\hull.ppm", "\\..\\images\\HULL.ppm"})
    EXPECT_EQ(warning_of(name), "") << name;
}

TEST_F(ModelImages, PictureWithoutANameHasThatOfTheModel) {
  EXPECT_NE(warning_of("$texture_dummy.ppm"), "");
  write_image("models/ship.ppm");
  EXPECT_EQ(warning_of("$texture_dummy.ppm"), "");
}

}  // namespace
}  // namespace tessera::model_images_test
