// Reads the commands of a frame, in order.
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "engine/program/scene/named_stages.h"
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/suggest.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

constexpr std::int64_t kMaxUint32 = std::numeric_limits<std::uint32_t>::max();

struct NameList {
  std::vector<std::string_view> names{};
  std::unordered_map<std::string_view, std::size_t> index_of{};

  void add(std::string_view name) {
    index_of.emplace(name, names.size());
    names.push_back(name);
  }
};

// The objects that commands of a frame refer to.
struct Names {
  NameList meshes{};
  NameList materials{};
  NameList textures{};
  const FrameNames& defined;
  const Scene& scene;
  LightList lights;  // current lights
};

std::size_t read_name(const Value& value, std::string_view kind, const NameList& list) {
  const std::string& name = value.text();
  const auto found = list.index_of.find(name);
  if (found == list.index_of.end())
    value.fail("the name of a " + std::string(kind) +
               (list.names.empty() ? " (the scene has none)" : did_you_mean(name, list.names)));
  return found->second;
}

const Material& read_material_name(const Value& value, const Names& names) {
  return names.defined.materials.find(names.materials.names[read_name(value, "material", names.materials)])
      ->second;
}

Matrix read_transform(const Value& value) {
  Matrix product;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value element = value.element(i);
    const Object step(element, {"translate", "rotate", "scale", "matrix"});
    if (element.json().size() != 1)
      element.fail("an object with one of \"translate\", \"rotate\", \"scale\", \"matrix\"");
    if (const auto translation = step.find("translate")) {
      const Vec3 t = translation->vec3();
      product = product * translate(t.x, t.y, t.z);
    } else if (const auto rotation = step.find("rotate")) {
      const auto [degrees, x, y, z] = rotation->numbers<4>();
      product = product *
                rotation->checked([&, d = degrees, ax = x, ay = y, az = z] { return rotate(d, ax, ay, az); });
    } else if (const auto scaling = step.find("scale")) {
      const Vec3 s = scaling->vec3();
      product = product * scale(s.x, s.y, s.z);
    } else {
      product = product * step.require("matrix").matrix();
    }
  }
  return product;
}

DepthState read_depth(const Value& value, const Scene& scene) {
  if (value.json() == Json(false)) return {.enabled = false};
  if (scene.framebuffer.depth == DepthFormat::none)
    value.refuse("needs a depth buffer, and the frame buffer's \"depth\" is \"none\"");
  if (value.json().is_boolean()) value.fail("false or an object");
  const Object object(value, {"test", "write"});
  DepthState depth;
  if (const auto test = object.find("test")) depth.test = test->choice(kCompares);
  if (const auto write = object.find("write")) depth.write = write->boolean();
  return depth;
}

std::array<bool, 4> read_color_mask(const Value& value, const FrameBufferFormat& format) {
  if (!value.json().is_array() || value.size() != 4) value.fail("four of true and false");
  std::array<bool, 4> mask;
  for (std::size_t i = 0; i < 4; ++i) mask[i] = value.element(i).boolean();
  const bool has_components = format.color_mode == ColorMode::rgb && format.color_bits > 2;
  if (!has_components && (mask[0] != mask[1] || mask[1] != mask[2]))
    value.refuse(
        "red, green and blue must be all true or all false on an index buffer or one of 1 or 2 bits");
  return mask;
}

// Material, lighting and texture of a draw.
void read_shading(const Object& object, const Names& names, DrawState& state) {
  if (const auto material = object.find("material")) state.material = read_material_name(*material, names);
  if (const auto material = object.find("back_material"))
    state.back_material = read_material_name(*material, names);
  if (const auto shading = object.find("shading")) state.shading = shading->choice(kShadings);
  if (const auto lighting = object.find("lighting")) state.lighting = lighting->boolean();
  if (const auto mode = object.find("color_material")) state.color_material = mode->choice(kColorMaterials);
  if (const auto vertex = object.find("provoking_vertex"))
    state.provoking_vertex =
        vertex->choice<ProvokingVertex>({{"last", ProvokingVertex::last}, {"first", ProvokingVertex::first}});
  if (const auto normalize = object.find("normalize")) state.normalize = normalize->boolean();
  if (const auto texture = object.find("texture"))
    state.texture = names.scene.textures[read_name(*texture, "texture", names.textures)].get();
  if (const auto env = object.find("texture_env"))
    state.texture_env = env->choice<TextureEnv>({{"modulate", TextureEnv::modulate},
                                                 {"replace", TextureEnv::replace},
                                                 {"decal", TextureEnv::decal},
                                                 {"blend", TextureEnv::blend},
                                                 {"add", TextureEnv::add}});
  if (const auto color = object.find("texture_env_color")) state.texture_env_color = color->color();
}

