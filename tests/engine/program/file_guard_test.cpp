// What the pictures and planes of a run may replace, as users meet it.
#ifdef TESSERA_PROGRAM
#include <filesystem>
#include <string>

#include <sys/stat.h>

#include "tests/engine/program/program.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, NoPictureTakesThePlaceOfWhatIsRead) {
  for (const char* name : {"pot.png", "pot_0001.ppm"})
    ASSERT_EQ(run("render --size 8x8 -o " + std::string(name)).code, 0);
  const std::string texture = content("pot.png"), image = content("pot_0001.ppm");
  write(
      "pot.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "pot.png"}}, "frame": [{"image": {"at": [0, 0], "file": "pot_0001.ppm"}}]})");
  const struct {
    const char *options, *file;
  } kRefused[] = {{"", "pot.png"},
                  {"-o ./pot.png", "./pot.png"},
                  {"-o pot_0001.ppm", "pot_0001.ppm"},
                  {"--frames 3 -o 'pot_{frame}.ppm'", "pot_0001.ppm"}};
  for (const auto& [options, file] : kRefused) {
    const Result result = run("render pot.json " + std::string(options));
    EXPECT_EQ(result.code, 1) << options;
    EXPECT_EQ(result.err, "tessera: error: \"" + std::string(file) +
                              "\" is one of the input's own files; name another file with -o\n")
        << options;
  }
  EXPECT_FALSE(exists("pot_0000.ppm")) << "nothing is rendered";
  EXPECT_TRUE(content("pot.png") == texture && content("pot_0001.ppm") == image) << "untouched";
  EXPECT_EQ(run("render pot.json -o other.png").code, 0);
}

