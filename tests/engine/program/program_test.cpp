// The command line: exit codes, files, messages.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/engine/program/program.h"

namespace tessera::program_test {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, PrintsHelpWithoutArguments) {
  const Result alone = run("");
  const Result help = run("--help");
  const Result version = run("--version");
  const Result render_help = run("render --help");
  EXPECT_EQ(alone.code, 0);
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(contains(alone.out, "Examples:")) << alone.out;
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("tessera 0.")) << version.out;
  EXPECT_EQ(render_help.code, 0);
  for (const char* option : {"--output", "--size", "--shading", "--threads", "--color-bits", "--palette",
                             "--planes", "--tile-size", "--isa", "--explain", "--stats"})
    EXPECT_TRUE(contains(render_help.out, option)) << option;
}

TEST_F(Program, ReportsWrongUsageInOneLineAndExitsWith2) {
  const struct {
    const char* arguments;
    const char* fragment;
  } kBad[] = {
      {"rendr", "did you mean \"render\"?"},
      {"--versoin", "did you mean \"--version\"?"},
      {"render --colour-bits 4", "did you mean \"--color-bits\"?"},
      {"render --shading=gourad", "did you mean \"gouraud\"?"},
      {"render --palete ega16", "did you mean \"--palette\"?"},
      {"render --palette ega", "expected one of"},
      {"render --dither bayr4", "did you mean \"bayer4\"?"},
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
      {"render --camera 1,2,3", "EX,EY,EZ,TX,TY,TZ[,FOVY]"},
      {"render --camera 0,0,0,0,0,0", "found eye and target both at 0,0,0, expected two different points"},
      {"render --light 1,2", "X,Y,Z[,W]"},
      {"render --light 1,2,nan", "X,Y,Z[,W]"},
      {"render --stats=xml", "expected one of text, json"},
      {"render --frames 0", "expected an integer from 1"},
      {"render --frames 0x10", "found \"0x10\", expected an integer from 1"},
      {"render -o x.ppm --frames 2", "-o: 2 frames would overwrite \"x.ppm\"; put {frame} into the name"},
      {"render -o x.tif --turntable 5", "-o: 5 frames would overwrite \"x.tif\"; put {frame} into the name"},
      {"render -o 'x{frame}.ppm' --frames 2 --planes p", "--planes: 2 frames would overwrite \"p\""},
      {"render -o x.png --frames 2 --dump d.bin", "--dump: 2 frames would overwrite \"d.bin\""},
      {"render -o x.png --delay 40", "--delay: is for animated PNG files"},
      {"render --frames 2 --delay 40", "--delay: is for animated PNG files"},
      {"render -o 'x{frame}.png' --frames 2 --delay 40", "--delay: is for animated PNG files"},
      {"render -o term --frames 2 --delay 40", "--delay: is for animated PNG files"},
      {"render -o x.png --frames 2 --delay 0", "--delay: found \"0\", expected an integer from 1 to 65535"},
      {"render --compression 10", "expected an integer from 0 to 9"},
      {"render ''", "found \"\", expected a scene's or a model's name"},
      {"render -o ''", "--output: found \"\", expected FILE's name"},
      {"render --planes ''", "--planes: found \"\", expected DIR's name"},
      {"render --compare ''", "--compare: found \"\", expected FILE's name"},
      {"render --compare= --output x.png", "--compare: found \"\", expected a value"},
      {"selftest --expect ''", "--expect: found \"\", expected FILE's name"},
      {"completion csh", "expected one of bash, zsh, fish"},
      {"inof", "did you mean \"info\"?"},
      {"selftset", "did you mean \"selftest\"?"},
      {"selftest --expct x", "did you mean \"--expect\"?"},
      {"selftest x", "unexpected argument \"x\""},
      {"selftest --threads 0", "expected an integer from 1 to 1024"},
      {"render -o x.ppm --palette vga256 --color-bits 4", "256"},
      {"render -o x.ppm --frames 2", "put {frame} into the name"},
      {"render -o - --stats=json", "cannot both go to the standard output"},
      {"render -o x.ppm --explain --stats=json", "cannot both go to the standard output"},
      {"render -o 'x{frame}.ppm' --frames 2 --planes p", "put {frame} into the name"},
      {"selftest --hashes --expect x", "--expect: has no effect with --hashes"},
  };
  for (const auto& [arguments, fragment] : kBad) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

TEST_F(Program, ReportsFailuresInOneLineAndExitsWith1) {
  write("bad.json", R"({"tessera": 1, "framebuffer": {"width": 0}})");
  write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  write("fine.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}})");
  write("bad.ppm", "P6\n8 8\n255\nabc");
  write("small.ppm", "P6 1 1 255 abc");
  write("notes.txt", "no model");
  write("empty.txt", "");
  const struct {
    const char* arguments;
    const char* fragment;
  } kFailing[] = {
      {"render nothing.json", "cannot read \"nothing.json\": No such file or directory"},
      {"render nothing.obj", "cannot read \"nothing.obj\""},
      {"render model.txt", "cannot read \"model.txt\": No such file"},
      {"render notes.txt", "notes.txt: the file name extension is \".txt\", expected one of those"},
      {"render model.glb", "cannot read \"model.glb\": No such file"},
      {"render bad.json", "bad.json: /framebuffer/width: found 0"},
      {"render bad.obj", "bad.obj:2: index 2 is out of bounds"},
      {"render fine.json -o no/folder.ppm", "there is no folder \"no\""},
      {"render fine.json -o picture", "the name has no extension"},
      {"render fine.json -o picture.xyz", "picture.xyz"},
      {"render fine.json -o x.ppm --planes fine.json", "fine.json"},
      {"render fine.json -o x.ppm --compare nothing.ppm", "cannot read \"nothing.ppm\""},
      {"render fine.json -o x.ppm --compare bad.ppm",
       "cannot read \"bad.ppm\": it ends before its last pixel"},
      {"render fine.json -o x.ppm --compare bad.json", "cannot read \"bad.json\""},
      {"render fine.json -o x.ppm --compare small.ppm", "the reference 1x1"},
      {"selftest --expect nothing.txt", "cannot read \"nothing.txt\": No such file or directory"},
      {"selftest --expect notes.txt", "notes.txt:1: expected a scene's name and four hashes"},
      {"selftest --expect empty.txt", "empty.txt: the hashes of scene \"terms_together\" are missing"},
      {"selftest --expect /dev/zero", "cannot read \"/dev/zero\": it holds more than 1048576 bytes"},
  };
  for (const auto& [arguments, fragment] : kFailing) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 1) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.err.starts_with("tessera: error: ")) << arguments << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, fragment)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

