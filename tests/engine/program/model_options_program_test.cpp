// Options of `tessera render` for models and scenes: samples, background, edges, axes, turns, standard input.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "tests/engine/program/program.h"

namespace tessera::model_options_program_test {
namespace {

using program::Picture;
using program::read_picture;

const std::string kBunny = "/usr/share/glmark2/models/bunny.obj";
const std::string kModels = TESSERA_SOURCE_DIR "/tests/models/gltf/";

class ModelOptions : public Program {
 protected:
  /// Runs `tessera render` and reads the picture.
  Picture render(const std::string& arguments) const {
    const Result result = run("render " + arguments + " -o out.png --size 120x90");
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err;
    return read_picture(path("out.png"));
  }
  void expect_one_error(const std::string& arguments, int code, const std::string& fragment) const {
    const Result result = run("render " + arguments);
    EXPECT_EQ(result.code, code) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
};

std::uint8_t alpha_at(const Picture& picture, int x, int y) {
  return picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x)) +
                      3];
}

TEST_F(ModelOptions, PicturesWithoutBackgroundHaveAlpha) {
  const Picture plain = render(kBunny), clear = render(kBunny + " --background none");
  EXPECT_EQ(plain.channels, 3);
  ASSERT_EQ(clear.channels, 4);
  EXPECT_EQ(alpha_at(clear, 0, 0), 0);
  EXPECT_EQ(alpha_at(clear, 60, 50), 255);
  // Where the model is, both show the same.
  for (std::size_t i = 0; i < plain.rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3 && clear.rgba[i + 3] == 255; ++c)
      ASSERT_EQ(clear.rgba[i + c], plain.rgba[i + c]);
}

TEST_F(ModelOptions, AlphaOfEdgesAndPanesIsTheCoveredShare) {
  // Over any background B, colour * alpha + B (1 - alpha) is the picture with that background.
  for (const std::string& model : {kBunny + " --samples 4", kModels + "blended_window.gltf"}) {
    const Picture clear = render(model + " --background none"),
                  white = render(model + " --background '#ffffff'");
    int partial = 0;
    for (std::size_t i = 0; i < clear.rgba.size(); i += 4) {
      const double alpha = clear.rgba[i + 3] / 255.0;
      partial += alpha > 0 && alpha < 1 ? 1 : 0;
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(clear.rgba[i + c] * alpha + 255 * (1 - alpha), white.rgba[i + c], 2) << model << " " << i;
    }
    EXPECT_GT(partial, 100) << model;
  }
}

// netpbm lays the picture over a checkerboard. Each square must be the picture with that colour as
// background.
TEST_F(ModelOptions, PicturesWithoutBackgroundLieOverACheckerboard) {
  if (std::system("command -v pamcomp >/dev/null && command -v pngtopam >/dev/null") != 0)
    GTEST_SKIP() << "needs pamcomp and pngtopam (Debian package netpbm)";
  const auto is_dark = [](int x, int y) { return (x / 8 + y / 8) % 2 == 1; };
  std::string board = "P6\n120 90\n255\n";
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) board += std::string(3, static_cast<char>(is_dark(x, y) ? 102 : 153));
  write("board.ppm", board);
  for (const std::string& model : {kBunny + " --samples 4", kModels + "blended_window.gltf"}) {
    const Picture light = render(model + " --background '#999999'"),
                  dark = render(model + " --background '#666666'");
    render(model + " --background none");
    const std::string compose = "cd '" + folder_.string() +
                                "' && pngtopam -alphapam out.png >out.pam && "
                                "pamcomp -linear out.pam board.ppm 2>log.txt | pamtopnm >over.ppm 2>>log.txt";
    ASSERT_EQ(std::system(compose.c_str()), 0) << content("log.txt");
    const Picture over = read_picture(path("over.ppm"));
    ASSERT_EQ(over.width, 120);
    for (int y = 0; y < 90; ++y)
      for (int x = 0; x < 120; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t i = 4 * static_cast<std::size_t>(120 * y + x) + c;
          ASSERT_NEAR(over.rgba[i], (is_dark(x, y) ? dark : light).rgba[i], 2)
              << model << " " << x << " " << y;
        }
  }
}

TEST_F(ModelOptions, BackgroundsAreColours) {
  for (const char* text : {"'#336699'", "0.2,0.4,0.6"}) {
    const Picture picture = render(kBunny + " --background " + text);
    EXPECT_EQ(picture.rgba[0], 0x33);
    EXPECT_EQ(picture.rgba[1], 0x66);
    EXPECT_EQ(picture.rgba[2], 0x99);
  }
  expect_one_error(kBunny + " --background blue", 2, "found \"blue\", expected none, #RRGGBB, or R,G,B");
  expect_one_error(kBunny + " --background 0,0,2", 2, "found \"0,0,2\"");
}

TEST_F(ModelOptions, SamplesSmoothEdges) {
  const Picture one = render(kBunny), four = render(kBunny + " --samples 4");
  EXPECT_NE(one.rgba, four.rgba);
  expect_one_error(kBunny + " --samples 3", 2, "--samples");
}

