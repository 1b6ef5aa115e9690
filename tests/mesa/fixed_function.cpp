#include "fixed_function.h"

#include <algorithm>

#include "context.h"

namespace tessera::mesa {
namespace {

constexpr std::size_t kMaxLights = 8;
constexpr double kMaxExponent = 128;  // OpenGL's limit for highlights and spots

struct Floats {
  GLfloat values[4];
};

Floats floats(reference::Vec4 v) {
  return {{static_cast<GLfloat>(v.x), static_cast<GLfloat>(v.y), static_cast<GLfloat>(v.z),
           static_cast<GLfloat>(v.w)}};
}

bool is_black(reference::Vec4 c) { return c.x == 0 && c.y == 0 && c.z == 0; }

bool light_is_ordinary(const reference::Light& light) {
  const auto [constant, linear, quadratic] = light.attenuation;
  const bool attenuates_safely = constant > 0 && linear >= 0 && quadratic >= 0;
  // OpenGL drivers differ here.
  const bool is_directional_spot = light.position.w == 0 && light.spot_cutoff != 180;
  return attenuates_safely && !is_directional_spot && light.spot_exponent <= kMaxExponent;
}

// 0^0 is 1 in the specification, but not on every instruction set.
bool material_is_ordinary(const reference::Material& material, const reference::Draw& draw) {
  const bool has_highlight =
      !is_black(material.specular) || draw.color_material == reference::ColorMaterial::kSpecular;
  return material.shininess <= kMaxExponent && (material.shininess > 0 || !has_highlight);
}

bool vertex_is_ordinary(const Vertex& vertex) {
  const auto [x, y, z] = vertex.normal;
  return vertex.position[3] == 1 && (x != 0 || y != 0 || z != 0);
}

bool is_affine(const reference::Mat4& m) { return m.rows[3] == std::array<double, 4>{0, 0, 0, 1}; }

void set_light(GLenum name, const reference::Light& light) {
  const GLfloat direction[3] = {static_cast<GLfloat>(light.spot_direction.x),
                                static_cast<GLfloat>(light.spot_direction.y),
                                static_cast<GLfloat>(light.spot_direction.z)};
  glEnable(name);
  glLightfv(name, GL_AMBIENT, floats(light.ambient).values);
  glLightfv(name, GL_DIFFUSE, floats(light.diffuse).values);
  glLightfv(name, GL_SPECULAR, floats(light.specular).values);
  glLightfv(name, GL_POSITION, floats(light.position).values);
  glLightfv(name, GL_SPOT_DIRECTION, direction);
  glLightf(name, GL_SPOT_EXPONENT, static_cast<GLfloat>(light.spot_exponent));
  glLightf(name, GL_SPOT_CUTOFF, static_cast<GLfloat>(light.spot_cutoff));
  glLightf(name, GL_CONSTANT_ATTENUATION, static_cast<GLfloat>(light.attenuation[0]));
  glLightf(name, GL_LINEAR_ATTENUATION, static_cast<GLfloat>(light.attenuation[1]));
  glLightf(name, GL_QUADRATIC_ATTENUATION, static_cast<GLfloat>(light.attenuation[2]));
}

void set_material(GLenum face, const reference::Material& material) {
  glMaterialfv(face, GL_AMBIENT, floats(material.ambient).values);
  glMaterialfv(face, GL_DIFFUSE, floats(material.diffuse).values);
  glMaterialfv(face, GL_SPECULAR, floats(material.specular).values);
  glMaterialfv(face, GL_EMISSION, floats(material.emission).values);
  glMaterialf(face, GL_SHININESS, static_cast<GLfloat>(material.shininess));
}

GLenum color_material(reference::ColorMaterial mode) {
  switch (mode) {
    case reference::ColorMaterial::kNone: break;
    case reference::ColorMaterial::kAmbientAndDiffuse: return GL_AMBIENT_AND_DIFFUSE;
    case reference::ColorMaterial::kDiffuse: return GL_DIFFUSE;
    case reference::ColorMaterial::kAmbient: return GL_AMBIENT;
    case reference::ColorMaterial::kEmission: return GL_EMISSION;
    case reference::ColorMaterial::kSpecular: return GL_SPECULAR;
  }
  return GL_NONE;
}

}  // namespace

bool fixed_functions_can(const reference::Draw& draw, const reference::LightModel& model,
                         const std::vector<reference::Light>& lights, const reference::Camera& camera,
                         const std::vector<Vertex>& vertices) {
  if (!draw.lighting) return true;
  if (draw.shading == reference::Shading::kPhong || model.specular != reference::SpecularModel::kBlinn)
    return false;
  const bool lights_fit = lights.size() <= kMaxLights && std::ranges::all_of(lights, light_is_ordinary);
  const bool materials_fit =
      material_is_ordinary(draw.material, draw) && material_is_ordinary(draw.back_material, draw);
  const bool transforms_fit = is_affine(draw.world_from_object) && is_affine(camera.view_from_world);
  return lights_fit && materials_fit && transforms_fit && std::ranges::all_of(vertices, vertex_is_ordinary);
}

void set_fixed_function_lighting(const reference::Draw& draw, const reference::LightModel& model,
                                 const std::vector<reference::Light>& lights, bool has_vertex_colors) {
  glDisable(GL_COLOR_MATERIAL);  // before the materials, which would otherwise follow the colour
  if (!draw.lighting) {
    glDisable(GL_LIGHTING);
    return;
  }
  glEnable(GL_LIGHTING);
  for (std::size_t i = 0; i < kMaxLights; ++i) {
    const GLenum name = GL_LIGHT0 + static_cast<GLenum>(i);
    if (i < lights.size()) set_light(name, lights[i]);
    else glDisable(name);
  }
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, floats(model.ambient).values);
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, model.local_viewer ? 1 : 0);
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, model.two_sided ? 1 : 0);
  set_material(GL_FRONT, draw.material);
  set_material(GL_BACK, draw.back_material);
  if (has_vertex_colors && draw.color_material != reference::ColorMaterial::kNone) {
    glColorMaterial(GL_FRONT_AND_BACK, color_material(draw.color_material));
    glEnable(GL_COLOR_MATERIAL);
  }
}

}  // namespace tessera::mesa
