// PNG files of the program: frames, animations decoded by ffmpeg, libraries that are loaded, failures.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "tests/engine/program/imageio/png_chunk_walk.h"
#include "tests/engine/program/program.h"

namespace tessera::png_program_test {
namespace {

namespace fs = std::filesystem;

class PngProgram : public Program {
 protected:
  /// A square that moves over a background whose colour changes.
  void write_scene(const std::string& more = "") const {
    write("s.json", R"({"tessera": 1, "framebuffer": {"width": 52, "height": 36)" + more + R"(},
      "camera": {"eye": [0, 0, 4], "target": [0, 0, 0]}, "lights": [],
      "materials": {"lit": {"emission": [{"keys": [[0, 1], [1, 0.2]]}, 0.8, 0.3, 1]}},
      "meshes": {"square": {"primitive": "quads",
                            "positions": [[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]]}},
      "frame": [{"clear": {"color": [0.1, 0.2, {"keys": [[0, 0], [1, 0.9]]}, 1], "depth": 1}},
                {"draw": "square", "material": "lit",
                 "transform": [{"translate": [{"keys": [[0, -1], [1, 1]]}, 0, 0]}]}]})");
  }
  void expect_one_error(const Result& result, int code, const std::string& fragment) const {
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  void expect_no_temporary_files() const {
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_FALSE(contains(entry.path().string(), ".part-")) << entry.path();
  }
  /// Runs a shell command in the temporary folder.
  bool succeeds(const std::string& command) const {
    return std::system(("cd '" + folder_.string() + "' && " + command).c_str()) == 0;
  }
  /// The libraries that the program opens, as the dynamic linker tells them.
  std::string loaded_libraries(const std::string& arguments) const {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("loaded.")) fs::remove(entry.path());
    EXPECT_TRUE(succeeds("LD_DEBUG=files LD_DEBUG_OUTPUT=loaded '" TESSERA_PROGRAM "' " + arguments +
                         " >out.txt 2>err.txt"))
        << arguments << content("err.txt");
    std::string libraries;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("loaded."))
        libraries += content(entry.path().filename().string());
    return libraries;
  }
};

TEST_F(PngProgram, OnlyOtherFormatsLoadOpenImageIO) {
  write_scene();
  for (const char* file : {"a.png", "a.ppm", "a.pgm", "a.pfm", "a.raw", "a.pbm --color-bits 1", "-",
                           "a.png --palette ega16", "a.png --frames 2", "a{frame}.png --frames 2",
                           "a.png --background none", "a.png --mode cga --dump a.pcx"}) {
    const std::string libraries = loaded_libraries("render s.json -o " + std::string(file));
    EXPECT_TRUE(contains(libraries, "libdeflate")) << file;
    for (const char* library : {"OpenImageIO", "tessera_imageio", "libOpenEXR", "libpng", "assimp"})
      EXPECT_FALSE(contains(libraries, library)) << file << " loads " << library;
  }
  EXPECT_TRUE(contains(loaded_libraries("render s.json -o a.tif"), "OpenImageIO"));
}

TEST_F(PngProgram, FramesInTheBackgroundEqualThoseOfOneThread) {
  write_scene();
  const struct {
    const char* options;
    const char* extension;
  } kRows[] = {{"", "png"},
               {"--palette ega16", "png"},
               {"--palette adaptive --palette-over smooth", "png"},
               {"--display crt --scale 0.2", "png"},
               {"--display crt --scale 0.2", "pfm"},
               {"--color-bits 1", "pbm"},
               {"", "ppm"}};
  for (const auto& row : kRows) {
    const std::string begin = "render s.json --frames 9 " + std::string(row.options) + " --threads ";
    const std::string end = "_{frame}." + std::string(row.extension);
    ASSERT_EQ(run(begin + "1 -o 'one" + end + "'").code, 0) << row.options;
    ASSERT_EQ(run(begin + "5 -o 'five" + end + "'").code, 0) << row.options;
    for (int f = 0; f < 9; ++f) {
      const std::string name = "_000" + std::to_string(f) + "." + row.extension;
      EXPECT_FALSE(content("one" + name).empty()) << row.options << name;
      EXPECT_TRUE(content("one" + name) == content("five" + name)) << row.options << name;
    }
    EXPECT_FALSE(content("one_0000." + std::string(row.extension)) ==
                 content("one_0008." + std::string(row.extension)))
        << row.options;
  }
  ASSERT_EQ(run("render s.json -o single.png").code, 0);
  ASSERT_EQ(run("render s.json --frames 3 -o 'few_{frame}.png'").code, 0);
  EXPECT_TRUE(content("single.png") == content("few_0000.png"));
  expect_no_temporary_files();
}

