// Quality::light_threshold never changes a lit colour by more than it says: judged by an independent
// evaluation in double precision of each light that is left out at each point that is lit, and by pictures.
// TESSERA_LONG=1: 300 scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/program/scene/scene.h"
#include "tests/engine/frame/api_support.h"
#include "tests/engine/plan/light_oracle.h"
#include "tests/random_scenes/random_scene.h"

namespace tessera::light_threshold_test {
namespace {

using namespace test;
using nlohmann::json;

std::uint64_t threshold_scene_count() { return std::getenv("TESSERA_LONG") != nullptr ? 300 : 40; }

struct ThresholdCounts {
  int left_out = 0;          ///< pairs of a draw's face and a light
  double largest_share = 0;  ///< sum of contributions / threshold
};

/// Lights that are below the threshold, per face.
std::array<std::set<int>, 2> weak_lights(const std::vector<EffectNote>& notes) {
  std::array<std::set<int>, 2> lights;
  for (const EffectNote& note : notes)
    if (note.reason == EffectReason::below_threshold) lights[note.back_faces ? 1 : 0].insert(note.light);
  return lights;
}

/// @param points  at which `draw` is lit; computed on first use
void judge_weak_lights(const reference::Scene& scene, const reference::Draw& draw,
                       std::optional<LitPoints>& points, const std::array<std::set<int>, 2>& weak,
                       float threshold, ThresholdCounts& counts) {
  if (weak[0].empty() && weak[1].empty()) return;
  const std::vector<reference::EyeLight> lights =
      reference::lights_in_eye_space(scene.lights, scene.camera.view_from_world);
  if (!points) points = lit_points(scene, draw);
  for (int face = 0; face < 2; ++face) {
    std::vector<LightOracle> oracles;
    for (const int light : weak[static_cast<std::size_t>(face)])
      oracles.emplace_back(lights[static_cast<std::size_t>(light)],
                           scene.lights[static_cast<std::size_t>(light)].spot_cutoff,
                           face == 0 ? draw.material : draw.back_material, scene.light_model);
    counts.left_out += static_cast<int>(oracles.size());
    for (const LitPoint& point : points->face[face]) {
      double sum[3] = {};
      for (const LightOracle& oracle : oracles) {
        const LightAtPoint at = oracle.at(point);
        const reference::Vec3 added =
            at.diffuse_and_specular + (oracle.is_directional() ? reference::Vec3{} : at.ambient);
        sum[0] += std::abs(added.x);
        sum[1] += std::abs(added.y);
        sum[2] += std::abs(added.z);
      }
      for (const double of_component : sum) {
        ASSERT_LE(of_component, double{threshold});
        counts.largest_share = std::max(counts.largest_share, of_component / double{threshold});
      }
    }
  }
}

TEST(LightThreshold, BoundsWhatTheLightsLeftOutAdd) {
  ThresholdCounts counts;
  for (std::uint64_t seed = 0; seed < threshold_scene_count(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    const std::string text = random_scene(seed);
    const reference::Scene same = reference::parse_scene(text, "");
    std::vector<std::optional<LitPoints>> points(same.frame.size());  // per command
    for (const float threshold : {0.02f, 0.1f, 0.5f}) {
      program::Scene scene = program::parse_scene(text, "random scene");
      scene.quality.light_threshold = threshold;
      FrameBuffer buffer(scene.framebuffer);
      Frame frame(buffer);
      record(scene, frame);
      std::size_t index = 0;
      for (std::size_t c = 0; c < same.frame.size(); ++c)
        if (const auto* draw = std::get_if<reference::Draw>(&same.frame[c]))
          judge_weak_lights(same, *draw, points[c], weak_lights(frame.effects(index++)), threshold, counts);
    }
  }
  std::printf("left out: %d pairs of a face and a light; they add up to %.2f of the threshold\n",
              counts.left_out, counts.largest_share);
  EXPECT_GT(counts.left_out, 100);
  EXPECT_GT(counts.largest_share, 0.3);
}

/// Draws that store their lit colour as it is: r g b of 8 bits, without operations on colours.
std::string with_plain_colors(const std::string& text) {
  json scene = json::parse(text);
  json& format = scene["framebuffer"];
  for (const char* key : {"palette", "dither", "alpha", "accumulation"}) format.erase(key);
  format["color"] = {{"mode", "rgb"}, {"bits", 24}};
  json frame = json::array();
  for (json& command : scene["frame"]) {
    if (command.contains("accum")) continue;
    if (command.contains("clear")) {
      command["clear"].erase("accumulation");
      command["clear"].erase("index");
    }
    for (const char* key : {"blend", "logic_op", "plane_mask", "color_mask", "alpha_test"})
      command.erase(key);
    frame.push_back(command);
  }
  scene["frame"] = frame;
  return scene.dump();
}

std::vector<std::uint32_t> picture_of(program::Scene& scene, float threshold, bool elide = true) {
  scene.quality.light_threshold = threshold;
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  Renderer({.threads = 1, .elide = elide}).finish(frame);
  return packed_colors(buffer);
}

TEST(LightThreshold, BoundsTheErrorOfPictures) {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < threshold_scene_count(); ++seed) {
    program::Scene scene = program::parse_scene(with_plain_colors(random_scene(seed)), "random scene");
    const std::vector<std::uint32_t> in_full = picture_of(scene, 0);
    for (const float threshold : {0.05f, 0.3f}) {
      const std::vector<std::uint32_t> words = picture_of(scene, threshold);
      EXPECT_EQ(picture_of(scene, threshold, false), words) << "depends on what is left out as unnecessary";
      int worst = 0;
      for (std::size_t i = 0; i < words.size(); ++i)
        for (int shift = 0; shift < 24; shift += 8)
          worst = std::max(worst, std::abs(static_cast<int>(words[i] >> shift & 255) -
                                           static_cast<int>(in_full[i] >> shift & 255)));
      EXPECT_LE(worst, 255 * double{threshold} + 1) << "scene " << seed << ", threshold " << threshold;
      changed += worst > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 5);
}

/// Notes of one draw of a square under weak lights.
struct WeakLightScene {
  DrawState state;
  LightModel model;
  MeshData mesh = whole_window();
  std::vector<Light> lights;
  FrameBufferFormat format{.width = 16, .height = 16};
  float threshold = 0.5f;

  WeakLightScene() {
    mesh.normals = {0, 0, 1, 0, 0.1f, 1, 0, 0, 1, 0.1f, 0, 1};
    state.shading = Shading::phong;
    state.material.diffuse = {1, 1, 1, 1};
    Light light;
    light.position = {0, 0, 2, 1};
    light.diffuse = {0.1f, 0.1f, 0.1f, 1};
    light.specular = {0, 0, 0, 1};
    lights.assign(3, light);
    lights[1].diffuse = {0.2f, 0.2f, 0.2f, 1};
    lights[2].diffuse = {0.4f, 0.4f, 0.4f, 1};
  }
  std::set<int> left_out() const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.set_lights(lights);
    frame.set_light_model(model);
    frame.set_quality({.light_threshold = threshold});
    frame.draw(mesh.view(), state);
    return weak_lights(frame.effects(0))[0];
  }
};

TEST(LightThreshold, LeavesOutTheWeakestLightsWhoseSumIsBelowIt) {
  WeakLightScene scene;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1})) << "0.1 + 0.2, and 0.4 would be too much";
  scene.threshold = 0.25f;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0}));
  scene.threshold = 1;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1, 2}));
  scene.threshold = 0;
  EXPECT_TRUE(scene.left_out().empty());
}

