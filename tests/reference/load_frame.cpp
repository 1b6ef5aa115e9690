// The list of commands of a frame.
#include "scene_parts.h"

namespace tessera::reference {
namespace {

Command parse_command(const Value& v, const Scene& scene, const std::string& directory,
                      const std::vector<Light>& lights_in_force) {
  const double aspect = static_cast<double>(scene.framebuffer.width_px) / scene.framebuffer.height_px;
  if (v.json->is_object() && v.json->contains("draw")) return parse_draw(v, scene, lights_in_force);
  ObjectReader reader(v);
  if (v.json->size() != 1) fail(v.pointer, "one command");
  const Value clear = reader.find("clear");
  const Value camera = reader.find("camera");
  const Value lights = reader.find("lights");
  const Value accum = reader.find("accum");
  const Value bitmap = reader.find("bitmap");
  const Value image = reader.find("image");
  reader.finish();
  if (clear) return parse_clear(clear, scene);
  if (bitmap) return parse_bitmap(bitmap, scene.framebuffer);
  if (image) return parse_image(image, scene.framebuffer, directory);
  if (accum) return parse_accum(accum, scene);
  if (camera) return CameraChange{parse_camera(camera, aspect)};
  return LightsChange{parse_lights(lights)};
}

}  // namespace

std::vector<Command> parse_frame(const Value& v, const Scene& scene, const std::string& directory) {
  std::vector<Command> frame;
  std::vector<Light> lights = scene.lights;
  for (std::size_t i = 0; i < array_size(v); ++i) {
    frame.push_back(parse_command(v[i], scene, directory, lights));
    if (const auto* change = std::get_if<LightsChange>(&frame.back())) lights = change->lights;
  }
  return frame;
}

std::vector<Command> default_frame(const Scene& scene) {
  Clear clear;
  clear.color = Vec4{0, 0, 0, 1};
  const bool has_depth = scene.framebuffer.depth != DepthFormat::kNone;
  if (has_depth) clear.depth = scene.camera.reversed ? 0 : 1;
  if (scene.framebuffer.stencil_bits > 0) clear.stencil = 0;

  std::vector<Command> frame{clear};
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    Draw draw;
    draw.mesh = i;
    if (!has_depth) draw.depth = std::nullopt;
    else if (scene.camera.reversed) draw.depth->test = Compare::kGreater;
    frame.push_back(draw);
  }
  return frame;
}

}  // namespace tessera::reference
