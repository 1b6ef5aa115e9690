// Reads the commands of a frame, in order.
#include "engine/program/scene/read_draw.h"
#include "engine/program/scene/read_scene.h"

namespace tessera::program {
namespace {

using json::Object;
using json::Value;

Clear read_clear(const Value& value, const FrameBufferFormat& format) {
  const Object object(value, {"color", "index", "depth", "stencil", "accumulation", "scissor"});
  Clear clear;
  if (const auto color = object.find("color")) clear.color = color->color(0, 1);
  if (const auto index = object.find("index")) {
    if (format.color_mode != ColorMode::index)
      index->refuse("needs an index buffer: \"color\": {\"mode\": \"index\"}");
    clear.index = static_cast<std::uint32_t>(index->integer(0, kMaxUint32));
    clear.color.reset();  // the index takes precedence
  }
  if (const auto depth = object.find("depth")) {
    if (format.depth == DepthFormat::none)
      depth->refuse("needs a depth buffer, and the frame buffer's \"depth\" is \"none\"");
    clear.depth = depth->number(0, 1);
  }
  if (const auto stencil = object.find("stencil")) {
    if (format.stencil_bits == 0)
      stencil->refuse("needs a stencil buffer, and the frame buffer's \"stencil\" is 0");
    clear.stencil = static_cast<std::uint32_t>(stencil->integer(0, 255));
  }
  if (const auto accumulation = object.find("accumulation")) {
    if (format.accumulation_bits == 0)
      accumulation->refuse("needs an accumulation buffer, and the frame buffer's \"accumulation\" is 0");
    clear.accumulation = accumulation->color(-1, 1);
  }
  if (const auto scissor = object.find("scissor")) clear.scissor = scissor->rect();
  return clear;
}

Accum read_accum(const Value& value, const FrameBufferFormat& format) {
  if (format.color_mode == ColorMode::index) value.refuse("an index buffer does not accumulate");
  if (format.accumulation_bits == 0)
    value.refuse("needs an accumulation buffer, and the frame buffer's \"accumulation\" is 0");
  const Object object(value, {"op", "value", "scissor", "color_mask"});
  Accum accum;
  accum.op = object.require("op").choice<AccumOp>({{"accum", AccumOp::accum},
                                                   {"load", AccumOp::load},
                                                   {"add", AccumOp::add},
                                                   {"mult", AccumOp::mult},
                                                   {"return", AccumOp::return_color}});
  accum.value = object.require("value").number();
  if (const auto scissor = object.find("scissor")) accum.scissor = scissor->rect();
  if (const auto mask = object.find("color_mask")) accum.color_mask = read_color_mask(*mask, format);
  return accum;
}

std::vector<Command> read_command(const Value& value, const FrameObjects& objects,
                                  const std::string& base_folder, FileCache& cache) {
  static constexpr std::array<std::string_view, 8> kCommands{"clear",  "draw",   "bitmap",  "image",
                                                             "camera", "lights", "quality", "accum"};
  if (!value.json().is_object()) value.fail("an object with one of " + json::quoted_list(kCommands));
  if (value.json().contains("draw")) return read_draw(value, objects);
  if (value.json().empty()) value.fail("one of " + json::quoted_list(kCommands));
  const Object object(value, {"clear", "draw", "bitmap", "image", "camera", "lights", "quality", "accum"});
  if (value.json().size() != 1)
    value.refuse("found several commands in one object, expected one of " + json::quoted_list(kCommands));
  if (const auto clear = object.find("clear")) return {read_clear(*clear, objects.scene.framebuffer)};
  if (const auto bitmap = object.find("bitmap")) return {read_bitmap(*bitmap, objects.scene)};
  if (const auto image = object.find("image")) return {read_image(*image, objects.scene, base_folder, cache)};
  if (const auto accum = object.find("accum")) return {read_accum(*accum, objects.scene.framebuffer)};
  if (const auto camera = object.find("camera")) {
    const FrameBufferFormat& format = objects.scene.framebuffer;
    return {read_camera(*camera, base_folder, static_cast<double>(format.width) / format.height, cache)};
  }
  if (const auto quality = object.find("quality")) return {read_quality(*quality)};
  return {read_lights(object.require("lights"), base_folder, cache)};
}

}  // namespace
std::vector<SceneCommand> read_frame(const Value& value, const Scene& scene, const FrameNames& defined,
                                     const std::string& base_folder, FileCache& cache) {
  FrameObjects objects{.defined = defined, .scene = scene, .lights = scene.lights};
  for (const std::string& name : defined.meshes) objects.meshes.add(name);
  for (const auto& [name, material] : defined.materials) objects.materials.add(name);
  for (const std::string& name : defined.textures) objects.textures.add(name);
  std::vector<SceneCommand> frame;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value element = value.element(i);
    for (Command& command : read_command(element, objects, base_folder, cache)) {
      if (const auto* lights = std::get_if<LightList>(&command)) objects.lights = *lights;
      frame.push_back({std::move(command), element.pointer()});
    }
  }
  return frame;
}

std::vector<SceneCommand> default_frame(const Scene& scene, const FrameNames& names) {
  const bool has_depth = scene.framebuffer.depth != DepthFormat::none;
  const bool reversed = scene.camera.reversed;
  Clear clear{.color = Color{0, 0, 0, 1}};
  if (has_depth) clear.depth = reversed ? 0 : 1;
  if (scene.framebuffer.stencil_bits > 0) clear.stencil = 0;
  std::vector<SceneCommand> frame{{clear, ""}};
  for (std::size_t i = 0; i < names.meshes.size(); ++i) {
    DrawCommand draw{.mesh = i};
    draw.state.depth.enabled = has_depth;
    if (reversed) draw.state.depth.test = Compare::greater;
    const auto parts = names.file_draws.find(i);
    if (parts == names.file_draws.end()) {
      frame.push_back({draw, ""});
      continue;
    }
    const bool can_blend = scene.framebuffer.color_mode == ColorMode::rgb;
    for (const DrawCommand& part : parts->second)
      frame.push_back({with_file_state(draw, part, {}, can_blend), ""});
  }
  return frame;
}

}  // namespace tessera::program
