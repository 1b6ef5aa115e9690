// Lights that the engine leaves out of random scenes, judged by an independent evaluation in double precision
// of each light at each point that is lit:
//   - soundness: a light that is left out adds exactly zero at every point
//   - reach: of the lights that miss every point by more than 2 degrees, most are left out
// TESSERA_LONG=1: 300 scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/program/scene/scene.h"
#include "tests/engine/plan/light_oracle.h"
#include "tests/random_scenes/random_scene.h"

namespace tessera::light_oracle_test {
namespace {

using namespace test;
using nlohmann::json;

constexpr double kMarginDegrees = 2;

std::uint64_t oracle_scene_count() { return std::getenv("TESSERA_LONG") != nullptr ? 300 : 40; }

/// Turns the axis of each cone away from the middle of the scene, and narrows cones that would reach it
/// nevertheless.
std::string with_cones_turned_away(const std::string& text) {
  json scene = json::parse(text);
  for (json& light : scene["lights"]) {
    if (!light.contains("spot_direction")) continue;
    const json position = light["position"];
    light["spot_direction"] = {position[0], position[1], position[2]};
    light["spot_cutoff"] = std::min(light["spot_cutoff"].get<double>(), 60.0);
  }
  return scene.dump();
}

/// Lights of one draw that the engine leaves out.
struct LightClaims {
  /// Per face: reasons of the lights that are left out. Absent: the face is not lit.
  std::optional<std::map<int, EffectReason>> left_out[2];

  explicit LightClaims(const std::vector<EffectNote>& notes) {
    for (const EffectNote& note : notes) {
      if (note.effect != Effect::light) continue;
      auto& face = left_out[note.back_faces ? 1 : 0];
      if (!face) face.emplace();
      if (!note.active) face->emplace(note.light, note.reason);
    }
  }
};

/// Counts pairs of a draw's face and a light.
struct PairCounts {
  int pairs = 0;
  int left_out = 0;
  int misses = 0;                        ///< pairs whose light misses all points by more than 2 degrees
  int misses_found = 0;                  ///< those of them that are left out
  std::map<std::string, int> not_found;  ///< the others, by what the draw is like

  double share_found() const { return misses == 0 ? 0 : 100.0 * misses_found / misses; }
};

std::string kind_of(const reference::Draw& draw, const reference::Scene& scene,
                    const reference::Light& light) {
  std::string kind = draw.shading == reference::Shading::kPhong ? "pixels" : "vertices";
  if (scene.framebuffer.samples > 1) kind += ", samples";
  if (draw.polygon_mode[0] != reference::PolygonMode::kFill) kind += ", outlines";
  if (draw.cull != reference::Cull::kNone) kind += ", culled";
  if (draw.scissor) kind += ", scissor";
  if (scene.light_model.two_sided) kind += ", two-sided";
  if (light.position.w == 0) return kind + ", directional";
  return kind + (light.spot_cutoff == 180 ? ", point" : ", spot");
}

/// Compares what is claimed about one light on one face with every lit point.
void judge_light(const LightOracle& oracle, const std::vector<LitPoint>& points,
                 const std::optional<EffectReason>& claim, const std::string& kind, PairCounts& counts) {
  double least_missed = 180, least_behind = 180, least_outside = 180;
  int reached = 0;
  for (const LitPoint& point : points) {
    const LightAtPoint light = oracle.at(point);
    least_behind = std::min(least_behind, light.behind_by);
    least_outside = std::min(least_outside, light.outside_by);
    least_missed = std::min(least_missed, std::max(light.behind_by, light.outside_by));
    // The ambient part of a directional light is the same everywhere and is added in advance.
    const reference::Vec3 added =
        light.diffuse_and_specular + (oracle.is_directional() ? reference::Vec3{} : light.ambient);
    if (added.x != 0 || added.y != 0 || added.z != 0) ++reached;
  }
  if (claim) {
    EXPECT_EQ(reached, 0) << code(*claim) << ", " << kind << ", of " << points.size() << " points";
  }
  ++counts.pairs;
  counts.left_out += claim ? 1 : 0;
  if (least_missed <= kMarginDegrees) return;
  ++counts.misses;
  counts.misses_found += claim ? 1 : 0;
  std::string why = ", behind or outside";
  if (least_behind > kMarginDegrees) why = ", behind";
  if (least_outside > kMarginDegrees) why = ", outside";
  if (!claim) ++counts.not_found[kind + why];
}

void judge_draw(const reference::Scene& scene, const reference::Draw& draw, const LightClaims& claims,
                PairCounts& counts) {
  if (!claims.left_out[0] && !claims.left_out[1]) return;
  const std::vector<reference::EyeLight> lights =
      reference::lights_in_eye_space(scene.lights, scene.camera.view_from_world);
  const LitPoints points = lit_points(scene, draw);
  for (int face = 0; face < 2; ++face) {
    if (!claims.left_out[face] || points.face[face].empty()) continue;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const LightOracle oracle(lights[i], scene.lights[i].spot_cutoff,
                               face == 0 ? draw.material : draw.back_material, scene.light_model);
      const auto left_out = claims.left_out[face]->find(static_cast<int>(i));
      judge_light(oracle, points.face[face],
                  left_out != claims.left_out[face]->end() ? std::optional(left_out->second) : std::nullopt,
                  kind_of(draw, scene, scene.lights[i]), counts);
    }
  }
}

void judge_scene(const std::string& text, PairCounts& counts) {
  const program::Scene scene = program::parse_scene(text, "random scene");
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  const reference::Scene same = reference::parse_scene(text, "");
  std::size_t index = 0;
  for (const reference::Command& command : same.frame)
    if (const auto* draw = std::get_if<reference::Draw>(&command))
      judge_draw(same, *draw, LightClaims(frame.effects(index++)), counts);
}

void print(const char* title, const PairCounts& counts) {
  std::printf(
      "%s: %d pairs of draw and light, %d left out; %d miss by more than 2 degrees, %d of them left out "
      "(%.1f %%)\n",
      title, counts.pairs, counts.left_out, counts.misses, counts.misses_found, counts.share_found());
  for (const auto& [kind, number] : counts.not_found) std::printf("  %d %s\n", number, kind.c_str());
}

TEST(LightOracle, FindsNoContributionOfLightsLeftOut) {
  PairCounts plain, turned;
  for (std::uint64_t seed = 0; seed < oracle_scene_count(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    const std::string text = random_scene(seed);
    judge_scene(text, plain);
    if (seed % 4 == 0) judge_scene(with_cones_turned_away(text), turned);
  }
  print("random scenes", plain);
  print("cones turned away", turned);
  EXPECT_GE(plain.share_found(), 80);
  EXPECT_GE(turned.share_found(), 80);
}

}  // namespace
}  // namespace tessera::light_oracle_test
