#include "engine/program/scene/scene.h"

namespace tessera::program {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

// Calls run(); an Error gets the name of the scene and of the command in front.
template <class Run>
void at_command(const Scene& scene, const SceneCommand& command, const Run& run) {
  try {
    run();
  } catch (const Error& error) {
    throw Error(scene.name + ": " + (command.pointer.empty() ? "" : command.pointer + ": ") + error.what());
  }
}

// A stored index is masked to the buffer's bits, a stencil value likewise.
Clear masked(Clear clear, const FrameBufferFormat& format) {
  if (clear.index) *clear.index &= (std::uint32_t{1} << format.color_bits) - 1;
  if (clear.stencil) *clear.stencil &= (std::uint32_t{1} << format.stencil_bits) - 1;
  return clear;
}

}  // namespace

Camera SceneCamera::at_aspect(double aspect) const {
  const auto matrix = std::visit(
      Overloaded{
          [&](const Lens& lens) { return perspective(lens.fovy, aspect, lens.near, lens.far, reversed); },
          [](const Matrix& given) { return given; }},
      projection);
  return {.view = view, .projection = matrix, .reversed = reversed};
}

int palette_bits(std::string_view name) { return name == "bw" ? 1 : name == "ega16" ? 4 : 8; }

void apply(const SceneOverrides& overrides, Scene& scene) {
  FrameBufferFormat& format = scene.framebuffer;
  if (overrides.width) format.width = *overrides.width;
  if (overrides.height) format.height = *overrides.height;
  if (format.width < 1 || format.width > kMaxFrameBufferSize || format.height < 1 ||
      format.height > kMaxFrameBufferSize)
    throw Error("the picture's size is " + std::to_string(format.width) + "x" +
                std::to_string(format.height) + ", must be 1x1 .. " + std::to_string(kMaxFrameBufferSize) +
                "x" + std::to_string(kMaxFrameBufferSize));

  if (overrides.palette) {
    const bool was_index = format.color_mode == ColorMode::index;
    format.color_mode = ColorMode::index;
    scene.palette_name = *overrides.palette;
    if (!was_index) format.color_bits = palette_bits(scene.palette_name);
  }
  if (overrides.color_bits) format.color_bits = *overrides.color_bits;
  if (format.color_bits < 1 || format.color_bits > 24)
    throw Error("color bits are " + std::to_string(format.color_bits) + ", must be 1 .. 24");
  if (!scene.palette_name.empty()) format.palette = named_palette(scene.palette_name, format.color_bits);
  if (format.palette.size() > std::size_t{1} << format.color_bits)
    throw Error("the scene's palette has " + std::to_string(format.palette.size()) + " entries, " +
                std::to_string(format.color_bits) + " color bits hold " +
                std::to_string(1 << format.color_bits));

  // What is overridden no longer changes within the frame.
  if (overrides.camera) {
    const auto override_camera = [&](SceneCamera& camera) {
      const bool reversed = camera.reversed;  // as the depth clears and tests are
      camera = *overrides.camera;
      camera.reversed = reversed;
    };
    override_camera(scene.camera);
    for (SceneCommand& command : scene.frame)
      if (auto* camera = std::get_if<SceneCamera>(&command.what)) override_camera(*camera);
  }
  if (!overrides.lights.empty()) {
    scene.lights = overrides.lights;
    std::erase_if(scene.frame, [](const SceneCommand& command) {
      return std::holds_alternative<LightList>(command.what);
    });
  }
  if (overrides.shading)
    for (SceneCommand& command : scene.frame)
      if (auto* draw = std::get_if<DrawCommand>(&command.what)) draw->state.shading = *overrides.shading;
}

void record(const Scene& scene, Frame& frame) {
  const double aspect = static_cast<double>(scene.framebuffer.width) / scene.framebuffer.height;
  frame.set_light_model(scene.light_model);
  frame.set_camera(scene.camera.at_aspect(aspect));
  frame.set_lights(scene.lights);
  for (const SceneCommand& command : scene.frame)
    at_command(scene, command, [&] {
      std::visit(
          Overloaded{[&](const Clear& clear) { frame.clear(masked(clear, scene.framebuffer)); },
                     [&](const DrawCommand& draw) { frame.draw(scene.meshes[draw.mesh].view(), draw.state); },
                     [&](const BitmapCommand& bitmap) { frame.draw_bitmap(bitmap.view(), bitmap.state); },
                     [&](const ImageCommand& image) { frame.draw_image(image.view(), image.state); },
                     [&](const Accum& accum) { frame.accumulate(accum); },
                     [&](const SceneCamera& camera) { frame.set_camera(camera.at_aspect(aspect)); },
                     [&](const LightList& lights) { frame.set_lights(lights); }},
          command.what);
    });
}

}  // namespace tessera::program
