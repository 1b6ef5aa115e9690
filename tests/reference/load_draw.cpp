// The draws of a frame.
#include <numbers>

#include "planar_shadow.h"
#include "scene_parts.h"

namespace tessera::reference {
namespace {

Mat4 translation(Vec3 t) { return {{{{1, 0, 0, t.x}, {0, 1, 0, t.y}, {0, 0, 1, t.z}, {0, 0, 0, 1}}}}; }
Mat4 scaling(Vec3 s) { return {{{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}, {0, 0, 0, 1}}}}; }

// The matrix of glRotate.
Mat4 rotation(double degrees, Vec3 axis) {
  const Vec3 a = normalize(axis);
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double k = 1 - c;
  return {{{{a.x * a.x * k + c, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s, 0},
            {a.y * a.x * k + a.z * s, a.y * a.y * k + c, a.y * a.z * k - a.x * s, 0},
            {a.z * a.x * k - a.y * s, a.z * a.y * k + a.x * s, a.z * a.z * k + c, 0},
            {0, 0, 0, 1}}}};
}

Mat4 parse_transform(const Value& v) {
  Mat4 product;
  for (std::size_t i = 0; i < array_size(v); ++i) {
    ObjectReader step(v[i]);
    if (v[i].json->size() != 1) fail(v[i].pointer, "one of translate, rotate, scale, matrix");
    if (const Value t = step.find("translate")) product = multiply(product, translation(vec3(t)));
    if (const Value s = step.find("scale")) product = multiply(product, scaling(vec3(s)));
    if (const Value m = step.find("matrix")) product = multiply(product, mat4(m));
    if (const Value r = step.find("rotate")) {
      const auto [angle, x, y, z] = numbers<4>(r);
      if (length({x, y, z}) == 0) fail(r.pointer, "an axis that is not null");
      product = multiply(product, rotation(angle, {x, y, z}));
    }
    step.finish();
  }
  return product;
}

Material find_material(const Value& v, const Scene& scene) {
  const auto found = scene.materials.find(text(v));
  if (found == scene.materials.end()) fail(v.pointer, "the name of a material");
  return found->second;
}

std::vector<Vec4> parse_gradient(ObjectReader& reader) {
  const Value v = reader.find("colors");
  if (!v) return {{1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}, {0, 1, 1, 1}, {0, 0, 1, 1}};
  std::vector<Vec4> colors;
  for (std::size_t i = 0; i < array_size(v); ++i) colors.push_back(vec4(v[i]));
  if (colors.size() < 2) fail(v.pointer, "two colours or more");
  return colors;
}

Stage parse_stage(const Value& v) {
  enum class Name { kObjectY, kScreenY, kUncover, kReverseZ, kZoom, kFalloff };
  using Kind = Stage::Kind;
  ObjectReader reader(v);
  Stage stage;
  switch (choice<Name>(reader.require("name"), {{"gradient_object_y", Name::kObjectY},
                                                {"gradient_screen_y", Name::kScreenY},
                                                {"uncover", Name::kUncover},
                                                {"reverse_z", Name::kReverseZ},
                                                {"zoom", Name::kZoom},
                                                {"falloff", Name::kFalloff}})) {
    case Name::kObjectY: stage = {Kind::kGradientObjectY, 0, {}, parse_gradient(reader)}; break;
    case Name::kScreenY: stage = {Kind::kGradientScreenY, 0, {}, parse_gradient(reader)}; break;
    case Name::kUncover: stage = {Kind::kUncover, number(reader.require("amount")), {}, {}}; break;
    case Name::kReverseZ:
      stage.kind = choice<Kind>(reader.require("space"),
                                {{"clip", Kind::kReverseClipZ}, {"window", Kind::kReverseWindowZ}});
      break;
    case Name::kZoom: stage = {Kind::kZoom, number(reader.require("factor")), {}, {}}; break;
    case Name::kFalloff:
      stage = {Kind::kFalloff, number(reader.require("exponent")), vec3(reader.require("from")), {}};
      break;
  }
  reader.finish();
  return stage;
}

void parse_texturing(ObjectReader& reader, const Scene& scene, Draw& draw) {
  if (const Value name = reader.find("texture")) {
    std::size_t number = 0;
    while (number < scene.textures.size() && scene.textures[number].name != text(name)) ++number;
    if (number == scene.textures.size()) fail(name.pointer, "the name of a texture", name.json->dump());
    draw.texture = number;
  }
  if (const Value env = reader.find("texture_env"))
    draw.texture_env = choice<TextureEnv>(env, {{"modulate", TextureEnv::kModulate},
                                                {"replace", TextureEnv::kReplace},
                                                {"decal", TextureEnv::kDecal},
                                                {"blend", TextureEnv::kBlend},
                                                {"add", TextureEnv::kAdd}});
  if (const Value color = reader.find("texture_env_color")) draw.texture_env_color = vec4(color);
}

std::array<PolygonMode, 2> parse_polygon_mode(const Value& v) {
  const auto mode = [](const Value& name) {
    return choice<PolygonMode>(
        name, {{"fill", PolygonMode::kFill}, {"line", PolygonMode::kLine}, {"point", PolygonMode::kPoint}});
  };
  if (!v.json->is_array()) return {mode(v), mode(v)};
  if (array_size(v) != 2) fail(v.pointer, "a mode or [front, back]");
  return {mode(v[0]), mode(v[1])};
}

double parse_size(const Value& v) {
  const double size = number(v);
  if (!(size > 0)) fail(v.pointer, "a size in pixels above 0", v.json->dump());
  return size;
}

void parse_shading(ObjectReader& reader, Draw& draw) {
  if (const Value shading = reader.find("shading"))
    draw.shading = choice<Shading>(
        shading, {{"flat", Shading::kFlat}, {"gouraud", Shading::kGouraud}, {"phong", Shading::kPhong}});
  if (const Value lighting = reader.find("lighting")) draw.lighting = boolean(lighting);
  if (const Value mode = reader.find("color_material"))
    draw.color_material =
        choice<ColorMaterial>(mode, {{"none", ColorMaterial::kNone},
                                     {"ambient_and_diffuse", ColorMaterial::kAmbientAndDiffuse},
                                     {"diffuse", ColorMaterial::kDiffuse},
                                     {"ambient", ColorMaterial::kAmbient},
                                     {"emission", ColorMaterial::kEmission},
                                     {"specular", ColorMaterial::kSpecular}});
  if (const Value normalize = reader.find("normalize")) draw.normalize = boolean(normalize);
}

void parse_primitives(ObjectReader& reader, Draw& draw) {
  if (const Value vertex = reader.find("provoking_vertex"))
    draw.provoking_vertex = choice<ProvokingVertex>(
        vertex, {{"last", ProvokingVertex::kLast}, {"first", ProvokingVertex::kFirst}});
  if (const Value cull = reader.find("cull"))
    draw.cull = choice<Cull>(cull, {{"none", Cull::kNone}, {"back", Cull::kBack}, {"front", Cull::kFront}});
  if (const Value front = reader.find("front_face"))
    draw.front_face = choice<FrontFace>(front, {{"ccw", FrontFace::kCcw}, {"cw", FrontFace::kCw}});
  if (const Value mode = reader.find("polygon_mode")) draw.polygon_mode = parse_polygon_mode(mode);
  if (const Value size = reader.find("point_size")) draw.point_size = parse_size(size);
  if (const Value width = reader.find("line_width")) draw.line_width = parse_size(width);
}

ShadowOn parse_shadow_on(const Value& v, const std::vector<Light>& lights) {
  ObjectReader reader(v);
  ShadowOn shadow;
  const Value plane = reader.require("plane");
  shadow.plane = vec4(plane);
  const Value light = reader.find("light");
  if (light) shadow.light = static_cast<std::size_t>(integer(light, 0, 1 << 30));
  const std::string& pointer = light ? light.pointer : v.pointer;
  if (shadow.light >= lights.size())
    fail(pointer, "the number of a light, of which there are " + std::to_string(lights.size()),
         std::to_string(shadow.light));
  if (!shadow_matrix(shadow.plane, lights[shadow.light]))
    fail(plane.pointer, "a plane that neither holds the light nor is parallel to its direction",
         plane.json->dump());
  if (const Value color = reader.find("color")) shadow.color = vec4(color);
  reader.finish();
  return shadow;
}

}  // namespace