/// Every frame that ffmpeg decodes is the numbered picture.
TEST_F(PngProgram, FfmpegDecodesTheFramesOfAnimations) {
  if (!succeeds("command -v ffmpeg >/dev/null")) GTEST_SKIP() << "needs ffmpeg";
  const struct {
    const char* options;
    char bits, color;  ///< in the header
  } kRows[] = {{"", 8, 2},
               {"--background none", 8, 6},
               {"--palette ega16", 4, 3},
               {"--palette bw", 1, 3},
               {"--palette gray --color-bits 2", 2, 3},
               {"--palette vga256 --dither bayer4", 8, 3},
               {"--palette adaptive --color-bits 5", 8, 3},
               {"--palette adaptive --palette-over frame", 8, 2},
               {"--palette adaptive --palette-over smooth --color-bits 4", 8, 2},
               {"--mode cga --reduce --dither floyd_steinberg", 2, 3},
               {"--color-bits 1", 1, 3},
               {"--color-bits 2", 2, 3},
               {"--display lcd --scale 0.2", 8, 2}};
  write_scene();
  for (const auto& row : kRows) {
    const std::string options = "render s.json --frames 7 " + std::string(row.options);
    ASSERT_EQ(run(options + " -o a.png --delay 70").code, 0) << row.options << content("err.txt");
    ASSERT_EQ(run(options + " -o 'n_{frame}.raw'").code, 0) << row.options;
    const std::string file = content("a.png");
    EXPECT_EQ(file.at(24), row.bits) << row.options;
    EXPECT_EQ(file.at(25), row.color) << row.options;
    const auto chunks = png_chunks(file);
    EXPECT_EQ(std::count_if(chunks.begin(), chunks.end(), [](const PngChunk& c) { return c.type == "fcTL"; }),
              7);
    ASSERT_TRUE(
        succeeds("ffmpeg -v error -nostdin -y -f apng -i a.png -fps_mode passthrough -f rawvideo "
                 "-pix_fmt rgba decoded.raw 2>ffmpeg.txt"))
        << row.options << content("ffmpeg.txt");
    std::string numbered;
    for (int f = 0; f < 7; ++f) numbered += content("n_000" + std::to_string(f) + ".raw");
    const std::string decoded = content("decoded.raw");
    ASSERT_EQ(decoded.size(), numbered.size()) << row.options;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < decoded.size(); ++i)
      if (row.color == 6 || i % 4 != 3) wrong += decoded[i] != numbered[i] ? 1u : 0u;
    EXPECT_EQ(wrong, 0u) << row.options;
  }
}

TEST_F(PngProgram, AnimationsTakeTheDelay) {
  write_scene();
  for (const auto& [option, delay] : {std::pair{"", 40u}, {" --delay 250", 250u}}) {
    ASSERT_EQ(run("render s.json --frames 2 -o a.png" + std::string(option)).code, 0);
    const auto chunks = png_chunks(content("a.png"));
    ASSERT_EQ(types_of(chunks), "IHDR acTL fcTL IDAT fcTL fdAT IEND");
    EXPECT_EQ(big_endian(chunks[2].data, 20, 2), delay);
    EXPECT_EQ(big_endian(chunks[4].data, 20, 2), delay);
  }
  ASSERT_EQ(run("render s.json --turntable 3 -o turn.png").code, 0);
  EXPECT_EQ(types_of(png_chunks(content("turn.png"))), "IHDR acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND");
}

