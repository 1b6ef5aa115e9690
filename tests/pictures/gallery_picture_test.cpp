// The scenes of `tessera gallery`, drawn by the engine and by the reference renderer at half their size, by
// the rule of picture_harness.h. Options of the command, such as displays and their modes, are left out:
// scenes of which only these differ are compared once. Animations are compared in one picture between keys.
#include "tests/pictures/picture_harness.h"
#include "tests/reference/render.h"

#include "engine/program/scene/animate.h"
#include "engine/program/scene/scene.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test::gallery_picture_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFolder = TESSERA_SOURCE_DIR "/engine/program/gallery";
constexpr double kTime = 0.61;  // 0 to 1

std::string scene_text(const std::string& name) {
  std::ifstream stream(std::string(kFolder) + "/" + name + ".json");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Scenes that differ in more than their titles, each of which is one line.
std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  std::set<std::string> known;
  std::erase_if(names, [&](const std::string& name) {
    std::string text = scene_text(name);
    const std::size_t title = std::min(text.find("\"title\""), text.size());
    text.erase(title, text.find('\n', title) - title);
    return !known.insert(text).second;
  });
  return names;
}

/// Halves the numbers of an array, rounding down.
void halve(Json& numbers) {
  for (Json& number : numbers) number = number.get<int>() >> 1;
}

/// Halves the frame buffer and all window positions. Bitmaps, points and lines keep their sizes.
Json at_half_size(Json scene) {
  for (const char* key : {"width", "height"}) {
    Json& size = scene["framebuffer"][key];
    size = size.get<int>() / 2;
  }
  for (Json& command : scene["frame"])
    for (Json* object : {&command, &command.front()})
      if (object->is_object())
        for (const char* key : {"viewport", "scissor", "at"})
          if (object->contains(key)) halve((*object)[key]);
  return scene;
}

Rgb draw_by_engine(Json json) {
  program::json::animate(json, kTime, "gallery");
  const program::Scene scene = program::parse_scene(json.dump(), "gallery", kFolder);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  const int width = scene.framebuffer.width, height = scene.framebuffer.height;
  Rgb rgba(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Renderer().finish(
      frame,
      {.pixels = rgba.data(), .width = width, .height = height, .stride_bytes = std::ptrdiff_t{4} * width});
  Rgb rgb;
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return rgb;
}

class GalleryPicture : public testing::TestWithParam<std::string> {};

TEST_P(GalleryPicture, MatchesReference) {
  const Json scene = at_half_size(Json::parse(scene_text(GetParam())));
  ThreeWayReport report;
  report.name = "gallery_" + GetParam();
  report.mesa_cannot = "is compared with tests/scenes";
  const reference::Picture right = reference::render(reference::parse_scene(scene.dump(), kFolder, kTime));
  report.width_px = right.width_px;
  report.height_px = right.height_px;
  report.reference = right.rgb;
  report.engine = draw_by_engine(scene);
  report.engine_to_reference =
      reference::compare(report.reference, report.engine, right.width_px, right.height_px);
  if (!report.is_good()) ADD_FAILURE() << report.text() << "\n  pictures in " << write_pictures(report);
}

INSTANTIATE_TEST_SUITE_P(Gallery, GalleryPicture, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace tessera::test::gallery_picture_test
