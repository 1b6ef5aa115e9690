// `tessera explain`: text and JSON.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/engine/program/program.h"

namespace tessera::explain_command_test {
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

/// A square that covers the left half of the picture and a square behind it that covers the whole. The spot
/// reaches the second only: the left one is drawn with the lights before it.
constexpr const char* kSquares = R"({"tessera": 1, "framebuffer": {"width": 64, "height": 32},
  "camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
             "projection": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]},
  "meshes": {"left": {"positions": [[-1,-1,0.5], [0,-1,0.5], [0,1,0.5], [-1,1,0.5]],
                      "indices": [0,1,2,0,2,3]},
             "all": {"positions": [[-1,-1,0], [1,-1,0], [1,1,0], [-1,1,0]], "indices": [0,1,2,0,2,3]},
             "ball": {"builtin": "sphere", "detail": 8}},
  "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}},
            {"lights": [{"position": [0, 0, 4, 1]},
                        {"position": [0, 0, 4, 1], "spot_cutoff": 10, "spot_direction": [0, 0, 1]}]},
            {"draw": "left", "shading": "phong"},
            {"lights": [{"position": [0, 0, 4, 1]}, {"position": [0, 0, 4, 1]}]},
            {"draw": "all", "shading": "phong"},
            {"draw": "ball", "scissor": [0, 0, 0, 0]}]})";

TEST_F(ExplainCommand, MeasuresDraws) {
  write("squares.json", kSquares);
  const nlohmann::json json =
      nlohmann::json::parse(run("explain squares.json --measure --json --threads 2").out);
  EXPECT_EQ(json["measured"]["threads"], 2);
  const double frame_ms = json["measured"]["frame_ms"];
  double sum_ms = 0;
  for (const nlohmann::json& draw : json["draws"])
    for (const char* key : {"vertex_ms", "binning_ms", "tile_ms"}) {
      EXPECT_GE(draw["measured"][key].get<double>(), 0);
      sum_ms += draw["measured"][key].get<double>();
    }
  EXPECT_GT(sum_ms, 0);
  EXPECT_LE(sum_ms, 2 * frame_ms);
  const nlohmann::json &left = json["draws"][0]["measured"], &all = json["draws"][1]["measured"];
  EXPECT_EQ(left["covered_pixels"], 32 * 32);
  EXPECT_EQ(left["shaded_pixels"], 32 * 32);
  EXPECT_EQ(all["covered_pixels"], 64 * 32);
  EXPECT_EQ(all["shaded_pixels"], 32 * 32) << "the left half is hidden";
  EXPECT_EQ(all["vertex_batches"], 1);
  for (const auto& [key, value] : json["draws"][2]["measured"].items()) EXPECT_EQ(value, 0) << key;
}

TEST_F(ExplainCommand, GivesTheSharesForWhichEffectsAreLeftOut) {
  write("squares.json", kSquares);
  const Result result = run("explain squares.json --measure --json");
  const nlohmann::json json = nlohmann::json::parse(result.out);
  nlohmann::json spot;
  for (const nlohmann::json& entry : json["measured"]["left_out"])
    if (entry["effect"] == "light" && entry["light"] == 1) spot = entry;
  EXPECT_EQ(spot["reasons"], nlohmann::json({"light_outside_cone"})) << result.out;
  EXPECT_EQ(spot["draws"], 1);
  EXPECT_NEAR(spot["share_of_draws"].get<double>(), 1 / 3.0, 1e-12);
  EXPECT_EQ(spot["share_of_batches"], 0.5);
  EXPECT_NEAR(spot["share_of_covered_pixels"].get<double>(), 1 / 3.0, 1e-12);
  EXPECT_EQ(spot["share_of_shaded_pixels"], 0.5);
  const Result text = run("explain squares.json --measure");
  EXPECT_TRUE(contains(text.out, "  light 1 (light_outside_cone): 1 of 3 draws, 50.0 % of batches"))
      << text.out;
  EXPECT_TRUE(contains(text.out, " 1024 pixels covered, 1024 shaded\n")) << text.out;
  EXPECT_FALSE(contains(run("explain squares.json").out, "measured"));
  EXPECT_EQ(run("explain squares.json --threads 2").code, 2) << "--threads needs --measure";
}

TEST_F(ExplainCommand, ElisionKeepsThePicture) {
  write("ball.json", kScene);
  EXPECT_EQ(run("render ball.json -o on.ppm").code, 0);
  EXPECT_EQ(run("render ball.json --elide off -o off.ppm").code, 0);
  EXPECT_EQ(content("on.ppm"), content("off.ppm"));
  EXPECT_EQ(run("render ball.json --elide maybe").code, 2);
}

}  // namespace
}  // namespace tessera::explain_command_test
#endif
