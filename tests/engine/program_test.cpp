// The program as its users call it: exit codes, files, messages.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/wait.h>
#include <unistd.h>

namespace tessera {
namespace {

namespace fs = std::filesystem;

struct Result {
  int code = -1;
  std::string out, err;
};

class Program : public testing::Test {
 protected:
  Program() : folder_(fs::temp_directory_path() / ("tessera_program_" + std::to_string(::getpid()))) { fs::create_directories(folder_); }
  ~Program() override { fs::remove_all(folder_); }

  Result run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && '" TESSERA_PROGRAM "' " + arguments + " >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("out.txt"), content("err.txt")};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name, std::ios::binary) << text; }
  std::string content(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  bool exists(const std::string& name) const { return fs::exists(folder_ / name); }

  fs::path folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Program, AloneItPrintsHelp) {
  const Result alone = run(""), help = run("--help"), version = run("--version"), render_help = run("render --help");
  EXPECT_EQ(alone.code, 0);
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(contains(alone.out, "Examples:")) << alone.out;
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("tessera 0.")) << version.out;
  EXPECT_EQ(render_help.code, 0);
  for (const char* option : {"--output", "--size", "--shading", "--threads", "--color-bits", "--palette", "--planes", "--tile-size", "--isa", "--explain", "--stats"})
    EXPECT_TRUE(contains(render_help.out, option)) << option;
}

TEST_F(Program, BadUsageExitsWithTwoAndOneLine) {
  const struct {
    const char *arguments, *fragment;
  } kBad[] = {
      {"rendr", "did you mean \"render\"?"},
      {"--versoin", "did you mean \"--version\"?"},
      {"render --colour-bits 4", "did you mean \"--color-bits\"?"},
      {"render --shading=gourad", "did you mean \"gouraud\"?"},
      {"render --palete ega16", "did you mean \"--palette\"?"},
      {"render --palette ega", "expected one of"},
      {"render --size 640", "WIDTHxHEIGHT"},
      {"render --size 0x480", "WIDTHxHEIGHT"},
      {"render --size 20000x480", "WIDTHxHEIGHT"},
      {"render --size 640x480x3", "WIDTHxHEIGHT"},
      {"render --threads 0", "expected an integer from 1 to 1024"},
      {"render --threads many", "expected an integer from 1 to 1024"},
      {"render --color-bits 25", "expected an integer from 1 to 24"},
      {"render --tile-size 48", "expected one of 32, 64, 128"},
      {"render --isa sse2", "expected one of"},
      {"render -o", "-o"},
      {"render a.json b.json", "unexpected argument \"b.json\""},
      {"render -x", "-x"},
  };
  for (const auto& [arguments, fragment] : kBad) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

TEST_F(Program, FailuresExitWithOneAndOneLine) {
  write("bad.json", R"({"tessera": 1, "framebuffer": {"width": 0}})");
  write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  write("fine.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}})");
  const struct {
    const char *arguments, *fragment;
  } kFailing[] = {
      {"render nothing.json", "cannot read \"nothing.json\": No such file or directory"},
      {"render nothing.obj", "cannot read \"nothing.obj\""},
      {"render model.glb", "neither in .json (a scene) nor in .obj (a model)"},
      {"render bad.json", "bad.json: /framebuffer/width: found 0"},
      {"render bad.obj", "bad.obj:2: index 2 out of bounds"},
      {"render fine.json -o no/folder.ppm", "there is no folder \"no\""},
      {"render fine.json -o picture", "no ending"},
      {"render fine.json -o picture.xyz", "picture.xyz"},
      {"render fine.json -o x.ppm --planes fine.json", "fine.json"},
      {"render fine.json -o x.ppm --palette vga256 --color-bits 4", "256"},
  };
  for (const auto& [arguments, fragment] : kFailing) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 1) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

TEST_F(Program, TheBuiltInSceneBecomesAPng) {
  const Result result = run("render --size 64x48");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(content("tessera.png").starts_with("\x89PNG")) << result.err;
}

TEST_F(Program, TheNameOfThePictureComesFromTheScene) {
  write("my scene.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 4}, "frame": [{"clear": {"color": [1, 0, 0, 1]}}]})");
  EXPECT_EQ(run("render 'my scene.json'").code, 0);
  EXPECT_TRUE(exists("my scene.png"));
  EXPECT_EQ(run("render 'my scene.json' -o red.ppm").code, 0);
  std::string expected = "P6\n8 4\n255\n";
  for (int i = 0; i < 32; ++i) expected.append("\xff\0\0", 3);
  EXPECT_EQ(content("red.ppm"), expected);
}

TEST_F(Program, TheSameBytesForAnyNumberOfThreads) {
  for (const char* options : {"--threads 1 -o a.ppm", "--threads 5 -o b.ppm", "--tile-size 32 -o c.ppm", "--isa scalar -o d.ppm"}) {
    const Result result = run(std::string("render --size 200x150 ") + options);
    EXPECT_EQ(result.code, 0) << result.err;
  }
  EXPECT_GT(content("a.ppm").size(), 90000u);
  for (const char* other : {"b.ppm", "c.ppm", "d.ppm"}) EXPECT_TRUE(content("a.ppm") == content(other)) << other;
}

TEST_F(Program, PlanesAreWrittenOneByOne) {
  const Result result = run("render --size 20x10 --palette ega16 --planes deep/planes -o a.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* name : {"color_00", "color_03", "depth_00", "depth_23", "stencil_00", "stencil_07"}) {
    const std::string plane = content(std::string("deep/planes/") + name + ".pbm");
    EXPECT_TRUE(plane.starts_with("P4\n20 10\n")) << name;
    EXPECT_EQ(plane.size(), 9u + 3 * 10) << name;
  }
  EXPECT_FALSE(exists("deep/planes/color_04.pbm"));
  EXPECT_FALSE(exists("deep/planes/stencil_08.pbm"));
}

TEST_F(Program, ExplainAndStatsSpeak) {
  const Result result = run("render --size 32x32 --explain --stats -o a.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "draw 0, \"teapot\":")) << result.out;
  EXPECT_TRUE(contains(result.err, "triangles")) << result.err;
  EXPECT_TRUE(contains(result.err, "ms")) << result.err;
}

TEST_F(Program, AModelAloneIsFramed) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Result result = run("render t.obj --size 16x16 -o t.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string picture = content("t.ppm");
  const std::string background = picture.substr(picture.size() - 3);
  bool is_seen = false;
  for (std::size_t i = 13; i + 3 <= picture.size(); i += 3) is_seen |= picture.compare(i, 3, background) != 0;
  EXPECT_TRUE(is_seen);
}

}  // namespace
}  // namespace tessera
#endif