TEST_F(Program, RendersBuiltInSceneToPng) {
  const Result result = run("render --size 64x48");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(content("tessera.png").starts_with("\x89PNG")) << result.err;
}

TEST_F(Program, NamesPictureAfterInput) {
  write("my scene.json",
        R"({"tessera": 1, "framebuffer": {"width": 8, "height": 4},
    "frame": [{"clear": {"color": [1, 0, 0, 1]}}]})");
  EXPECT_EQ(run("render 'my scene.json'").code, 0);
  EXPECT_TRUE(exists("my scene.render.png"));
  EXPECT_EQ(run("render 'my scene.json' -o red.ppm").code, 0);
  std::string expected = "P6\n8 4\n255\n";
  for (int i = 0; i < 32; ++i) expected.append("\xff\0\0", 3);
  EXPECT_EQ(content("red.ppm"), expected);
}

TEST_F(Program, WritesSameBytesForAllThreadCountsTileSizesAndInstructionSets) {
  for (const char* options :
       {"--threads 1 -o a.ppm", "--threads 5 -o b.ppm", "--tile-size 32 -o c.ppm", "--isa scalar -o d.ppm"}) {
    const Result result = run(std::string("render --size 200x150 ") + options);
    EXPECT_EQ(result.code, 0) << result.err;
  }
  EXPECT_GT(content("a.ppm").size(), 90000u);
  for (const char* other : {"b.ppm", "c.ppm", "d.ppm"})
    EXPECT_TRUE(content("a.ppm") == content(other)) << other;
}

TEST_F(Program, WritesEachPlaneToOneFile) {
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

TEST_F(Program, PrintsExplanationsAndStatistics) {
  const Result result = run("render --size 32x32 --explain --stats -o a.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "draw 0, \"teapot\":")) << result.out;
  EXPECT_TRUE(contains(result.err, "triangles")) << result.err;
  EXPECT_TRUE(contains(result.err, "ms")) << result.err;
}

