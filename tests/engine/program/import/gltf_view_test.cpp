// Cameras and lights of glTF 2 files, read without assimp, which would reject some of these files.
#include <gtest/gtest.h>

#include "engine/program/import/gltf_view.h"

namespace tessera::gltf_view_test {
using namespace program;
namespace {

constexpr const char* kOrthographic =
    R"({"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 3, "znear": 0.25, "zfar": 9}})";

Model view_of(const std::string& members, const std::string& camera = kOrthographic) {
  Model model;
  EXPECT_TRUE(add_gltf_view_of_bytes(
      R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"},
    {"type": "point"}]}},
    "cameras": [)" +
          camera + "], " + members + "}",
      model))
      << members;
  return model;
}

// Replaces @ by invalid indices of `kind`. Cameras of earlier nodes are kept.
void expect_warning(std::string members, const std::string& kind, std::size_t length, std::size_t cameras) {
  const auto with = [&](const std::string& index) {
    return std::string(members).replace(members.find('@'), 1, index);
  };
  const Model whole = view_of(with(std::to_string(length - 1)));
  EXPECT_TRUE(whole.warnings.empty()) << whole.warnings[0];
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  const std::string end = std::to_string(length);
  const std::pair<std::string, std::string> kInvalid[] = {{"1e+308", "1e+308"},
                                                          {"-1e+308", "-1e+308"},
                                                          {"-1", "-1"},
                                                          {"0.5", "0.5"},
                                                          {"1.0", "1.0"},
                                                          {"18446744073709551615", "18446744073709551615"},
                                                          {"18446744073709551616", "1.8446744073709552e+19"},
                                                          {end, end},
                                                          {"\"0\"", "string"},
                                                          {"true", "boolean"},
                                                          {"null", "null"},
                                                          {deep, "array"}};
  for (const auto& [index, found] : kInvalid) {
    const Model model = view_of(with(index));
    EXPECT_EQ(model.cameras.size(), cameras) << members << " with " << index.substr(0, 40);
    ASSERT_EQ(model.warnings.size(), 1u) << members << " with " << index.substr(0, 40);
    EXPECT_EQ(model.warnings[0], "not all of its cameras and lights could be read: found " + found +
                                     ", expected the index of one of " + std::to_string(length) + " " + kind);
  }
}

TEST(GltfView, WarnsOfInvalidIndices) {
  expect_warning(R"("scene": @, "scenes": [{"nodes": [0]}], "nodes": [{"camera": 0}])", "scenes", 1, 0);
  expect_warning(R"("scenes": [{"nodes": [0, @]}], "nodes": [{"camera": 0}, {}])", "nodes", 2, 1);
  expect_warning(R"("scenes": [{"nodes": [0]}], "nodes": [{"camera": 0, "children": [1, @]}, {}, {}])",
                 "nodes", 3, 1);
  expect_warning(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"camera": 0}, {"camera": @}])", "cameras", 1,
                 1);
  expect_warning(
      R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"camera": 0},
    {"extensions": {"KHR_lights_punctual": {"light": @}}}])",
      "lights", 2, 1);
}

TEST(GltfView, RejectsPerspectiveAnglesOutsideZeroToPi) {
  const auto view = [](const std::string& angle) {
    return view_of(R"("scenes": [{"nodes": [0, 0]}], "nodes": [{"camera": 0}])",
                   R"({"type": "perspective", "perspective": {"yfov": )" + angle + R"(, "znear": 1}})");
  };
  for (const char* angle : {"0.001", "3.1415"}) {
    EXPECT_EQ(view(angle).cameras.size(), 2u) << angle;
    EXPECT_TRUE(view(angle).warnings.empty()) << angle;
  }
  for (const std::string angle : {"0.0", "-0.7", "3.1416", "13.0", "1e+308", "-1e+308"}) {
    EXPECT_TRUE(view(angle).cameras.empty()) << angle;
    EXPECT_EQ(view(angle).warnings, std::vector{"a perspective camera is left out: found an angle of " +
                                                angle + ", expected one between 0 and pi"});
  }
}

}  // namespace
}  // namespace tessera::gltf_view_test
