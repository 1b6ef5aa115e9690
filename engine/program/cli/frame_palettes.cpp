#include "engine/program/cli/frame_palettes.h"

#include <cstdint>
#include <span>

#include "engine/program/scene/chosen_palette.h"

namespace tessera::program::cli {
namespace {

/// Calls visit(scene) at the time of each picture; once if they are all the same.
template <class Visit>
void for_pictures(SceneInput& input, int frames, const Visit& visit) {
  const int visits = input.is_animated() ? frames : 1;
  for (int f = 0; f < visits; ++f) {
    input.move_to(input.frame_time(f, frames));
    visit(input.scene());
  }
}

std::vector<Color> adaptive_of_animation(SceneInput& input, int frames, Renderer& renderer) {
  PictureColors colors;
  for_pictures(input, frames, [&](const Scene& scene) {
    colors.add(std::span<const std::uint8_t>(picture_for_palette(scene, renderer).rgba));
  });
  return adaptive_palette(colors, scene_palette_request(input.scene()));
}

std::vector<Color> ramps_of_animation(SceneInput& input, int frames, Renderer& renderer) {
  RampColors ramps;
  for_pictures(input, frames, [&](const Scene& scene) {
    check_stores_colors(scene);
    add_ramp_colors(scene, renderer, ramps);
  });
  return ramp_palette(ramps.groups, ramps.colors, scene_palette_request(input.scene()));
}

}  // namespace

FramePalettes::FramePalettes(SceneInput& input, int frames, Renderer& renderer) {
  const PaletteSource source = input.scene().palette_source;
  const PaletteOver over = input.scene().palette_over;
  if (source == PaletteSource::given || over == PaletteOver::frame) return;
  if (over == PaletteOver::smooth) smooth_.emplace(scene_palette_request(input.scene()));
  else
    shared_ = source == PaletteSource::adaptive ? adaptive_of_animation(input, frames, renderer)
                                                : ramps_of_animation(input, frames, renderer);
}

std::optional<std::vector<Color>> FramePalettes::next(const Scene& scene, Renderer& renderer) {
  if (scene.palette_source == PaletteSource::given) return std::nullopt;
  if (shared_) return shared_;
  if (!smooth_) return choose_palette(scene, renderer);
  PictureColors colors;
  colors.add(std::span<const std::uint8_t>(picture_for_palette(scene, renderer).rgba));
  return smooth_->follow(colors);
}

}  // namespace tessera::program::cli