TEST_F(ModelOptions, WireframesLeaveFacesOpen) {
  // A face whose edges alone are drawn shows the background.
  write("box.obj", "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n");
  const auto drawn = [](const Picture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) count += picture.rgba[i + 3] > 0 ? 1 : 0;
    return count;
  };
  const int faces = drawn(render("box.obj --background none"));
  const int edges = drawn(render("box.obj --background none --wireframe"));
  EXPECT_GT(edges, 100);
  EXPECT_LT(edges, faces / 4);
}

TEST_F(ModelOptions, UpAxesTurnTheModel) {
  // A model and the same one with its axes exchanged.
  write("y.obj", "v 0 0 0\nv 2 0 0\nv 0 5 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n");
  write("z.obj", "v 0 0 0\nv 2 0 0\nv 0 0 5\nv 0 -1 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\n");
  write("down.obj", "v 0 0 0\nv 0 2 0\nv -5 0 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n");
  const Picture expected = render("y.obj");
  EXPECT_EQ(render("z.obj --up z").rgba, expected.rgba);
  EXPECT_NE(render("z.obj").rgba, expected.rgba);
  // -x becomes up, and y right.
  EXPECT_EQ(render("down.obj --up -x").rgba, expected.rgba);
  expect_one_error("y.obj --up w", 2, "--up");
}

// SMD files have z up, as 3MF files do.
TEST_F(ModelOptions, UpAxesFollowTheFormat) {
  write("a.smd",
        "version 1\nnodes\n0 \"root\" -1\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\nend\ntriangles\npaint\n"
        "0 0 0 0 0 -1 0 0 0\n0 2 0 0 0 -1 0 1 0\n0 0 0 5 0 -1 0 0 1\nend\n");
  const Picture expected = render("a.smd --up z");
  EXPECT_EQ(render("a.smd").rgba, expected.rgba);
  EXPECT_NE(render("a.smd --up y").rgba, expected.rgba);
}

TEST_F(ModelOptions, TurntablesCloseTheCircle) {
  const Result result = run("render " + kBunny + " --turntable 8 -o 't_{frame}.png' --size 60x45");
  ASSERT_EQ(result.code, 0) << result.err;
  std::vector<std::vector<std::uint8_t>> frames;
  for (int f = 0; f < 8; ++f) frames.push_back(read_picture(path("t_000" + std::to_string(f) + ".png")).rgba);
  EXPECT_FALSE(exists("t_0008.png"));
  for (std::size_t f = 1; f < 8; ++f) EXPECT_NE(frames[f], frames[f - 1]) << f;
  EXPECT_NE(frames[7], frames[0]) << "the last frame does not repeat the first";
  // Half of the pictures of twice as many frames are the same.
  ASSERT_EQ(run("render " + kBunny + " --turntable 4 -o 'h_{frame}.png' --size 60x45").code, 0);
  for (std::size_t f = 0; f < 4; ++f)
    EXPECT_EQ(read_picture(path("h_000" + std::to_string(f) + ".png")).rgba, frames[2 * f]) << f;
  expect_one_error(kBunny + " --turntable 8 --frames 3 -o 'x_{frame}.png'", 2, "--turntable");
  expect_one_error(kBunny + " --turntable 8 -o x.ppm", 2, "{frame}");
}

TEST_F(ModelOptions, ScenesTurnLikeModels) {
  const Result result = run("render --turntable 2 -o 's_{frame}.png' --size 60x45");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(read_picture(path("s_0000.png")).rgba, read_picture(path("s_0001.png")).rgba);
  EXPECT_EQ(read_picture(path("s_0000.png")).rgba, [&] {
    EXPECT_EQ(run("render -o plain.png --size 60x45").code, 0);
    return read_picture(path("plain.png")).rgba;
  }());
}

TEST_F(ModelOptions, ModelsAndScenesComeFromStandardInput) {
  write("m.obj", "v 0 0 0\nv 2 0 0\nv 0 5 0\nf 1 2 3\n");
  write("s.json",
        R"({"tessera": 1, "framebuffer": {"width": 120, "height": 90},
           "frame": [{"clear": {"color": [1, 0, 0, 1]}}]})");
  const Picture expected = render("m.obj");
  EXPECT_EQ(render("- --input-format obj < " + path("m.obj")).rgba, expected.rgba);
  EXPECT_EQ(render("- --input-format json < " + path("s.json")).rgba[0], 255);
  expect_one_error("- -o x.png < /dev/null", 2, "--input-format");
  expect_one_error("m.obj --input-format obj -o x.png", 2, "is for the input -");
}

// File managers replace %i, %o and %s of the line by the model, the picture and its size.
TEST_F(ModelOptions, ThumbnailersDrawModels) {
  std::ifstream file(TESSERA_SOURCE_DIR "/engine/package/tessera.thumbnailer");
  std::string arguments;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Exec=tessera ")) arguments = line.substr(13);
  ASSERT_FALSE(arguments.empty());
  for (const auto& [from, to] :
       {std::pair("%i", kBunny), std::pair("%o", std::string("out.png")), std::pair("%s", std::string("64"))})
    for (std::size_t at = 0; (at = arguments.find(from, at)) != std::string::npos; at += to.size())
      arguments.replace(at, 2, to);
  const Result result = run(arguments);
  ASSERT_EQ(result.code, 0) << arguments << "\n" << result.err;
  const Picture picture = read_picture(path("out.png"));
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(picture.height, 64);
  EXPECT_EQ(picture.channels, 4);
}

}  // namespace
}  // namespace tessera::model_options_program_test
#endif
