// Mistakes in scenes and models: each gives one line that names the file and the place in it, and exit
// code 1.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <string>

#include "tests/engine/program/mistakes.h"

namespace tessera::scene_mistakes_program_test {
namespace {

struct BadFile {
  const char* name;
  const char* text;  ///< if it begins with a comma: a scene without its first members
  const char* message;
};

class SceneMistakes : public Mistakes {
 protected:
  void expect_error(const BadFile& file) const {
    const std::string text = file.text;
    const std::string begin = R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8})";
    write(file.name, text.starts_with(',') ? begin + text + "}" : text);
    expect_one_line({("render " + std::string(file.name)).c_str(), 1, file.message});
  }
};

TEST_F(SceneMistakes, NamesPlaceInScene) {
  const BadFile kRows[] = {
      {"empty.json", "",
       "empty.json: line 1, column 1: syntax error while parsing value - unexpected end of input; expected "
       "'[', '{', or a literal"},
      {"cut.json", R"({"tessera": 1, )",
       "cut.json: line 1, column 16: syntax error while parsing object key - unexpected end of input; "
       "expected string literal"},
      {"list.json", "[]", "list.json: (top level): found an empty array, expected an object"},
      {"nover.json", "{}", R"(nover.json: (top level): key "tessera" is missing)"},
      {"newer.json", R"({"tessera": 2})",
       "newer.json: /tessera: found 2, expected 1, the version of the scene format"},
      {"key.json", R"({"tessera": 1, "framebufer": {}})",
       R"(key.json: /framebufer: unknown key "framebufer"; did you mean "framebuffer"?)"},
      {"type.json", R"({"tessera": 1, "framebuffer": {"width": "8"}})",
       R"(type.json: /framebuffer/width: found "8", expected a number)"},
      {"range.json", R"({"tessera": 1, "framebuffer": {"width": 0}})",
       "range.json: /framebuffer/width: found 0, expected an integer from 1 to 16384"},
      {"fraction.json", R"({"tessera": 1, "framebuffer": {"width": 8.5}})",
       "fraction.json: /framebuffer/width: found 8.5, expected an integer from 1 to 16384"},
      {"mesh.json", R"(, "frame": [{"draw": "cube"}])",
       R"(mesh.json: /frame/0/draw: found "cube", expected the name of a mesh (the scene has none))"},
      {"material.json",
       R"(, "meshes": {"a": {"builtin": "teapot"}}, "frame": [{"draw": "a", "material": "red"}])",
       R"(material.json: /frame/0/material: found "red", expected the name of a material (the scene has)"},
      {"builtin.json", R"(, "meshes": {"a": {"builtin": "teepot"}})",
       R"(builtin.json: /meshes/a/builtin: found "teepot", expected one of)"},
      {"texture.json", R"(, "textures": {"t": {"file": "none.png"}})",
       R"(texture.json: /textures/t/file: cannot read "none.png": No such file or directory)"},
      {"model.json", R"(, "meshes": {"a": {"file": "none.obj"}})",
       R"(model.json: /meshes/a/file: cannot read "none.obj": No such file or directory)"},
      {"command.json", R"(, "frame": [{"darw": "a"}])",
       R"(command.json: /frame/0/darw: unknown key "darw"; did you mean "draw"?)"},
      {"vector.json", R"(, "camera": {"eye": [0, 0]})",
       "vector.json: /camera/eye: found an array of 2, expected an array of 3 numbers"},
      {"camera.json", R"(, "camera": {"eye": [0, 0, 1], "target": [0, 0, 1]})",
       "camera.json: /camera: look_at: eye, target and up do not span a frame; eye and target must differ, "
       "and up must not lie along the view"},
      {"enum.json",
       R"(, "meshes": {"a": {"builtin": "teapot"}}, "frame": [{"draw": "a", "depth": {"test": "les"}}])",
       R"(enum.json: /frame/0/depth/test: found "les", expected one of)"},
      {"keys.json", R"(, "frame": [{"clear": {"color": [{"keys": [[1, 0], [0, 1]]}, 0, 0, 1]}}])",
       "keys.json: /frame/0/clear/color/0/keys/1: t must rise from key to key"},
      {"nan.json", R"(, "frame": [{"clear": {"color": [NaN, 0, 0, 1]}}])",
       R"(nan.json: line 1, column 89: syntax error while parsing value - invalid literal; last read:)"},
      {"index.json",
       R"(, "meshes": {"a": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [0,1,3]}}, "frame": [])",
       "index.json: /meshes/a/indices/2: found 3, expected an integer from 0 to 2"},
      {"dup.json", R"({"tessera": 1, "tessera": 1})",
       R"(dup.json: /tessera: the key "tessera" occurs twice in one object)"},
  };
  for (const BadFile& row : kRows) expect_error(row);
}

TEST_F(SceneMistakes, NamesPlaceInModel) {
  const BadFile kRows[] = {
      {"bad.obj", "v 0 0 0\nf 1 2 3\n",
       "bad.obj:2: index 2 is out of bounds, there are 1 vertices before this line"},
      {"bad.stl", "solid x\nfacet", R"(bad.stl: holds no triangle: expected facets after "solid")"},
      {"bad.ply", "ply\nformat text 1.0\n",
       R"(bad.ply:2: found format "text", expected ascii, binary_little_endian or binary_big_endian)"},
      {"bad.glb", "glTF", "bad.glb: the file ends within its header of 12 bytes"},
      {"notes.txt", "hello",
       R"(notes.txt: the file name extension is ".txt", expected one of those listed by "tessera formats")"},
  };
  for (const BadFile& row : kRows) expect_error(row);
}

}  // namespace
}  // namespace tessera::scene_mistakes_program_test
#endif