// Transform, facing and viewport of a draw.
void read_target(const Object& object, DrawState& state) {
  if (const auto transform = object.find("transform")) state.transform = read_transform(*transform);
  if (const auto cull = object.find("cull")) state.cull = cull->choice(kCulls);
  if (const auto front = object.find("front_face"))
    state.front_face = front->choice<FrontFace>({{"ccw", FrontFace::ccw}, {"cw", FrontFace::cw}});
  if (const auto range = object.find("depth_range")) {
    if (!range->json().is_array() || range->size() != 2) range->fail("[near, far]");
    state.depth_near = range->element(0).number(0, 1);
    state.depth_far = range->element(1).number(0, 1);
  }
  if (const auto viewport = object.find("viewport")) state.viewport = viewport->rect();
}

ShadowOn read_shadow_on(const Value& value, const LightList& lights) {
  const Object object(value, {"plane", "light", "color"});
  if (lights.empty()) value.refuse("needs a light, and there are none");
  ShadowOn shadow{.plane = object.require("plane").numbers<4>()};
  if (const auto light = object.find("light")) {
    const auto max_index = static_cast<std::int64_t>(lights.size()) - 1;
    shadow.light = static_cast<std::size_t>(light->integer(0, max_index));
  }
  if (const auto color = object.find("color")) shadow.color = color->color();
  value.checked([&] { return planar_shadow(shadow.plane, lights[shadow.light]); });
  return shadow;
}

// Reads a point size or a line width, in pixels.
float read_size(const Value& value) {
  const float size = value.real();
  if (!(size > 0)) value.fail("a number above 0");
  return size;
}

// Reads one mode for both faces, or [front, back].
void read_polygon_mode(const Value& value, DrawState& state) {
  const auto mode = [](const Value& v) {
    return v.choice<PolygonMode>(
        {{"fill", PolygonMode::fill}, {"line", PolygonMode::line}, {"point", PolygonMode::point}});
  };
  if (!value.json().is_array()) {
    state.front_mode = state.back_mode = mode(value);
    return;
  }
  if (value.size() != 2) value.fail("\"fill\", \"line\", \"point\", or [front, back]");
  state.front_mode = mode(value.element(0));
  state.back_mode = mode(value.element(1));
}

/// Adds the stages of a draw, if it has any.
void read_stages(const Object& object, const Names& names, DrawCommand& draw) {
  const auto stages = object.find("stages");
  if (!stages || stages->size() == 0) return;
  if (draw.state.shadow_on) stages->refuse("a draw with \"shadow_on\" has no stages");
  draw.stages =
      std::make_shared<const NamedStages>(*stages, names.scene.meshes[draw.mesh], draw.state.transform);
  draw.stages->attach(draw.state);
}

/// Whether a draw uses nothing of a model file but its mesh.
bool is_of_mesh_alone(const Json& draw) { return draw.contains("material") || draw.contains("shadow_on"); }

GivenState given_by(const Object& object) {
  return {.texture = object.has("texture"),
          .lighting = object.has("lighting"),
          .color_material = object.has("color_material"),
          .cull = object.has("cull"),
          .depth = object.has("depth"),
          .alpha_test = object.has("alpha_test"),
          .blend = object.has("blend") || object.has("logic_op")};
}