TEST_F(Program, FramesModelWithoutCamera) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Result result = run("render t.obj --size 16x16 -o t.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string picture = content("t.ppm");
  const std::string background = picture.substr(picture.size() - 3);
  bool is_visible = false;
  for (std::size_t i = 13; i + 3 <= picture.size(); i += 3)
    is_visible |= picture.compare(i, 3, background) != 0;
  EXPECT_TRUE(is_visible);
}

TEST_F(Program, WritesPictureToStandardOutputOrTerminal) {
  ASSERT_EQ(run("render --size 20x10 -o a.ppm").code, 0);
  const Result out = run("render --size 20x10 -o -");
  EXPECT_EQ(out.code, 0) << out.err;
  EXPECT_TRUE(out.out == content("a.ppm"));
  const Result term = run("render --size 20x10 -o term");
  EXPECT_EQ(std::count(term.out.begin(), term.out.end(), '\n'), 5) << "two pixels per line";
  EXPECT_TRUE(contains(term.out, "\x1b[38;2;")) << "colours";
  ::setenv("NO_COLOR", "1", 1);
  const Result letters = run("render --size 20x10 -o term");
  ::unsetenv("NO_COLOR");
  EXPECT_EQ(letters.out.size(), 5u * 21);
  EXPECT_FALSE(contains(letters.out, "\x1b"));
}

TEST_F(Program, ReportsFullDisk) {
  if (!has_full_disk()) GTEST_SKIP() << "no /dev/full";
  fs::create_symlink("/dev/full", folder_ / "full.ppm");
  const Result file = run("render --size 200x200 -o full.ppm");
  EXPECT_EQ(file.code, 1);
  EXPECT_TRUE(contains(file.err, "No space left on device")) << file.err;
  const Result out = run_without_room("render --size 200x200 -o -");
  EXPECT_EQ(out.code, 1);
  EXPECT_TRUE(contains(out.err, "No space left on device")) << out.err;
}

TEST_F(Program, ReportsUnwritableStandardOutput) {
  if (!has_full_disk()) GTEST_SKIP() << "no /dev/full";
  for (const char* arguments :
       {"render --size 8x8 -o term", "render --size 8x8 -o picture.ppm --stats=json", "explain", "info",
        "formats", "completion bash", "man", "--help", "--version", "selftest --help"}) {
    const Result result = run_without_room(arguments);
    EXPECT_EQ(result.code, 1) << arguments;
    EXPECT_TRUE(contains(result.err, "error: cannot write to the standard output")) << arguments << "\n"
                                                                                    << result.err;
  }
  EXPECT_TRUE(exists("picture.ppm")) << "finished before the error";
  EXPECT_EQ(run("render --size 8x8 --palette bw -o other.ppm").code, 0);
  EXPECT_EQ(run_without_room("render --size 8x8 -o picture.ppm --stats=json --compare other.ppm").code, 3)
      << "the exit code of the comparison takes precedence";
}

TEST_F(Program, RendersNumberedFramesOfAnimation) {
  write("move.json",
        R"({"tessera": 1, "framebuffer": {"width": 4, "height": 2},
    "frame": [{"clear": {"color": [{"keys": [[0, 0], [1, 1]]}, 0, {"keys": [[0, 1], [0.5, 0]]}, 1]}}]})");
  const Result result = run("render move.json --frames 3 -o 'f_{frame}.ppm'");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto pixel = [&](const char* name) { return content(name).substr(11, 3); };
  EXPECT_EQ(pixel("f_0000.ppm"), std::string("\0\0\xff", 3));
  EXPECT_EQ(pixel("f_0001.ppm"), std::string("\x80\0\0", 3));
  EXPECT_EQ(pixel("f_0002.ppm"), std::string("\xff\0\0", 3));
  EXPECT_FALSE(exists("f_0003.ppm"));
  EXPECT_EQ(run("render move.json --frames 2").code, 0);
  EXPECT_TRUE(exists("move.render_0001.png"));
}

TEST_F(Program, ReadsLeadingZerosAsDecimal) {
  write("s.json", R"({"tessera": 1, "framebuffer": {"width": 4, "height": 2},
    "frame": [{"clear": {"color": [{"keys": [[0, 0], [1, 1]]}, 0, 0, 1]}}]})");
  ASSERT_EQ(run("render s.json --frames 010 -o 'f_{frame}.ppm'").code, 0);
  EXPECT_TRUE(exists("f_0009.ppm"));
  EXPECT_FALSE(exists("f_0010.ppm"));
}

