#include "program_lighting.h"

#include <cmath>
#include <numbers>

namespace tessera::mesa {
namespace {

reference::Vec4 with_w(reference::Vec3 v, double w) { return {v.x, v.y, v.z, w}; }

void append_light(Vectors& values, const reference::Light& light, const reference::Mat4& view) {
  append(values, light.ambient);
  append(values, light.diffuse);
  append(values, light.specular);
  const reference::Vec4 p = reference::transform(view, light.position);
  if (light.position.w == 0) append(values, with_w(reference::normalize(reference::xyz(p)), 0));
  else append(values, {p.x / p.w, p.y / p.w, p.z / p.w, 1});
  append(values, with_w(reference::normalize(reference::transform_direction(view, light.spot_direction)),
                        std::cos(light.spot_cutoff * std::numbers::pi / 180)));
  append(values, {light.attenuation[0], light.attenuation[1], light.attenuation[2], 0});
  append(values, {light.spot_exponent, light.spot_cutoff != 180 ? 1.0 : 0.0, 0, 0});
}

void append_material(Vectors& values, const reference::Material& material) {
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

}  // namespace

void set_program_lighting(const Programs& programs, const reference::Draw& draw,
                          const reference::LightModel& model, const std::vector<reference::Light>& lights,
                          const reference::Camera& camera, bool has_vertex_colors) {
  Vectors light_values;
  Vectors materials;
  Vectors ambient;
  for (const reference::Light& light : lights) append_light(light_values, light, camera.view_from_world);
  append_material(materials, draw.material);
  append_material(materials, draw.back_material);
  append(ambient, model.ambient);

  programs.set("light_count", static_cast<int>(lights.size()));
  if (!lights.empty()) programs.set("light_values", light_values);
  programs.set("materials", materials);
  programs.set("scene_ambient", ambient);
  programs.set("local_viewer", model.local_viewer ? 1 : 0);
  programs.set("phong_highlight", model.specular == reference::SpecularModel::kPhong ? 1 : 0);
  programs.set("color_material", has_vertex_colors ? color_material_number(draw.color_material) : 0);
  programs.set("normalize_normals", draw.normalize ? 1 : 0);
  programs.set("two_sided", model.two_sided ? 1 : 0);
  if (model.two_sided) glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
  else glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
}

}  // namespace tessera::mesa