/// A draw of the scene; of a mesh from a file, those of its parts.
std::vector<Command> read_draw(const Value& value, const Names& names) {
  const Object object(value, {"draw",       "material",       "back_material",     "transform",  "shading",
                              "lighting",   "color_material", "provoking_vertex",  "normalize",  "cull",
                              "front_face", "depth",          "depth_range",       "color_mask", "plane_mask",
                              "viewport",   "scissor",        "polygon_offset",    "alpha_test", "stencil",
                              "blend",      "logic_op",       "polygon_mode",      "point_size", "line_width",
                              "texture",    "texture_env",    "texture_env_color", "shadow_on",  "stages"});
  DrawCommand draw;
  draw.mesh = read_name(object.require("draw"), "mesh", names.meshes);
  read_shading(object, names, draw.state);
  read_target(object, draw.state);
  if (const auto depth = object.find("depth"); depth && depth->json().is_number())
    depth->fail("false or an object");
  read_fragment_state(object, names.scene, draw.state);
  if (const auto shadow = object.find("shadow_on"))
    draw.state.shadow_on = read_shadow_on(*shadow, names.lights);
  if (const auto mode = object.find("polygon_mode")) read_polygon_mode(*mode, draw.state);
  if (const auto size = object.find("point_size")) draw.state.point_size = read_size(*size);
  if (const auto width = object.find("line_width")) draw.state.line_width = read_size(*width);
  std::vector<Command> draws;
  const auto parts = names.defined.file_draws.find(draw.mesh);
  if (parts == names.defined.file_draws.end() || is_of_mesh_alone(value.json())) {
    read_stages(object, names, draw);
    draws.emplace_back(std::move(draw));
    return draws;
  }
  const bool can_blend = names.scene.framebuffer.color_mode == ColorMode::rgb;
  for (const DrawCommand& part : parts->second) {
    DrawCommand combined = with_file_state(draw, part, given_by(object), can_blend);
    read_stages(object, names, combined);
    draws.emplace_back(std::move(combined));
  }
  return draws;
}

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

std::vector<Command> read_command(const Value& value, const Names& names, const std::string& base_folder,
                                  FileCache& cache) {
  static constexpr std::array<std::string_view, 8> kCommands{"clear",  "draw",   "bitmap",  "image",
                                                             "camera", "lights", "quality", "accum"};
  if (!value.json().is_object()) value.fail("an object with one of " + json::quoted_list(kCommands));
  if (value.json().contains("draw")) return read_draw(value, names);
  if (value.json().empty()) value.fail("one of " + json::quoted_list(kCommands));
  const Object object(value, {"clear", "draw", "bitmap", "image", "camera", "lights", "quality", "accum"});
  if (value.json().size() != 1)
    value.refuse("found several commands in one object, expected one of " + json::quoted_list(kCommands));
  if (const auto clear = object.find("clear")) return {read_clear(*clear, names.scene.framebuffer)};
  if (const auto bitmap = object.find("bitmap")) return {read_bitmap(*bitmap, names.scene)};
  if (const auto image = object.find("image")) return {read_image(*image, names.scene, base_folder, cache)};
  if (const auto accum = object.find("accum")) return {read_accum(*accum, names.scene.framebuffer)};
  if (const auto camera = object.find("camera")) {
    const FrameBufferFormat& format = names.scene.framebuffer;
    return {read_camera(*camera, base_folder, static_cast<double>(format.width) / format.height, cache)};
  }
  if (const auto quality = object.find("quality")) return {read_quality(*quality)};
  return {read_lights(object.require("lights"), base_folder, cache)};
}

}  // namespace

MeshUses mesh_uses(const std::optional<Value>& frame, const std::vector<std::string>& meshes) {
  MeshUses uses;
  if (!frame) {
    uses.with_materials = {meshes.begin(), meshes.end()};
    return uses;
  }
  for (const Json& command : frame->json()) {
    if (!command.is_object() || !command.contains("draw") || !command["draw"].is_string()) continue;
    (is_of_mesh_alone(command) ? uses.alone : uses.with_materials).insert(command["draw"].get<std::string>());
  }
  return uses;
}

void read_fragment_state(const Object& object, const Scene& scene, DrawState& state) {
  state.depth.enabled = scene.framebuffer.depth != DepthFormat::none;
  if (const auto depth = object.find("depth"); depth && !depth->json().is_number())
    state.depth = read_depth(*depth, scene);
  if (const auto mask = object.find("color_mask"))
    state.color_mask = read_color_mask(*mask, scene.framebuffer);
  if (const auto mask = object.find("plane_mask"))
    state.plane_mask = static_cast<std::uint32_t>(mask->integer(0, kMaxUint32));
  if (const auto scissor = object.find("scissor")) state.scissor = scissor->rect();
  read_operations(object, scene.framebuffer, state);
}

std::vector<SceneCommand> read_frame(const Value& value, const Scene& scene, const FrameNames& defined,
                                     const std::string& base_folder, FileCache& cache) {
  Names names{.defined = defined, .scene = scene, .lights = scene.lights};
  for (const std::string& name : defined.meshes) names.meshes.add(name);
  for (const auto& [name, material] : defined.materials) names.materials.add(name);
  for (const std::string& name : defined.textures) names.textures.add(name);
  std::vector<SceneCommand> frame;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value element = value.element(i);
    for (Command& command : read_command(element, names, base_folder, cache)) {
      if (const auto* lights = std::get_if<LightList>(&command)) names.lights = *lights;
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