Draw parse_draw(const Value& v, const Scene& scene, const std::vector<Light>& lights) {
  ObjectReader reader(v);
  Draw draw;
  const Value mesh = reader.require("draw");
  while (draw.mesh < scene.meshes.size() && scene.meshes[draw.mesh].name != text(mesh)) ++draw.mesh;
  if (draw.mesh == scene.meshes.size()) fail(mesh.pointer, "the name of a mesh");

  if (const Value name = reader.find("material")) draw.material = find_material(name, scene);
  const Value back = reader.find("back_material");
  draw.back_material = back ? find_material(back, scene) : draw.material;
  if (const Value transform = reader.find("transform")) draw.world_from_object = parse_transform(transform);
  parse_shading(reader, draw);
  parse_primitives(reader, draw);
  if (const Value shadow = reader.find("shadow_on")) draw.shadow_on = parse_shadow_on(shadow, lights);
  if (const Value viewport = reader.find("viewport")) draw.viewport = rect(viewport);
  parse_texturing(reader, scene, draw);
  parse_fragment_state(reader, scene.framebuffer, draw);
  if (const Value depth = reader.find("depth"); depth && depth.json->is_number())
    fail(depth.pointer, "a depth test or false");
  parse_window_depths(reader, scene.framebuffer, draw);
  if (const Value stages = reader.find("stages"))
    for (std::size_t i = 0; i < array_size(stages); ++i) draw.stages.push_back(parse_stage(stages[i]));
  reader.finish();
  return draw;
}

}  // namespace tessera::reference
