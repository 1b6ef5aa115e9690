// `tessera explain`: text and JSON.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/engine/program/program.h"

namespace tessera {
namespace {

class ExplainCommand : public Program {};

constexpr const char* kScene = R"({"tessera": 1, "framebuffer": {"width": 32, "height": 32},
  "lights": [{"position": [0, 0, 1, 0]},
             {"position": [0, 0, 4, 1], "spot_cutoff": 10, "spot_direction": [1, 0, 0]}],
  "meshes": {"ball": {"builtin": "sphere", "detail": 8}},
  "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}}, {"draw": "ball", "blend": {}},
            {"bitmap": {"at": [1, 1], "width": 8, "height": 1, "rows": ["ff"]}}]})";

TEST_F(ExplainCommand, PrintsTextAndWritesNoPicture) {
  write("ball.json", kScene);
  const Result result = run("explain ball.json");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "draw 0, \"ball\":\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "  light 1: skipped, no point is inside its cone\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "draw 1, bitmap:\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "  stencil: not allocated, nothing reads it\n")) << result.out;
  EXPECT_FALSE(exists("ball.render.png"));
  EXPECT_EQ(run("explain missing.json").code, 1);
}

TEST_F(ExplainCommand, PrintsJson) {
  write("ball.json", kScene);
  const nlohmann::json json = nlohmann::json::parse(run("explain ball.json --json").out);
  ASSERT_EQ(json["draws"].size(), 2u);
  EXPECT_EQ(json["draws"][0]["mesh"], "ball");
  EXPECT_EQ(json["draws"][1]["kind"], "bitmap");
  EXPECT_EQ(json["draws"][0]["code_paths"].size(), 1u);
  const auto note_of = [&](const char* reason) {
    for (const nlohmann::json& note : json["draws"][0]["effects"])
      if (note["reason"] == reason) return note;
    return nlohmann::json();
  };
  EXPECT_EQ(note_of("light_outside_cone")["cause"], "lights[1].spot_cutoff");
  EXPECT_EQ(note_of("light_outside_cone")["light"], 1);
  EXPECT_EQ(note_of("alpha_is_one")["effect"], "blending");
  EXPECT_EQ(note_of("alpha_is_one")["active"], false);
  ASSERT_EQ(json["buffers"].size(), 4u);
  EXPECT_EQ(json["buffers"][3]["reason"], "not_in_format");
}

TEST_F(ExplainCommand, ElisionKeepsThePicture) {
  write("ball.json", kScene);
  EXPECT_EQ(run("render ball.json -o on.ppm").code, 0);
  EXPECT_EQ(run("render ball.json --elide off -o off.ppm").code, 0);
  EXPECT_EQ(content("on.ppm"), content("off.ppm"));
  EXPECT_EQ(run("render ball.json --elide maybe").code, 2);
}

}  // namespace
}  // namespace tessera
#endif
