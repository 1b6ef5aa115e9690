#include "engine/program/scene/scene_mode.h"

#include <algorithm>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/suggest.h"

namespace tessera::program {

DisplayMode named_display_mode(const std::string& name) {
  try {
    return display_mode(name);
  } catch (const Error& error) {
    std::vector<std::string_view> names;
    for (const DisplayMode& mode : display_modes()) names.push_back(mode.name);
    const std::string base = name.substr(0, name.find(':'));
    const bool is_known = std::find(names.begin(), names.end(), base) != names.end();
    std::string message = error.what();
    constexpr std::string_view kFunction = "display_mode: ";  // the user called none
    if (message.starts_with(kFunction)) message.erase(0, kFunction.size());
    if (!is_known && error.code() != ErrorCode::unsupported) message += did_you_mean(base, names);
    throw Error(error.code(), message);
  }
}

namespace {

void copy_dither(const FrameBufferFormat& from, FrameBufferFormat& to) {
  to.dither = from.dither;
  to.dither_in = from.dither_in;
  to.dither_gamma = from.dither_gamma;
}

}  // namespace

void set_mode(const DisplayMode& mode, Scene& scene) {
  FrameBufferFormat colors = frame_buffer_format(mode);
  FrameBufferFormat& format = scene.framebuffer;
  if (scene.reduced) copy_dither(*scene.reduced, format);
  format.width = colors.width;
  format.height = colors.height;
  format.color_mode = colors.color_mode;
  format.color_bits = colors.color_bits;
  format.palette = std::move(colors.palette);
  scene.palette_name.clear();
  scene.palette_source = PaletteSource::given;
  scene.mode = mode;
  scene.reduced.reset();
}

void set_mode_palette(std::span<const Color> palette, Scene& scene) {
  check_palette(*scene.mode, palette);
  scene.palette_source = PaletteSource::given;
  scene.mode->palette.assign(palette.begin(), palette.end());
  (scene.reduced ? *scene.reduced : scene.framebuffer).palette = scene.mode->palette;
}

void set_mode_palette(PaletteSource source, Scene& scene) {
  palette_request(*scene.mode);  // refuses modes whose palette cannot be chosen
  scene.palette_source = source;
}

void set_mode_palette(const std::string& name, Scene& scene) {
  const PaletteSource source = palette_source(name);
  if (source == PaletteSource::given) set_mode_palette(named_palette(name, scene.mode->color_bits), scene);
  else set_mode_palette(source, scene);
}

void reduce_to_mode(Scene& scene) {
  if (scene.reduced) return;
  FrameBufferFormat& format = scene.framebuffer;
  scene.reduced = scene.mode ? frame_buffer_format(*scene.mode) : format;
  scene.reduced->depth = DepthFormat::none;
  scene.reduced->stencil_bits = 0;
  copy_dither(format, *scene.reduced);
  format.color_mode = ColorMode::rgb;
  format.color_bits = 24;
  format.palette.clear();
  format.dither = Dither::none;
}

void reduce_transparent_model(Scene& scene) {
  if (!scene.is_model || scene.reduced || scene.framebuffer.color_mode != ColorMode::index) return;
  const bool is_transparent = std::ranges::any_of(scene.frame, [](const SceneCommand& command) {
    const auto* draw = std::get_if<DrawCommand>(&command.value);
    return draw != nullptr && (draw->state.blend || draw->state.alpha_test);
  });
  if (!is_transparent) return;
  reduce_to_mode(scene);
  scene.warnings.push_back(scene.name +
                           ": transparency needs colours: the model is drawn at 24 bits and then reduced");
}

void apply_mode(const SceneOverrides& overrides, Scene& scene) {
  const bool was_reduced = scene.reduced.has_value();
  if (overrides.mode) set_mode(*overrides.mode, scene);
  if (overrides.width || overrides.height)
    throw Error("the size is that of display mode \"" + scene.mode->name + "\" and cannot be set");
  if (overrides.color_bits)
    throw Error("the color bits are those of display mode \"" + scene.mode->name + "\" and cannot be set");
  if (overrides.palette) set_mode_palette(*overrides.palette, scene);
  if (overrides.reduce || was_reduced) reduce_to_mode(scene);
}

void reduce_picture(Renderer& renderer, Picture& picture, FrameBuffer& buffer) {
  const Picture source = picture;
  Frame frame(buffer);
  frame.draw_image({.pixels = source.rgba.data(), .width = source.width, .height = source.height},
                   {.depth = {.enabled = false}});
  frame.keep({Buffer::color});
  renderer.finish(frame, picture.target());
}

}  // namespace tessera::program
