// Time to choose a palette for a finished picture.
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/program/scene/scene.h"
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {
namespace {

/// Chooses the adaptive palette of a picture of the built-in scene under four coloured lights: some ten
/// thousand distinct colours at 640x480.
class PaletteWorkload : public Workload {
 public:
  explicit PaletteWorkload(const WorkloadSetup& setup) : picture_(setup.width, setup.height) {
    Scene scene = builtin_scene();
    scene.framebuffer.width = setup.width;
    scene.framebuffer.height = setup.height;
    scene.lights = {};
    constexpr Color kColors[] = {{1, 0.2f, 0.2f, 1}, {0.2f, 1, 0.2f, 1}, {0.2f, 0.2f, 1, 1}, {1, 1, 0.6f, 1}};
    constexpr float kDirections[][2] = {{1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    for (std::size_t i = 0; i < std::size(kColors); ++i)
      scene.lights.push_back({.diffuse = kColors[i],
                              .specular = kColors[i],
                              .position = {kDirections[i][0], kDirections[i][1], 1, 0}});
    for (SceneCommand& command : scene.frame)
      if (auto* draw = std::get_if<DrawCommand>(&command.value)) draw->state.material.diffuse = {1, 1, 1, 1};
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    Renderer(setup.options).finish(frame, picture_.target());
  }

  FrameStats draw() override {
    palette_ = adaptive_palette(std::span<const std::uint8_t>(picture_.rgba));
    return {};
  }
  std::string fault() override {
    draw();
    std::set<std::array<float, 3>> distinct;
    for (const Color& entry : palette_) distinct.insert({entry.r, entry.g, entry.b});
    return distinct.size() == 256 ? "" : std::to_string(distinct.size()) + " distinct entries, expected 256";
  }
  const Picture& picture() override { return picture_; }
  FrameWork work(const FrameStats&) const override {
    return {.pixels = picture_.rgba.size() / 4, .bytes = picture_.rgba.size()};
  }

 private:
  Picture picture_;
  std::vector<Color> palette_;
};

}  // namespace

std::vector<WorkloadEntry> palette_workloads() {
  return {{.name = "palette-256",
           .description = "an adaptive palette of 256 entries chosen for a finished picture; one thread",
           .is_in_mean = false,
           .make = [](const WorkloadSetup& setup) { return std::make_unique<PaletteWorkload>(setup); }}};
}

}  // namespace tessera::bench
