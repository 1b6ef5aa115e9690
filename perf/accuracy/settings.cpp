#include "perf/accuracy/settings.h"

#include <algorithm>

namespace tessera::accuracy {
namespace {

using program::DrawCommand;
using program::Scene;
using program::SceneCommand;

/// Calls take(state) for every draw.
template <class Take>
void for_each_draw(const Scene& scene, const Take& take) {
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) take(draw->state);
}

template <class Test>
bool any_draw(const Scene& scene, const Test& test) {
  bool found = false;
  for_each_draw(scene, [&](const DrawState& state) { found = found || test(state); });
  return found;
}

/// Whether a picture of half the size is the same picture with fewer pixels: no command counts pixels.
bool is_free_of_pixel_units(const Scene& scene) {
  for (const SceneCommand& command : scene.frame) {
    if (std::holds_alternative<program::BitmapCommand>(command.value) ||
        std::holds_alternative<program::ImageCommand>(command.value))
      return false;
    if (const auto* clear = std::get_if<Clear>(&command.value); clear != nullptr && clear->scissor)
      return false;
    if (const auto* accum = std::get_if<Accum>(&command.value); accum != nullptr && accum->scissor)
      return false;
  }
  const auto counts_pixels = [](const DrawState& state) {
    return state.viewport || state.scissor || state.point_size != 1 || state.line_width != 1;
  };
  return !any_draw(scene, counts_pixels) && scene.framebuffer.width % 4 == 0 &&
         scene.framebuffer.height % 4 == 0;
}

bool uses_accumulation(const Scene& scene) {
  return std::any_of(scene.frame.begin(), scene.frame.end(), [](const SceneCommand& command) {
    return std::holds_alternative<Accum>(command.value);
  });
}

/// Steps of the dial that change shading.
std::vector<Setting> shading_steps() {
  const auto step = [](const std::string& name, const std::string& label, const std::string& text,
                       const Quality& quality) {
    return Setting{name, label, "dial", text, {.quality = quality}};
  };
  return {
      step("phong_2x2", "2x2", "Phong shading lights once per 2x2 pixels",
           {.shading = ShadingCap::phong_2x2}),
      step("phong_4x4", "4x4", "Phong shading lights once per 4x4 pixels",
           {.shading = ShadingCap::phong_4x4}),
      step("gouraud", "gouraud", "Phong shading becomes Gouraud shading", {.shading = ShadingCap::gouraud}),
      step("flat", "flat", "every draw is flat", {.shading = ShadingCap::flat})};
}

/// Steps of the dial other than shading that the scene can feel.
std::vector<Setting> other_steps(const Scene& scene) {
  const bool is_lit = any_draw(scene, [](const DrawState& state) { return state.lighting; });
  const bool is_lit_per_pixel = any_draw(
      scene, [](const DrawState& state) { return state.lighting && state.shading == Shading::phong; });
  std::vector<Setting> steps;
  const auto add = [&](const std::string& name, const std::string& text, const Quality& quality) {
    steps.push_back({name, name, "dial", text, {.quality = quality}});
  };
  if (is_lit_per_pixel)
    add("not_renormalized", "interpolated normals are used as they are", {.renormalize = false});
  if (is_lit && scene.light_model.local_viewer)
    add("infinite_viewer", "highlights as if the viewer were infinitely far away",
        {.viewer = ViewerCap::infinite});
  add("affine", "interpolation is linear in the window", {.interpolation = InterpolationCap::affine});
  if (any_draw(scene, [](const DrawState& state) { return state.texture != nullptr; })) {
    add("bilinear", "textures without mipmaps", {.texture = TextureCap::bilinear});
    add("nearest", "the nearest texel, without mipmaps", {.texture = TextureCap::nearest});
  }
  if (is_lit)
    add("light_threshold_16", "lights whose summed contribution to a draw stays below 16 levels are left out",
        {.light_threshold = 16.0f / 255});
  return steps;
}

std::vector<Setting> buffer_choices(const Scene& scene) {
  std::vector<Setting> choices;
  const auto add = [&](const std::string& name, const std::string& group, const std::string& text,
                       const Variation& variation) {
    choices.push_back({name, name, group, text, variation});
  };
  for (const int samples : {4, 8}) {
    const std::string number = std::to_string(samples);
    if (scene.framebuffer.samples < samples)
      add("samples_" + number, "samples", number + " coverage samples per pixel", {.samples = samples});
  }
  if (!uses_accumulation(scene) && scene.framebuffer.alpha_bits == 0)
    for (const int passes : {4, 8, 16}) {
      const std::string number = std::to_string(passes);
      add("jitter_" + number, "jitter",
          "the mean of " + number + " frames at positions shifted by less than a pixel", {.passes = passes});
    }
  const std::pair<DepthFormat, const char*> formats[] = {{DepthFormat::unorm16, "16"},
                                                         {DepthFormat::unorm24, "24"},
                                                         {DepthFormat::unorm32, "32"},
                                                         {DepthFormat::float32, "float"}};
  if (scene.framebuffer.depth != DepthFormat::none)
    for (const auto& [format, bits] : formats)
      if (scene.framebuffer.depth != format)
        add(std::string("depth_") + bits, "depth",
            std::string("depth buffer of ") + bits + (format == DepthFormat::float32 ? " values" : " bits"),
            {.depth = format});
  for (const int bits : {16, 12, 8}) {
    if (scene.framebuffer.color_bits <= bits) continue;
    const std::string number = std::to_string(bits);
    add("color_" + number, "color", number + " colour bits, rounded",
        {.color_bits = bits, .dither = Dither::none});
    add("color_" + number + "_dither", "color", number + " colour bits, dithered by an 8x8 Bayer matrix",
        {.color_bits = bits, .dither = Dither::bayer8});
  }
  if (is_free_of_pixel_units(scene)) {
    add("half", "resolution", "half the width and height, enlarged bilinearly", {.divisor = 2});
    add("quarter", "resolution", "a quarter of the width and height, enlarged bilinearly", {.divisor = 4});
  }
  return choices;
}

/// All combinations of two or three of shading, samples and resolution.
std::vector<Setting> combinations(const std::vector<Setting>& shadings, const std::vector<Setting>& choices) {
  const auto of_group = [&](const char* group) {
    std::vector<Setting> found(1);  // an empty setting: unchanged
    for (const Setting& choice : choices)
      if (choice.group == group) found.push_back(choice);
    return found;
  };
  std::vector<Setting> shading(1);
  shading.insert(shading.end(), shadings.begin(), shadings.end());
  std::vector<Setting> combined;
  for (const Setting& a : shading)
    for (const Setting& b : of_group("samples"))
      for (const Setting& c : of_group("resolution")) {
        Setting setting{.group = "combined"};
        int parts = 0;
        for (const Setting* part : {&a, &b, &c}) {
          if (part->name.empty()) continue;
          const bool is_first = parts++ == 0;
          setting.name += (is_first ? "" : "+") + part->name;
          setting.label +=
              (is_first ? "" : "+") +
              (part->group == "samples" ? "s" + std::to_string(*part->variation.samples) : part->label);
          setting.text += (is_first ? "" : "; ") + part->text;
        }
        setting.variation = {
            .quality = a.variation.quality, .samples = b.variation.samples, .divisor = c.variation.divisor};
        if (parts >= 2) combined.push_back(std::move(setting));
      }
  return combined;
}

}  // namespace

std::vector<Setting> settings_for(const Scene& scene, SettingChoice choice) {
  std::vector<Setting> settings{{kDefaultSetting, kDefaultSetting, "default", "as the scene asks", {}}};
  const auto append = [&settings](const std::vector<Setting>& more) {
    settings.insert(settings.end(), more.begin(), more.end());
  };
  const std::vector<Setting> shadings = shading_steps();
  append(shadings);
  if (choice == SettingChoice::shading) return settings;
  append(other_steps(scene));
  const std::vector<Setting> choices = buffer_choices(scene);
  append(choices);
  if (choice == SettingChoice::all) append(combinations(shadings, choices));
  return settings;
}

}  // namespace tessera::accuracy