TEST_F(Program, CameraOptionKeepsReversedDepth) {
  const auto scene = [](const std::string& camera, const std::string& command) {
    return R"({"tessera": 1, "framebuffer": {"width": 32, "height": 24}, "camera": {)" + camera +
           R"(}, "lights": [],
      "materials": {"red": {"emission": [1, 0, 0, 1]}, "green": {"emission": [0, 1, 0, 1]}},
      "meshes": {"near": {"positions": [[-1, -1, 1], [1, -1, 1], [0, 1, 1]]},
    "far": {"positions": [[-2, -2, -1], [2, -2, -1], [0, 2, -1]]}},
      "frame": [)" +
           command +
           R"({"clear": {"color": [0, 0, 1, 1], "depth": 0}}, {"draw": "near", "material": "red",
    "depth": {"test": "greater"}}, {"draw": "far", "material": "green", "depth": {"test": "greater"}}]})";
  };
  write("written.json",
        scene(R"("eye": [0, 0, 5], "projection": {"fovy": 40, "near": 0.05, "far": 500, "reversed": true})",
              ""));
  write("scene.json", scene(R"("projection": {"reversed": true})", ""));
  write("frame.json", scene("", R"({"camera": {"projection": {"reversed": true}}}, )"));
  const Result written = run("render written.json -o written.ppm");
  EXPECT_EQ(written.code, 0) << written.err;
  for (const char* name : {"scene", "frame"}) {
    const Result other = run("render " + std::string(name) + ".json --camera 0,0,5,0,0,0,40 -o other.ppm");
    EXPECT_EQ(other.code, 0) << other.err;
    EXPECT_TRUE(content("other.ppm") == content("written.ppm")) << name;
  }
}

TEST_F(Program, ExitsWith3IfReferenceDiffers) {
  ASSERT_EQ(run("render --size 64x48 -o right.png").code, 0);
  EXPECT_EQ(run("render --size 64x48 -o a.ppm --compare right.png").code, 0);
  ASSERT_EQ(run("render --size 64x48 -o right.ppm").code, 0);
  EXPECT_EQ(run("render --size 64x48 -o a.ppm --compare right.ppm --threads 1").code, 0);
  const Result other = run("render --size 64x48 -o b.ppm --light 1,0,0,0 --compare right.png --threshold 9");
  EXPECT_EQ(other.code, 3) << other.err;
  EXPECT_TRUE(contains(other.err, "more than 9 of 255 levels"));
  EXPECT_TRUE(exists("b.ppm")) << "the picture is written nevertheless";
  EXPECT_EQ(run("render --size 64x48 -o b.ppm --light 1,0,0,0 --compare right.png --threshold 255").code, 0);
}

TEST_F(Program, WritesPngOfFewBitsPerPixel) {
  const struct {
    const char* options;
    char bits;
    char type;  // PNG colour type: 3 palette, 0 grey, 2 RGB
  } kRows[] = {{"--palette bw", 1, 3},     {"--palette ega16", 4, 3}, {"--palette gray --color-bits 2", 2, 3},
               {"--palette vga256", 8, 3}, {"--color-bits 1", 1, 0},  {"--color-bits 2", 2, 0},
               {"--color-bits 3", 8, 2}};
  for (const auto& row : kRows) {
    const Result result = run("render --size 40x30 -o p.png " + std::string(row.options));
    ASSERT_EQ(result.code, 0) << row.options << result.err;
    const std::string png = content("p.png");
    EXPECT_EQ(png[24], row.bits) << row.options;
    EXPECT_EQ(png[25], row.type) << row.options;
    EXPECT_EQ(run("render --size 40x30 -o q.ppm --compare p.png " + std::string(row.options)).code, 0)
        << row.options;
  }
}

TEST_F(Program, LeavesAlphaOutOfPngOfFewBitsPerPixel) {
  for (const char* bits : {"1", "2"}) {
    write("grey.json",
          R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8, "alpha": 8, "color": {"bits": )" +
              std::string(bits) + R"(}}, "frame": [{"clear": {"color": [0.4, 0.4, 0.4, 1]}}]})");
    ASSERT_EQ(run("render grey.json -o p.png").code, 0);
    EXPECT_EQ(run("render grey.json -o q.ppm --compare p.png").code, 0) << bits;
  }
}

