#include "engine/program/cli/frame_palettes.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

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

bool has_same_colors(const FrameBufferFormat& a, const FrameBufferFormat& b) {
  const auto is_same = [](const Color& x, const Color& y) {
    return std::tie(x.r, x.g, x.b) == std::tie(y.r, y.g, y.b);
  };
  return a.color_mode == b.color_mode && a.color_bits == b.color_bits &&
         std::equal(a.palette.begin(), a.palette.end(), b.palette.begin(), b.palette.end(), is_same);
}

}  // namespace

bool frames_share_palette(SceneInput& input, int frames) {
  const Scene& first = input.scene();
  if (first.palette_source != PaletteSource::given && first.palette_over != PaletteOver::animation)
    return false;
  std::optional<FrameBufferFormat> shared;
  bool is_shared = true;
  for_pictures(input, frames, [&](const Scene& scene) {
    const FrameBufferFormat& format = scene.reduced ? *scene.reduced : scene.framebuffer;
    if (!shared) shared = format;
    is_shared = is_shared && has_same_colors(*shared, format);
  });
  return is_shared;
}

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
