#include "engine/program/scene/chosen_palette.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

namespace tessera::program {
namespace {

[[noreturn]] void refuse_indices(const Scene& scene, const SceneCommand& command, const std::string& what) {
  throw Error(scene.name + ": " + (command.pointer.empty() ? "" : command.pointer + ": ") + what +
              " stores palette indices; they have no colours that a palette could be chosen for");
}

}  // namespace

PaletteRequest scene_palette_request(const Scene& scene) {
  if (scene.mode) return palette_request(*scene.mode);
  return {.count = std::min(1 << scene.framebuffer.color_bits, kMaxChosenEntries)};
}

void check_palette_over(const Scene& scene) {
  if (scene.palette_source == PaletteSource::ramps && scene.palette_over == PaletteOver::smooth)
    throw Error(
        "a smooth palette follows pictures, and the palette \"ramps\" is chosen without them; expected "
        "\"adaptive\", or one palette per \"frame\" or \"animation\"");
}

void check_stores_colors(const Scene& scene) {
  for (const SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.value); clear && clear->index)
      refuse_indices(scene, command, "a clear");
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) {
      const DrawState& state = draw->state;
      if (state.lighting && state.material.index_ramp) refuse_indices(scene, command, "a material");
      if (!state.lighting && !scene.meshes[draw->mesh].color_indices.empty())
        refuse_indices(scene, command, "a mesh");
    }
  }
}

Picture picture_for_palette(const Scene& scene, Renderer& renderer) {
  check_stores_colors(scene);
  FrameBufferFormat format = scene.framebuffer;
  format.color_mode = ColorMode::rgb;
  format.color_bits = 24;
  format.palette.clear();
  format.dither = Dither::none;
  FrameBuffer buffer(format);
  Frame frame(buffer, renderer);
  record(scene, frame);
  Picture picture(format.width, format.height);
  renderer.finish(frame, picture.target());
  return picture;
}

std::vector<Color> choose_palette(const Scene& scene, Renderer& renderer) {
  const PaletteRequest request = scene_palette_request(scene);
  if (scene.palette_source == PaletteSource::ramps) {
    check_stores_colors(scene);
    RampColors ramps;
    add_ramp_colors(scene, renderer, ramps);
    return ramp_palette(ramps.groups, ramps.colors, request);
  }
  const Picture picture = picture_for_palette(scene, renderer);
  return adaptive_palette(std::span<const std::uint8_t>(picture.rgba), request);
}

}  // namespace tessera::program