TEST_F(Program, OptionalValuesDoNotConsumeTheScene) {
  write("s.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8},
    "meshes": {"pot": {"builtin": "teapot"}}, "frame": [{"draw": "pot"}]})");
  for (const char* options : {"--stats", "--stats=json", "--light 1,0,0", "--light 1,0,0,0 --light 0,1,0",
                              "--explain", "--progress never"}) {
    const Result result = run("render " + std::string(options) + " s.json -o s.ppm");
    EXPECT_EQ(result.code, 0) << options << ": " << result.err;
  }
}

TEST_F(Program, PrintsStatisticsAsJson) {
  const Result result = run("render --size 64x48 --repeat 3 --stats=json -o a.ppm");
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* part : {"\"triangles_in\": 9120", "\"fragments\":", "\"render_ms_median\":",
                           "\"stages_ms\":", "\"buffer_bytes\":", "\"threads\":"})
    EXPECT_TRUE(contains(result.out, part)) << part;
  EXPECT_TRUE(result.out.starts_with("{") && result.out.ends_with("}\n"));
  EXPECT_TRUE(contains(run("render --size 64x48 --repeat 3 --stats -o a.ppm").err, "median of 3"));
}

TEST_F(Program, ReadsThreadsFromEnvironmentAndPrintsLog) {
  ::setenv("TESSERA_THREADS", "1", 1);
  const Result one = run("render --size 8x8 --log info -o a.ppm");
  ::setenv("TESSERA_THREADS", "010", 1);
  const Result ten = run("render --size 8x8 --log info -o a.ppm");
  const Result as_option = run("render --size 8x8 --threads 010 --log info -o a.ppm");
  ::setenv("TESSERA_THREADS", "0x3", 1);
  const Result hexadecimal = run("render --size 8x8 -o a.ppm");
  ::setenv("TESSERA_THREADS", "many", 1);
  const Result wrong = run("render --size 8x8 -o a.ppm");
  ::unsetenv("TESSERA_THREADS");
  EXPECT_TRUE(contains(one.err, "1 thread, ")) << one.err;
  for (const Result& result : {ten, as_option})
    EXPECT_TRUE(contains(result.err, "10 threads, ")) << result.err;
  for (const Result& result : {hexadecimal, wrong}) {
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_TRUE(contains(result.err, "TESSERA_THREADS")) << result.err;
  }
  EXPECT_TRUE(contains(run("render --size 8x8 --log debug -o a.ppm").err, "tessera: debug: frame: "));
  EXPECT_TRUE(contains(run("render --size 8x8 --progress=always -o a.ppm").err, " left ")) << "progress line";
  EXPECT_FALSE(contains(run("render --size 8x8 -o a.ppm").err, "left"));
}

TEST_F(Program, PrintsMachineFormatsManualAndCompletions) {
  const Result info = run("info");
  const Result formats = run("formats");
  const Result man = run("man");
  for (const char* part : {"instruction sets", "cores", "caches", "CPU"})
    EXPECT_TRUE(contains(info.out, part)) << info.out;
  for (const char* part : {".json", ".obj", ".ppm", ".png"})
    EXPECT_TRUE(contains(formats.out, part)) << formats.out;
  EXPECT_TRUE(man.out.starts_with(".TH TESSERA 1")) << man.out.substr(0, 80);
  EXPECT_TRUE(contains(man.out, "\\-\\-palette"));
  for (const char* command :
       {"render", "explain", "modes", "display", "info", "selftest", "formats", "completion", "man"})
    EXPECT_TRUE(contains(man.out, std::string(".SS tessera ") + command + "\n") ||
                contains(man.out, std::string(".SS tessera ") + command + " "))
        << command;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Result script = run(std::string("completion ") + shell);
    EXPECT_EQ(script.code, 0);
    EXPECT_TRUE(contains(script.out, "palette")) << shell;
  }
  write("complete.sh",
        run("completion bash").out +
            "COMP_WORDS=(tessera render --pal); COMP_CWORD=2; _tessera; echo \"${COMPREPLY[0]}\"\n"
            "COMP_WORDS=(tessera render --shading g); COMP_CWORD=3; _tessera; echo \"${COMPREPLY[0]}\"\n"
            "COMP_WORDS=(tessera completion z); COMP_CWORD=2; _tessera; echo \"${COMPREPLY[0]}\"\n");
  const std::string command = "cd '" + folder_.string() + "' && bash complete.sh > completed.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(content("completed.txt"), "--palette\ngouraud\nzsh\n");
}

}  // namespace
}  // namespace tessera::program_test
#endif