/// A palette with keys moves, so its frames have components.
TEST_F(PngProgram, AnimationsOfMovingPalettesHaveComponents) {
  const std::string colors = R"(, "color": {"mode": "index", "bits": 1}, "palette": [[0, 0, 0], [1, 1, )";
  write_scene(colors + R"({"keys": [[0, 0], [1, 1]]}]])");
  ASSERT_EQ(run("render s.json --frames 3 -o a.png").code, 0) << content("err.txt");
  EXPECT_EQ(content("a.png").at(25), 2);
  write_scene(colors + "1]]");
  ASSERT_EQ(run("render s.json --frames 3 -o a.png").code, 0) << content("err.txt");
  EXPECT_EQ(content("a.png").at(25), 3);
}

TEST_F(PngProgram, RefusesAnimationsOfSeveralSizes) {
  write("s.json", R"({"tessera": 1, "framebuffer": {"width": {"keys": [[0, 8], [1, 10]]}, "height": 4}})");
  for (const char* threads : {"1", "3"}) {
    expect_one_error(run("render s.json --frames 3 -o a.png --threads " + std::string(threads)), 1,
                     "frame 1 is 9x4, the first is 8x4");
    EXPECT_FALSE(exists("a.png"));
  }
  expect_no_temporary_files();
  EXPECT_EQ(run("render s.json --frames 3 -o 'a_{frame}.png'").code, 0);
}

TEST_F(PngProgram, AFullDiskIsOneError) {
  if (!has_full_disk()) GTEST_SKIP() << "no /dev/full";
  write_scene();
  for (const char* name : {"full.png", "full.ppm", "f_0004.png"})
    fs::create_symlink("/dev/full", folder_ / name);
  expect_one_error(run("render s.json -o full.png"), 1, "cannot write \"full.png\": No space left on device");
  expect_one_error(run("render s.json -o full.png --palette ega16"), 1, "No space left on device");
  expect_one_error(run("render s.json -o full.png --frames 3"), 1,
                   "cannot write \"full.png\": No space left");
  for (const char* threads : {"1", "4"})
    expect_one_error(run("render s.json --frames 50 -o 'f_{frame}.png' --threads " + std::string(threads)), 1,
                     "cannot write \"f_0004.png\": No space left on device");
  EXPECT_TRUE(exists("f_0003.png"));
  EXPECT_FALSE(exists("f_0030.png"));
  ASSERT_EQ(run("render s.json -o a.png").code, 0);
  expect_one_error(run("compare a.png f_0003.png --map full.png"), 1, "No space left on device");
  expect_no_temporary_files();
}

TEST_F(PngProgram, AClosedPipeIsOneError) {
  write_scene();
  ASSERT_EQ(::mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  for (const char* options :
       {"-o pipe.png --compression 0", "-o pipe.png --compression 0 --turntable 90", "-o -"}) {
    const bool is_stream = std::string(options) == "-o -";
    // The reader ends before the writer has written more than the pipe holds.
    const std::string command = is_stream
                                    ? "{ '" TESSERA_PROGRAM
                                      "' render --size 900x900 -o - 2>err.txt; echo $? >code.txt; } | true"
                                    : "{ true <pipe.png & '" TESSERA_PROGRAM "' render --size 900x900 " +
                                          std::string(options) + " 2>err.txt; echo $? >code.txt; wait; }";
    ASSERT_TRUE(succeeds(command)) << options;
    expect_one_error({std::stoi(content("code.txt")), "", content("err.txt")}, 1, "Broken pipe");
  }
}

}  // namespace
}  // namespace tessera::png_program_test
#endif
