#include "lighting_programs.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lighting_sources.h"
#include "textures.h"

namespace tessera::mesa {
namespace {

using Values = std::vector<GLfloat>;

void append(Values& values, reference::Vec4 v) {
  for (const double x : {v.x, v.y, v.z, v.w}) values.push_back(static_cast<GLfloat>(x));
}

reference::Vec4 with_w(reference::Vec3 v, double w) { return {v.x, v.y, v.z, w}; }

void append_light(Values& values, const reference::Light& light, const reference::Mat4& view) {
  append(values, light.ambient);
  append(values, light.diffuse);
  append(values, light.specular);
  const reference::Vec4 p = reference::transform(view, light.position);
  if (light.position.w == 0) append(values, with_w(reference::normalize(reference::xyz(p)), 0));
  else append(values, {p.x / p.w, p.y / p.w, p.z / p.w, 1});
  append(values, with_w(reference::normalize(reference::transform_direction(view, light.spot_direction)), std::cos(light.spot_cutoff * std::numbers::pi / 180)));
  append(values, {light.attenuation[0], light.attenuation[1], light.attenuation[2], 0});
  append(values, {light.spot_exponent, light.spot_cutoff != 180 ? 1.0 : 0.0, 0, 0});
}

void append_material(Values& values, const reference::Material& material) {
  append(values, material.ambient);
  append(values, material.diffuse);
  append(values, material.specular);
  append(values, material.emission);
  append(values, {material.shininess, 0, 0, 0});
}

int color_material_number(reference::ColorMaterial mode) {
  switch (mode) {
    case reference::ColorMaterial::kNone: break;
    case reference::ColorMaterial::kAmbientAndDiffuse: return 1;
    case reference::ColorMaterial::kDiffuse: return 2;
    case reference::ColorMaterial::kAmbient: return 3;
    case reference::ColorMaterial::kEmission: return 4;
    case reference::ColorMaterial::kSpecular: return 5;
  }
  return 0;
}

int texture_env_number(reference::TextureEnv env) {
  switch (env) {
    case reference::TextureEnv::kModulate: break;
    case reference::TextureEnv::kReplace: return 1;
    case reference::TextureEnv::kDecal: return 2;
    case reference::TextureEnv::kBlend: return 3;
    case reference::TextureEnv::kAdd: return 4;
  }
  return 0;
}

void attach(const Functions& gl, GLuint program, GLenum type, const char* head, const char* body) {
  const GLuint shader = gl.create_shader(type);
  const char* const parts[] = {head, body};
  gl.shader_source(shader, 2, parts, nullptr);
  gl.compile_shader(shader);
  GLint compiled = 0;
  gl.get_shader_iv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    char log[2000] = {};
    gl.get_shader_info_log(shader, sizeof log, nullptr, log);
    throw std::runtime_error(std::string("GLSL: ") + log);
  }
  gl.attach_shader(program, shader);
}

}  // namespace

GLuint LightingPrograms::program(bool at_each_pixel) {
  GLuint& name = at_each_pixel ? at_pixels_ : at_vertices_;
  if (name != 0) return name;
  const Functions& gl = functions_;
  name = gl.create_program();
  attach(gl, name, GL_VERTEX_SHADER, kLighting, at_each_pixel ? kPixelLitVertex : kVertexLit);
  if (at_each_pixel) attach(gl, name, GL_FRAGMENT_SHADER, kLighting, kPixelLitFragment);
  gl.link_program(name);
  GLint linked = 0;
  gl.get_program_iv(name, GL_LINK_STATUS, &linked);
  if (linked == 0) {
    char log[2000] = {};
    gl.get_program_info_log(name, sizeof log, nullptr, log);
    throw std::runtime_error(std::string("GLSL: ") + log);
  }
  return name;
}

void LightingPrograms::use(const reference::Draw& draw, const reference::LightModel& model, const std::vector<reference::Light>& lights,
                           const reference::Camera& camera, bool has_vertex_colors, const reference::Texture* texture) {
  const Functions& gl = functions_;
  const GLuint used = program(draw.shading == reference::Shading::kPhong);
  gl.use_program(used);
  const auto set_integer = [&](const char* uniform, int value) { gl.uniform_1i(gl.get_uniform_location(used, uniform), value); };
  const auto set_vectors = [&](const char* uniform, const Values& values) {
    gl.uniform_4fv(gl.get_uniform_location(used, uniform), static_cast<GLsizei>(values.size() / 4), values.data());
  };
  Values light_values, materials, ambient, env_color;
  for (const reference::Light& light : lights) append_light(light_values, light, camera.view_from_world);
  append_material(materials, draw.material);
  append_material(materials, draw.back_material);
  append(ambient, model.ambient);
  append(env_color, draw.texture_env_color);

  set_integer("light_count", static_cast<int>(lights.size()));
  if (!lights.empty()) set_vectors("light_values", light_values);
  set_vectors("materials", materials);
  set_vectors("scene_ambient", ambient);
  set_integer("local_viewer", model.local_viewer ? 1 : 0);
  set_integer("phong_highlight", model.specular == reference::SpecularModel::kPhong ? 1 : 0);
  set_integer("color_material", has_vertex_colors ? color_material_number(draw.color_material) : 0);
  set_integer("normalize_normals", draw.normalize ? 1 : 0);
  set_integer("two_sided", model.two_sided ? 1 : 0);
  set_integer("texture_dimensions", texture == nullptr ? 0 : is_row(*texture) ? 1 : 2);
  set_integer("texture_env", texture_env_number(draw.texture_env));
  set_integer("texture_has_alpha", texture != nullptr && texture->image.channels % 2 == 0 ? 1 : 0);
  set_vectors("texture_env_color", env_color);
  set_integer("image", kImageUnit);
  set_integer("row", kRowUnit);
  if (model.two_sided) glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
  else glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
}

}  // namespace tessera::mesa