TEST_F(Program, NoPictureTakesThePlaceOfWhatAModelRefersTo) {
  ASSERT_EQ(run("render --size 8x8 -o pot.png").code, 0);
  const std::string texture = content("pot.png");
  write("pot.mtl", "newmtl a\nmap_Kd pot.png\nmap_Ks nowhere.png\n");
  write("pot.obj", "mtllib pot.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  write(
      "pot.gltf",
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [{"uri": "pot.png"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  write(
      "pot.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "meshes": {"pot": {"file": "pot.obj"}}})");
  for (const std::string input : {"pot.obj", "pot.gltf", "pot.json"}) {
    const Result result = run("render " + input);
    EXPECT_EQ(result.code, 1) << input;
    EXPECT_TRUE(result.err.ends_with(
        "tessera: error: \"pot.png\" is one of the input's own files; name another file with -o\n"))
        << input << "\n"
        << result.err;
    EXPECT_TRUE(content("pot.png") == texture) << input;
    EXPECT_EQ(run("render " + input + " -o nowhere.png").code, 0)
        << input << ": what is not there stops nothing";
    fs::remove(folder_ / "nowhere.png");
  }
}

// Importers do not understand every option before a texture's name.
TEST_F(Program, APictureWithoutANameReplacesOnlyTesserasOwn) {
  write("pot.mtl", "newmtl a\nmap_Kd -s 2 pot.png\n");
  write("pot.obj", "mtllib pot.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  for (const char* name : {"pot.png", "pot_0001.png"}) write(name, "a texture");
  const Result one = run("render pot.obj"), three = run("render pot.obj --frames 3");
  EXPECT_EQ(one.code, 1);
  EXPECT_TRUE(
      one.err.ends_with("tessera: error: \"pot.png\" is there already, and does not say that Tessera made "
                        "it; -o \"pot.png\" replaces it\n"))
      << one.err;
  EXPECT_EQ(three.code, 1);
  EXPECT_TRUE(
      three.err.ends_with("\"pot_0001.png\" is there already, and does not say that Tessera made it; -o "
                          "\"pot_{frame}.png\" replaces it\n"))
      << three.err;
  EXPECT_FALSE(exists("pot_0000.png")) << "nothing is rendered";
  EXPECT_TRUE(content("pot.png") == "a texture" && content("pot_0001.png") == "a texture") << "untouched";
  for (const char* options : {"-o pot.png", "", "--palette vga256", "", "--palette gray", "",
                              "--frames 3 -o 'pot_{frame}.png'", "--frames 3"})
    EXPECT_EQ(run("render pot.obj " + std::string(options)).code, 0) << options;
}

TEST_F(Program, NoPlaneTakesThePlaceOfWhatIsRead) {
  ASSERT_EQ(run("render --size 8x8 -o picture.ppm --planes planes").code, 0);
  const std::string color = content("planes/color_03.pbm"), stencil = content("planes/stencil_00.pbm");
  write(
      "s.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "planes/color_03.pbm"}}})");
  const Result texture = run("render s.json -o - --planes ./planes"),
               reference = run("render --size 8x8 -o a.ppm --planes planes --compare planes/stencil_00.pbm");
  EXPECT_EQ(texture.code, 1);
  EXPECT_EQ(texture.err,
            "tessera: error: \"./planes/color_03.pbm\" is one of the input's own files; name another folder "
            "with --planes\n");
  const Result unmade = run("render s.json -o - --planes new/../planes");
  EXPECT_EQ(unmade.err,
            "tessera: error: \"new/../planes/color_03.pbm\" is one of the input's own files; name another "
            "folder with --planes\n")
      << "as soon as new is made";
  EXPECT_EQ(unmade.code, 1);
  EXPECT_FALSE(exists("new"));
  EXPECT_EQ(reference.code, 1);
  EXPECT_EQ(reference.err,
            "tessera: error: \"planes/stencil_00.pbm\" is the reference itself; name another folder with "
            "--planes\n");
  EXPECT_TRUE(content("planes/color_03.pbm") == color && content("planes/stencil_00.pbm") == stencil)
      << "untouched";
  EXPECT_FALSE(exists("a.ppm")) << "nothing is rendered";
  EXPECT_EQ(run("render s.json -o - --planes other").code, 0);
  EXPECT_TRUE(exists("other/color_03.pbm"));
}

TEST_F(Program, OtherProgramsPngsAndWhatIsNoPngAreNotTesserasOwn) {
  write("pot.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(run("render pot.obj").code, 0);
  const std::string own = content("pot.png"), mark("\x10tEXtSoftware\0Tessera", 21);
  const std::size_t at = own.find(mark);
  ASSERT_NE(at, own.npos);
  const std::string of_tesseract =
      std::string(own).replace(at, mark.size(), std::string("\x12tEXtSoftware\0Tesseract", 23));
  for (const std::string& file : {of_tesseract, own.substr(8), std::string()}) {
    write("pot.png", file);
    const Result refused = run("render pot.obj");
    EXPECT_EQ(refused.code, 1);
    EXPECT_TRUE(contains(refused.err, "does not say that Tessera made it")) << refused.err;
    EXPECT_TRUE(content("pot.png") == file) << "untouched";
  }
  fs::remove(folder_ / "pot.png");
  ASSERT_EQ(::mkfifo((folder_ / "pot.png").c_str(), 0600), 0);
  const Result fifo = run("render pot.obj");
  EXPECT_EQ(fifo.code, 1);
  EXPECT_EQ(
      fifo.err,
      "tessera: error: \"pot.png\" is there already, and is no regular file; name another file with -o\n")
      << "and nobody waits for its reader";
}

// Where folders are made by the run itself, and have links behind them, nothing tells beforehand what is
// replaced.
TEST_F(Program, WhatIsReadIsKeptBehindFoldersYetToBeMade) {
  fs::create_directories(folder_ / "deep/dir");
  fs::create_directory_symlink("deep/dir", folder_ / "link");
  for (const char* made : {"x0000", "deep/x0000"}) fs::create_directory(folder_ / made);
  ASSERT_EQ(run("render --size 8x8 -o deep/pot_0001.ppm --planes deep/planes").code, 0);
  const std::string plane = content("deep/planes/color_03.pbm"), picture = content("deep/pot_0001.ppm");
  write(
      "plane.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "deep/planes/color_03.pbm"}}})");
  write(
      "picture.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "deep/pot_0001.ppm"}}})");
  const Result planes = run("render plane.json -o - --planes new/../link/../planes");
  EXPECT_EQ(planes.code, 1);
  EXPECT_EQ(planes.err,
            "tessera: error: \"new/../link/../planes/color_03.pbm\" is one of the input's own files; name "
            "another folder with --planes\n");
  EXPECT_TRUE(content("deep/planes/color_03.pbm") == plane) << "untouched";
  for (const std::string folder : {"deep/x0001", "x0001"}) {
    const bool behind_link = folder == "x0001";
    const Result pictures = run("render picture.json --frames 2 -o '" +
                                std::string(behind_link ? "x{frame}/../link" : "deep/x{frame}") +
                                "/../pot_{frame}.ppm' --planes '" + folder + "/{frame}'");
    EXPECT_EQ(pictures.code, 1) << folder;
    EXPECT_TRUE(
        pictures.err.ends_with("pot_0001.ppm\" is one of the input's own files; name another file with -o\n"))
        << pictures.err;
    EXPECT_EQ(exists("deep/pot_0000.ppm"), behind_link) << "else nothing is rendered";
    EXPECT_TRUE(content("deep/pot_0001.ppm") == picture) << "untouched";
  }
}

TEST_F(Program, PlanesThatNoFormatHasAreNobodysPlace) {
  fs::create_directory(folder_ / "planes");
  ASSERT_EQ(run("render --size 8x8 -o planes/color.ppm").code, 0);
  fs::create_symlink("color.ppm", folder_ / "planes/color_32.pbm");
  fs::create_symlink("color.ppm", folder_ / "planes/stencil_08.pbm");
  write(
      "s.json",
      R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}, "textures": {"t": {"file": "planes/color.ppm"}}})");
  const Result free = run("render s.json -o - --planes planes");
  EXPECT_EQ(free.code, 0) << free.err;
  for (const char* name : {"color_31.pbm", "depth_31.pbm", "stencil_07.pbm", "accumulation_127.pbm"}) {
    fs::remove(folder_ / "planes" / name);
    fs::create_symlink("color.ppm", folder_ / "planes" / name);
    const Result taken = run("render s.json -o - --planes planes");
    EXPECT_EQ(taken.code, 1) << name;
    EXPECT_EQ(taken.out, "") << name << ": nothing is rendered";
    fs::remove(folder_ / "planes" / name);
  }
}

TEST_F(Program, NoFrameTakesThePlaceOfTheReference) {
  ASSERT_EQ(run("render --size 8x8 -o f_0001.ppm").code, 0);
  const std::string before = content("f_0001.ppm");
  const Result result =
      run("render --size 8x8 --light 1,0,0,0 --frames 3 -o 'f_{frame}.ppm' --compare f_0001.ppm");
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_TRUE(contains(result.err, "\"f_0001.ppm\" is the reference itself; name another file with -o"))
      << result.err;
  EXPECT_FALSE(exists("f_0000.ppm")) << "nothing is rendered";
  EXPECT_TRUE(content("f_0001.ppm") == before) << "untouched";
}

}  // namespace
}  // namespace tessera
#endif
