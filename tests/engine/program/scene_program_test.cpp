// `tessera scene`.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <string>

#include "tests/engine/program/program.h"

namespace tessera::scene_program_test {
namespace {

const std::string kLeaf = "'" TESSERA_SOURCE_DIR "/tests/models/gltf/masked_leaf.gltf'";

class SceneProgram : public Program {
 protected:
  void expect_error(const std::string& arguments, int code, const std::string& message) const {
    const Result result = run("scene " + arguments);
    EXPECT_EQ(result.code, code) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_EQ(result.err, "tessera: error: " + message + "\n") << arguments;
  }
};

TEST_F(SceneProgram, WritesASceneThatGivesTheSamePicture) {
  const std::string view = " --size 90x60 --camera 1,0.5,4,0,0,0,50 --light 0,3,2 --light 1,0,0,0";
  ASSERT_EQ(run("render " + kLeaf + view + " -o model.png").code, 0);
  const Result result = run("scene " + kLeaf + view + " -o leaf.json");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_TRUE(exists("leaf.texture0.png"));
  const Result compared = run("render leaf.json -o scene.png --compare model.png");
  EXPECT_EQ(compared.code, 0) << compared.err;
  // In another size the scene is the model's too: its perspective follows the picture.
  ASSERT_EQ(run("render " + kLeaf + view + " --size 50x80 -o model.png").code, 0);
  EXPECT_EQ(run("render leaf.json --size 50x80 -o scene.png --compare model.png").code, 0);
}

TEST_F(SceneProgram, ReplacesFiles) {
  write("leaf.json", "old");
  write("leaf.texture0.png", "old");
  EXPECT_EQ(run("scene " + kLeaf + " -o leaf.json").code, 0);
  EXPECT_EQ(run("render leaf.json -o scene.png").code, 0);
}

TEST_F(SceneProgram, RefusesWrongArguments) {
  expect_error("", 2, "model is required (see tessera scene --help)");
  expect_error(kLeaf, 2, "--output is required (see tessera scene --help)");
  expect_error("a.json -o b.json", 1, "\"a.json\" is a scene already, expected a model");
  expect_error(kLeaf + " -o leaf.png", 1, "the scene file is \"leaf.png\", its name must end in .json");
  expect_error(kLeaf + " -o none/leaf.json", 1,
               "cannot write \"none/leaf.json\": there is no folder \"none\"");
  expect_error("none.glb -o leaf.json", 1, "cannot read \"none.glb\": No such file or directory");
  EXPECT_FALSE(exists("leaf.json"));
}

}  // namespace
}  // namespace tessera::scene_program_test
#endif