TEST(LightThreshold, CountsNegativeLightsByTheirAbsoluteValue) {
  WeakLightScene scene;
  scene.lights[0].diffuse = {-0.45f, 0, 0, 1};
  EXPECT_EQ(scene.left_out(), (std::set<int>{1})) << "0.2; -0.45 does not make room for 0.4";
}

TEST(LightThreshold, CountsAmbientAndSpecularParts) {
  WeakLightScene scene;
  scene.lights[0].ambient = {0.5f, 0.5f, 0.5f, 1};
  scene.state.material.ambient = {1, 1, 1, 1};
  EXPECT_EQ(scene.left_out(), (std::set<int>{1}));
  scene.lights[0].ambient = {0, 0, 0, 1};
  scene.lights[1].specular = {0.5f, 0.5f, 0.5f, 1};
  scene.state.material.specular = {1, 1, 1, 1};
  EXPECT_EQ(scene.left_out(), (std::set<int>{0}));
}

TEST(LightThreshold, AttenuatesByTheSmallestDistance) {
  WeakLightScene scene;
  scene.threshold = 0.15f;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0}));
  for (Light& light : scene.lights) light.attenuation_quadratic = 1;  // 1 / 5 at a distance of 2
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1, 2}));
  for (Light& light : scene.lights) light.attenuation_linear = -0.1f;
  EXPECT_TRUE(scene.left_out().empty()) << "factors below 0 have no bound";
  for (Light& light : scene.lights) light.attenuation_linear = 0, light.attenuation_constant = 0;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1})) << "1 / 4";
  for (Light& light : scene.lights) light.position = {0, 0, 0, 1};
  EXPECT_TRUE(scene.left_out().empty()) << "the denominator may be 0";
}

TEST(LightThreshold, UsesTheLengthOfNormals) {
  WeakLightScene scene;
  scene.state.shading = Shading::gouraud;
  scene.state.normalize = false;
  for (float& c : scene.mesh.normals) c *= 3;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0})) << "0.3 and 0.6";
  for (Light& light : scene.lights) light.specular = {0.01f, 0.01f, 0.01f, 1};
  scene.state.material.specular = {1, 1, 1, 1};
  scene.state.material.shininess = 20;
  EXPECT_TRUE(scene.left_out().empty()) << "highlights of long normals have no bound";
  scene.mesh.normals.clear();
  scene.state.material.specular = {0, 0, 0, 1};
  EXPECT_TRUE(scene.left_out().empty()) << "nor do generated normals that keep their length";
  scene.state.normalize = true;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1}));
}

TEST(LightThreshold, UsesTheLargestVertexColorThatReplacesAMaterialColor) {
  WeakLightScene scene;
  scene.state.material.diffuse = {0.1f, 0.1f, 0.1f, 1};
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1, 2}));
  scene.mesh.colors = {1, 0, 0, 1, 0, 0, 2, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  scene.state.color_material = ColorMaterial::diffuse;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0})) << "0.2 and 0.4";
}

TEST(LightThreshold, KeepsLightsWhereColorsAreExtrapolated) {
  WeakLightScene scene;
  scene.format.samples = 4;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1})) << "pixels are lit at points of the triangle";
  scene.state.shading = Shading::gouraud;
  EXPECT_TRUE(scene.left_out().empty());
  scene.format.samples = 1;
  EXPECT_EQ(scene.left_out(), (std::set<int>{0, 1}));
  scene.state.front_mode = PolygonMode::line;
  EXPECT_TRUE(scene.left_out().empty());
}

}  // namespace
}  // namespace tessera::light_threshold_test
