// Names of pictures, and the files that pictures may replace.
#ifdef TESSERA_PROGRAM
#include <filesystem>
#include <string>

#include "tests/engine/program/program.h"

namespace tessera::file_guard_test {
namespace {

namespace fs = std::filesystem;

class RenderOutput : public Program {
 protected:
  static constexpr const char* kScene =
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "pot.png"}}})";

  void expect_refused(const std::string& arguments, const std::string& message) const {
    const Result result = run("render " + arguments);
    EXPECT_EQ(result.code, 1) << arguments;
    EXPECT_EQ(result.err, "tessera: error: the picture " + message + "; name another file with -o\n");
  }
};

TEST_F(RenderOutput, DefaultNameReplacesEarlierPictureAndNoTexture) {
  write("pot.mtl", "newmtl a\nmap_Kd pot.png\n");
  write("pot.obj", "mtllib pot.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  write("pot.png", "a texture");
  for (int repetition = 0; repetition < 2; ++repetition) {
    const Result one = run("render pot.obj --size 8x8");
    const Result two = run("render pot.obj --size 8x8 --turntable 2");
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_TRUE(contains(one.err, "tessera: wrote pot.render.png\n")) << one.err;
    EXPECT_EQ(two.code, 0) << two.err;
  }
  for (const char* name : {"pot.render.png", "pot.render_0000.png", "pot.render_0001.png"})
    EXPECT_TRUE(content(name).starts_with("\x89PNG")) << name;
  EXPECT_EQ(content("pot.png"), "a texture");
}

TEST_F(RenderOutput, NamedPictureReplacesAnyOtherFile) {
  ASSERT_EQ(run("render --size 8x8 -o pot.png").code, 0);
  write("pot.json", kScene);
  EXPECT_EQ(run("render pot.json -o pot.png").code, 0);
}

TEST_F(RenderOutput, RefusesToOverwriteInput) {
  ASSERT_EQ(run("render --size 8x8 -o pot.png").code, 0);
  write("pot.json", kScene);
  fs::create_symlink("pot.json", folder_ / "symbolic.ppm");
  fs::create_hard_link(folder_ / "pot.json", folder_ / "hard.ppm");
  for (const std::string picture : {"pot.json", "./pot.json", "symbolic.ppm", "hard.ppm"})
    expect_refused("pot.json -o " + picture, "\"" + picture + "\" would overwrite the input \"pot.json\"");
  EXPECT_EQ(content("pot.json"), kScene);
}

TEST_F(RenderOutput, RefusesToOverwriteReference) {
  for (const char* name : {"tessera.png", "f_0001.ppm"})
    ASSERT_EQ(run("render --size 8x8 -o " + std::string(name)).code, 0);
  const std::string png = content("tessera.png");
  const std::string ppm = content("f_0001.ppm");
  expect_refused("--light 1,0,0,0 --size 8x8 --compare ./tessera.png",
                 "\"tessera.png\" would overwrite the reference \"./tessera.png\"");
  expect_refused("--light 1,0,0,0 --size 8x8 --frames 3 -o 'f_{frame}.ppm' --compare f_0001.ppm",
                 "\"f_0001.ppm\" would overwrite the reference \"f_0001.ppm\"");
  EXPECT_FALSE(exists("f_0000.ppm")) << "refused before rendering";
  EXPECT_TRUE(content("tessera.png") == png && content("f_0001.ppm") == ppm);
}

}  // namespace
}  // namespace tessera::file_guard_test
#endif
