#include "lighting_programs.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tessera::mesa {
namespace {

// Shared by both programs. A light takes seven vectors, in the order of append_light(); a material five.
constexpr const char* kLighting = R"(#version 130
uniform int light_count;
uniform vec4 light_values[7 * 32];
uniform vec4 materials[2 * 5];  // front, back
uniform vec4 scene_ambient;
uniform int local_viewer, phong_highlight, color_material, normalize_normals;

vec3 unit(vec3 v) { float l = length(v); return l > 0.0 ? v / l : vec3(0.0); }
float power(float x, float y) { return y == 0.0 ? 1.0 : x <= 0.0 ? 0.0 : pow(x, y); }

vec4 lit(vec3 p, vec3 n, int side, vec4 vertex_color) {
  vec4 ambient = materials[5 * side], diffuse = materials[5 * side + 1], specular = materials[5 * side + 2], emission = materials[5 * side + 3];
  float shininess = materials[5 * side + 4].x;
  if (color_material == 1 || color_material == 3) ambient = vertex_color;
  if (color_material == 1 || color_material == 2) diffuse = vertex_color;
  if (color_material == 4) emission = vertex_color;
  if (color_material == 5) specular = vertex_color;

  vec3 e = local_viewer != 0 ? unit(-p) : vec3(0.0, 0.0, 1.0);
  vec3 sum = emission.rgb + scene_ambient.rgb * ambient.rgb;
  for (int i = 0; i < light_count; ++i) {
    vec4 position = light_values[7 * i + 3], spot = light_values[7 * i + 4], factors = light_values[7 * i + 5];
    float exponent = light_values[7 * i + 6].x;
    bool is_spot = light_values[7 * i + 6].y != 0.0;
    vec3 to_light = position.xyz;  // w = 0: a unit vector already
    float strength = 1.0;
    if (position.w != 0.0) {
      vec3 way = position.xyz - p;
      float d = length(way), denominator = factors.x + factors.y * d + factors.z * d * d;
      to_light = unit(way);
      strength = denominator <= 0.0 ? 1.0e6 : 1.0 / denominator;
    }
    if (is_spot) {
      float along = dot(-to_light, spot.xyz);
      strength *= along < spot.w || along <= 0.0 ? 0.0 : power(along, exponent);
    }
    float facing = dot(to_light, n);
    vec3 light = light_values[7 * i].rgb * ambient.rgb + max(facing, 0.0) * light_values[7 * i + 1].rgb * diffuse.rgb;
    if (facing > 0.0) {
      float cosine = phong_highlight != 0 ? dot(2.0 * facing * n - to_light, e) : dot(unit(to_light + e), n);
      light += power(max(cosine, 0.0), shininess) * light_values[7 * i + 2].rgb * specular.rgb;
    }
    sum += strength * light;
  }
  return clamp(vec4(sum, diffuse.a), 0.0, 1.0);
}

vec3 divided(vec4 p) { return p.xyz / p.w; }
)";

constexpr const char* kVertexLit = R"(
void main() {
  vec3 p = divided(gl_ModelViewMatrix * gl_Vertex), n = gl_NormalMatrix * gl_Normal;
  if (normalize_normals != 0) n = unit(n);
  gl_Position = ftransform();
  gl_FrontColor = lit(p, n, 0, gl_Color);
  gl_BackColor = lit(p, -n, 1, gl_Color);
}
)";

constexpr const char* kPixelLitVertex = R"(
out vec3 position, normal;
out vec4 color;
void main() {
  position = divided(gl_ModelViewMatrix * gl_Vertex);
  normal = gl_NormalMatrix * gl_Normal;
  if (normalize_normals != 0) normal = unit(normal);
  color = gl_Color;
  gl_Position = ftransform();
}
)";

constexpr const char* kPixelLitFragment = R"(
uniform int two_sided;
in vec3 position, normal;
in vec4 color;
void main() {
  bool back = two_sided != 0 && !gl_FrontFacing;
  vec3 n = unit(normal);
  gl_FragColor = lit(position, back ? -n : n, back ? 1 : 0, color);
}
)";

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
                           const reference::Camera& camera, bool has_vertex_colors) {
  const Functions& gl = functions_;
  const GLuint used = program(draw.shading == reference::Shading::kPhong);
  gl.use_program(used);
  const auto set_integer = [&](const char* uniform, int value) { gl.uniform_1i(gl.get_uniform_location(used, uniform), value); };
  const auto set_vectors = [&](const char* uniform, const Values& values) {
    gl.uniform_4fv(gl.get_uniform_location(used, uniform), static_cast<GLsizei>(values.size() / 4), values.data());
  };
  Values light_values, materials, ambient;
  for (const reference::Light& light : lights) append_light(light_values, light, camera.view_from_world);
  append_material(materials, draw.material);
  append_material(materials, draw.back_material);
  append(ambient, model.ambient);

  set_integer("light_count", static_cast<int>(lights.size()));
  if (!lights.empty()) set_vectors("light_values", light_values);
  set_vectors("materials", materials);
  set_vectors("scene_ambient", ambient);
  set_integer("local_viewer", model.local_viewer ? 1 : 0);
  set_integer("phong_highlight", model.specular == reference::SpecularModel::kPhong ? 1 : 0);
  set_integer("color_material", has_vertex_colors ? color_material_number(draw.color_material) : 0);
  set_integer("normalize_normals", draw.normalize ? 1 : 0);
  set_integer("two_sided", model.two_sided ? 1 : 0);
  if (model.two_sided) glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
  else glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
}

}  // namespace tessera::mesa
