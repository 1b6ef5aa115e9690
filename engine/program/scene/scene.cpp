#include "engine/program/scene/scene.h"

#include <span>

#include "engine/program/scene/chosen_palette.h"
#include "engine/program/scene/follow_camera.h"
#include "engine/program/scene/scene_mode.h"

namespace tessera::program {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

// Calls run(); prefixes the message of an Error with the names of scene and command.
template <class Run>
void at_command(const Scene& scene, const SceneCommand& command, const Run& run) {
  try {
    run();
  } catch (const Error& error) {
    throw Error(error.code(),
                scene.name + ": " + (command.pointer.empty() ? "" : command.pointer + ": ") + error.what());
  }
}

// Masks index and stencil value to the bits of the buffers.
Clear masked(Clear clear, const FrameBufferFormat& format) {
  if (clear.index) *clear.index &= (std::uint32_t{1} << format.color_bits) - 1;
  if (clear.stencil) *clear.stencil &= (std::uint32_t{1} << format.stencil_bits) - 1;
  return clear;
}

}  // namespace

Mesh DrawCommand::view(const std::vector<MeshData>& meshes) const {
  Mesh view = meshes[mesh].view();
  if (index_count > 0) view.indices = std::span(meshes[mesh].indices).subspan(first_index, index_count);
  return view;
}

Camera SceneCamera::at_aspect(double aspect) const {
  const auto matrix = std::visit(
      Overloaded{
          [&](const Lens& lens) { return perspective(lens.fovy, aspect, lens.near, lens.far, reversed); },
          [](const Matrix& given) { return given; }},
      projection);
  return {.view = view, .projection = matrix, .reversed = reversed};
}

SceneCamera camera_at(const Viewpoint& viewpoint, const Lens& lens) {
  return {.view = look_at(viewpoint.eye, viewpoint.target, viewpoint.up),
          .projection = lens,
          .viewpoint = viewpoint};
}

int palette_bits(std::string_view name) {
  if (name == "bw") return 1;
  if (name == "ega16") return 4;
  return 8;
}

PaletteSource palette_source(std::string_view name) {
  if (name == "adaptive") return PaletteSource::adaptive;
  return name == "ramps" ? PaletteSource::ramps : PaletteSource::given;
}

namespace {

// Size, bits and palette of a scene without a display mode.
void apply_format(const SceneOverrides& overrides, Scene& scene) {
  if (overrides.reduce)
    throw Error(
        "colors are reduced to those of a display mode, and the scene has none; name one with --mode");
  FrameBufferFormat& format = scene.framebuffer;
  if (overrides.width) format.width = *overrides.width;
  if (overrides.height) format.height = *overrides.height;
  const auto is_valid_size = [](int size) { return size >= 1 && size <= kMaxFrameBufferSize; };
  if (!is_valid_size(format.width) || !is_valid_size(format.height))
    throw Error("the picture is " + std::to_string(format.width) + "x" + std::to_string(format.height) +
                ", each side must be 1 to " + std::to_string(kMaxFrameBufferSize));

  if (overrides.palette) {
    const bool was_index = format.color_mode == ColorMode::index;
    format.color_mode = ColorMode::index;
    scene.palette_source = palette_source(*overrides.palette);
    const bool is_given = scene.palette_source == PaletteSource::given;
    scene.palette_name = is_given ? *overrides.palette : "";
    if (!is_given) format.palette.clear();
    if (!was_index) format.color_bits = palette_bits(scene.palette_name);
  }
  if (overrides.color_bits) format.color_bits = *overrides.color_bits;
  if (format.color_bits < 1 || format.color_bits > 24)
    throw Error("color bits are " + std::to_string(format.color_bits) + ", must be 1 to 24");
  if (!scene.palette_name.empty()) format.palette = named_palette(scene.palette_name, format.color_bits);
  if (format.palette.size() > std::size_t{1} << format.color_bits)
    throw Error("the scene's palette has " + std::to_string(format.palette.size()) +
                " entries, expected at most " + std::to_string(1 << format.color_bits) + " for " +
                std::to_string(format.color_bits) + " color bits");
}

void set_samples(int samples, Scene& scene) {
  if (samples > 1 && scene.framebuffer.color_mode == ColorMode::index)
    throw Error(
        std::to_string(samples) +
        " samples per pixel need RGB colors, and the frame buffer holds palette indices, which have no "
        "mean");
  scene.framebuffer.samples = samples;
}

void set_shading(Shading shading, Scene& scene) {
  for (SceneCommand& command : scene.frame)
    if (auto* draw = std::get_if<DrawCommand>(&command.value)) draw->state.shading = shading;
  if (!scene.blended) return;
  for (DrawCommand& draw : scene.blended->draws) draw.state.shading = shading;
}

/// Replaces the colour of all clears; without any, clears first.
void set_background(const Color& color, Scene& scene) {
  const bool is_transparent = color.a < 1;
  if (is_transparent) scene.framebuffer.alpha_bits = 8;
  bool clears = false;
  for (SceneCommand& command : scene.frame)
    if (auto* clear = std::get_if<Clear>(&command.value); clear != nullptr && clear->color) {
      clear->color = color;
      clears = true;
    }
  if (!clears) scene.frame.insert(scene.frame.begin(), SceneCommand{Clear{.color = color}, ""});
}

void draw_edges(Scene& scene) {
  for (SceneCommand& command : scene.frame)
    if (auto* draw = std::get_if<DrawCommand>(&command.value))
      draw->state.front_mode = draw->state.back_mode = PolygonMode::line;
  if (!scene.blended) return;
  for (DrawCommand& draw : scene.blended->draws)
    draw.state.front_mode = draw.state.back_mode = PolygonMode::line;
}

}  // namespace

