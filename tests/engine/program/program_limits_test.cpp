// Runs that end early: models beyond the limits of time and memory, and Ctrl-C.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/engine/program/program.h"

namespace tessera::program_limits_test {
namespace {

namespace fs = std::filesystem;

class ProgramLimits : public Program {};

// Files that are not models, and models that exceed the limits: one line, within the limits of time and
// memory.
TEST_F(ProgramLimits, RejectsHostileModelsWithinLimits) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.stl").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero.stl");
  fs::create_symlink("/dev/zero", folder_ / "zero.obj");
  fs::create_directories(folder_ / "folder.glb");
  write("new\nline.stl", "x");
  write("escape.obj", "v 0 0 \x1b[31mRED\n");
  // 2^30 instances of a triangle.
  std::string nodes = R"({"mesh": 0})";
  for (int i = 0; i < 30; ++i)
    nodes += R"(, {"children": [)" + std::to_string(i) + ", " + std::to_string(i) + "]}";
  write("bomb.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [30]}], "nodes": [)" +
                         nodes +
                         R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
    "max": [0, 0, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const struct {
    const char* name;
    const char* fragment;
  } kHostile[] = {{"pipe.stl", "not a regular file"},
                  {"zero.stl", "not a regular file"},
                  {"zero.obj", "not a regular file"},
                  {"folder.glb", "a directory"},
                  {"new\nline.stl", "new\\x0aline.stl"},
                  {"escape.obj", "\\x1b[31mRED"},
                  {"bomb.gltf", "bomb.gltf"}};
  for (const auto& [name, fragment] : kHostile) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    if (std::string(name) == "bomb.gltf") continue;  // no memory limit with sanitizers
#endif
    const auto start = std::chrono::steady_clock::now();
    const Result result = run("render '" + std::string(name) + "' -o x.ppm");
    EXPECT_EQ(result.code, 1) << name;
    EXPECT_TRUE(contains(result.err, fragment)) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(13)) << name;
  }
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);  // maximum over all children
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(usage.ru_maxrss, (1 << 20) + (1 << 17)) << "KiB";
#endif
}

TEST_F(ProgramLimits, CtrlCCancelsReadingOfModel) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1500000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 1500000; ++i) text += "3 0 1 2\n";
  write("long.ply", text);
  const auto start = std::chrono::steady_clock::now();
  const std::string command = "cd '" + folder_.string() +
                              "' && timeout --foreground --preserve-status -s INT 0.3 '" TESSERA_PROGRAM
                              "' render long.ply -o x.ppm 2>err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130) << content("err.txt");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  EXPECT_FALSE(exists("x.ppm"));
}

TEST_F(ProgramLimits, CtrlCLeavesFinishedPicturesComplete) {
  write("long.json", R"({"tessera": 1, "framebuffer": {"width": 500, "height": 400},
    "frame": [{"clear": {"color": [{"keys": [[0, 0], [1, 1]]}, 0, 0, 1]}}]})");
  const std::string command = "cd '" + folder_.string() +
                              "' && timeout --foreground --preserve-status -s INT 1 '" TESSERA_PROGRAM
                              "' render long.json --frames 100000 -o 'f_{frame}.ppm' 2>err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
  EXPECT_TRUE(contains(content("err.txt"), "finished pictures are complete"));
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!entry.path().filename().string().starts_with("f_")) {
      EXPECT_FALSE(contains(entry.path().string(), ".part-")) << entry.path();
      continue;
    }
    EXPECT_EQ(fs::file_size(entry.path()), 15u + 3 * 500 * 400);
    ++pictures;
  }
  EXPECT_GT(pictures, 3);
}

}  // namespace
}  // namespace tessera::program_limits_test
#endif
