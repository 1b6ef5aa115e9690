#include "perf/bench/dither_workloads.h"

#include <memory>
#include <set>

#include "engine/program/scene/scene.h"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench {
namespace {

using namespace program;

struct Kind {
  std::string name;
  std::string description;
  Dither dither;
  DitherSpace space = DitherSpace::levels;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kAll{
      {"none", "rounded to the nearest", Dither::none},
      {"bayer8", "8x8 Bayer matrix", Dither::bayer8},
      {"blue-noise", "64x64 blue noise", Dither::blue_noise},
      {"blue-noise-light", "64x64 blue noise in light", Dither::blue_noise, DitherSpace::light},
      {"pattern", "two mixed palette entries", Dither::pattern},
      {"floyd-steinberg", "Floyd-Steinberg", Dither::floyd_steinberg},
      {"jarvis", "Jarvis-Judice-Ninke", Dither::jarvis},
  };
  return kAll;
}

FrameBufferFormat rgb16() { return {.color_bits = 16}; }
FrameBufferFormat indices256() { return {.color_mode = ColorMode::index, .color_bits = 8}; }

/// A dither, or none, shows several colours.
std::string too_few_colors(const Picture& picture) {
  std::set<std::uint32_t> colors;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    colors.insert(picture.rgba[i] << 16 | picture.rgba[i + 1] << 8 | picture.rgba[i + 2]);
  return colors.size() >= 3 ? "" : "the picture has fewer than 3 colours";
}

Drawing dithered(int width, int height, FrameBufferFormat format, const Kind& kind) {
  Scene scene = builtin_scene();
  apply({.width = width, .height = height, .shading = Shading::phong}, scene);
  format.width = width;
  format.height = height;
  format.dither = kind.dither;
  format.dither_in = kind.space;
  scene.framebuffer = format;
  const auto shared = std::make_shared<const Scene>(std::move(scene));
  Drawing drawing;
  drawing.format = format;
  drawing.meshes = shared->meshes;
  drawing.stores_planes = true;
  drawing.record = [shared](const Drawing&, Frame& frame) { record(*shared, frame); };
  drawing.fault = too_few_colors;
  return drawing;
}

}  // namespace

std::vector<WorkloadEntry> dither_workloads() {
  std::vector<WorkloadEntry> list;
  const auto add = [&](const Kind& kind, const std::string& suffix, const std::string& target,
                       FrameBufferFormat (*format)()) {
    list.push_back(drawn_outside_mean(
        "dither-" + kind.name + suffix,
        "the teapot with Phong shading in " + target + ", " + kind.description,
        [=](int width, int height, std::uint32_t) { return dithered(width, height, format(), kind); }));
  };
  for (const Kind& kind : kinds())
    if (kind.dither != Dither::pattern) add(kind, "-16", "16 bits", rgb16);
  for (const Kind& kind : kinds()) add(kind, "-256", "256 colours", indices256);
  return list;
}

}  // namespace tessera::bench