void apply(const SceneOverrides& overrides, Scene& scene) {
  if (overrides.mode || scene.mode) apply_mode(overrides, scene);
  else apply_format(overrides, scene);
  if (overrides.palette_over) {
    if (scene.palette_source == PaletteSource::given)
      throw Error(
          "a choice of the pictures that share a palette needs the palette \"adaptive\" or \"ramps\"");
    scene.palette_over = *overrides.palette_over;
  }
  check_palette_over(scene);
  FrameBufferFormat& stored = scene.reduced ? *scene.reduced : scene.framebuffer;
  stored.dither = overrides.dither.value_or(stored.dither);
  stored.dither_in = overrides.dither_in.value_or(stored.dither_in);
  stored.dither_gamma = overrides.dither_gamma.value_or(stored.dither_gamma);

  // Overridden cameras, lights and caps hold for the whole frame.
  if (overrides.camera) {
    const auto override_camera = [&](SceneCamera& camera) {
      const bool reversed = camera.reversed;  // the scene's depth clears and tests rely on it
      camera = *overrides.camera;
      camera.reversed = reversed;
    };
    override_camera(scene.camera);
    for (SceneCommand& command : scene.frame)
      if (auto* camera = std::get_if<SceneCamera>(&command.value)) override_camera(*camera);
  }
  if (!overrides.lights.empty()) {
    scene.lights = overrides.lights;
    scene.has_shoulder_light = false;
    std::erase_if(scene.frame, [](const SceneCommand& command) {
      return std::holds_alternative<LightList>(command.value);
    });
  }
  if (overrides.quality) {
    scene.quality = *overrides.quality;
    std::erase_if(scene.frame,
                  [](const SceneCommand& command) { return std::holds_alternative<Quality>(command.value); });
  }
  if (overrides.camera) follow_camera(scene);  // replaces draws
  if (overrides.shading) set_shading(*overrides.shading, scene);
  if (overrides.samples) set_samples(*overrides.samples, scene);
  if (overrides.background) set_background(*overrides.background, scene);
  if (overrides.wireframe) draw_edges(scene);
  reduce_transparent_model(scene);
}

void record(const Scene& scene, Frame& frame) {
  const double aspect = scene.mode ? scene.mode->screen_aspect()
                                   : static_cast<double>(scene.framebuffer.width) / scene.framebuffer.height;
  frame.set_light_model(scene.light_model);
  frame.set_camera(scene.camera.at_aspect(aspect));
  frame.set_lights(scene.lights);
  frame.set_quality(scene.quality);
  for (const SceneCommand& command : scene.frame)
    at_command(scene, command, [&] {
      std::visit(
          Overloaded{[&](const Clear& clear) { frame.clear(masked(clear, scene.framebuffer)); },
                     [&](const DrawCommand& draw) { frame.draw(draw.view(scene.meshes), draw.state); },
                     [&](const BitmapCommand& bitmap) { frame.draw_bitmap(bitmap.view(), bitmap.state); },
                     [&](const ImageCommand& image) { frame.draw_image(image.view(), image.state); },
                     [&](const Accum& accum) { frame.accumulate(accum); },
                     [&](const SceneCamera& camera) { frame.set_camera(camera.at_aspect(aspect)); },
                     [&](const LightList& lights) { frame.set_lights(lights); },
                     [&](const Quality& quality) { frame.set_quality(quality); }},
          command.value);
    });
}

}  // namespace tessera::program
