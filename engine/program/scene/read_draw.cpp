// Reads draws: everything but the per-fragment operations.
#include "engine/program/scene/read_draw.h"

#include <string>
#include <utility>

#include "engine/program/scene/named_stages.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/suggest.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

std::size_t read_name(const Value& value, std::string_view kind, const NameList& list) {
  const std::string& name = value.text();
  const auto found = list.index_of.find(name);
  if (found == list.index_of.end())
    value.fail("the name of a " + std::string(kind) +
               (list.names.empty() ? " (the scene has none)" : did_you_mean(name, list.names)));
  return found->second;
}

const Material& read_material_name(const Value& value, const FrameObjects& objects) {
  return objects.defined.materials
      .find(objects.materials.names[read_name(value, "material", objects.materials)])
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
// Material, lighting and texture of a draw.
void read_shading(const Object& object, const FrameObjects& objects, DrawState& state) {
  if (const auto material = object.find("material")) state.material = read_material_name(*material, objects);
  if (const auto material = object.find("back_material"))
    state.back_material = read_material_name(*material, objects);
  if (const auto shading = object.find("shading")) state.shading = shading->choice(kShadings);
  if (const auto lighting = object.find("lighting")) state.lighting = lighting->boolean();
  if (const auto mode = object.find("color_material")) state.color_material = mode->choice(kColorMaterials);
  if (const auto vertex = object.find("provoking_vertex"))
    state.provoking_vertex =
        vertex->choice<ProvokingVertex>({{"last", ProvokingVertex::last}, {"first", ProvokingVertex::first}});
  if (const auto normalize = object.find("normalize")) state.normalize = normalize->boolean();
  if (const auto texture = object.find("texture"))
    state.texture = objects.scene.textures[read_name(*texture, "texture", objects.textures)].get();
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
void read_stages(const Object& object, const FrameObjects& objects, DrawCommand& draw) {
  const auto stages = object.find("stages");
  if (!stages || stages->size() == 0) return;
  if (draw.state.shadow_on) stages->refuse("a draw with \"shadow_on\" has no stages");
  draw.stages =
      std::make_shared<const NamedStages>(*stages, objects.scene.meshes[draw.mesh], draw.state.transform);
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
std::vector<Command> read_draw(const Value& value, const FrameObjects& objects) {
  const Object object(value, {"draw",       "material",       "back_material",     "transform",  "shading",
                              "lighting",   "color_material", "provoking_vertex",  "normalize",  "cull",
                              "front_face", "depth",          "depth_range",       "color_mask", "plane_mask",
                              "viewport",   "scissor",        "polygon_offset",    "alpha_test", "stencil",
                              "blend",      "logic_op",       "polygon_mode",      "point_size", "line_width",
                              "texture",    "texture_env",    "texture_env_color", "shadow_on",  "stages"});
  DrawCommand draw;
  draw.mesh = read_name(object.require("draw"), "mesh", objects.meshes);
  read_shading(object, objects, draw.state);
  read_target(object, draw.state);
  if (const auto depth = object.find("depth"); depth && depth->json().is_number())
    depth->fail("false or an object");
  read_fragment_state(object, objects.scene, draw.state);
  if (const auto shadow = object.find("shadow_on"))
    draw.state.shadow_on = read_shadow_on(*shadow, objects.lights);
  if (const auto mode = object.find("polygon_mode")) read_polygon_mode(*mode, draw.state);
  if (const auto size = object.find("point_size")) draw.state.point_size = read_size(*size);
  if (const auto width = object.find("line_width")) draw.state.line_width = read_size(*width);
  std::vector<Command> draws;
  const auto parts = objects.defined.file_draws.find(draw.mesh);
  if (parts == objects.defined.file_draws.end() || is_of_mesh_alone(value.json())) {
    read_stages(object, objects, draw);
    draws.emplace_back(std::move(draw));
    return draws;
  }
  const bool can_blend = objects.scene.framebuffer.color_mode == ColorMode::rgb;
  for (const DrawCommand& part : parts->second) {
    DrawCommand combined = with_file_state(draw, part, given_by(object), can_blend);
    read_stages(object, objects, combined);
    draws.emplace_back(std::move(combined));
  }
  return draws;
}
}  // namespace tessera::program
