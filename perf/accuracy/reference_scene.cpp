#include "perf/accuracy/reference_scene.h"

#include <cmath>

namespace tessera::accuracy {
namespace {

reference::Vec4 vec4(const Color& c) { return {c.r, c.g, c.b, c.a}; }
reference::Vec3 vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

reference::Mat4 mat4(const Matrix& matrix) {
  reference::Mat4 result;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) result.rows[row][column] = matrix.m[4 * row + column];
  return result;
}

reference::Material material_of(const Material& m) {
  return {vec4(m.ambient), vec4(m.diffuse), vec4(m.specular), vec4(m.emission), m.shininess, {}};
}

reference::Light light_of(const Light& l) {
  return {.ambient = vec4(l.ambient),
          .diffuse = vec4(l.diffuse),
          .specular = vec4(l.specular),
          .position = {l.position[0], l.position[1], l.position[2], l.position[3]},
          .spot_direction = vec3(l.spot_direction),
          .spot_exponent = l.spot_exponent,
          .spot_cutoff = l.spot_cutoff,
          .attenuation = {l.attenuation_constant, l.attenuation_linear, l.attenuation_quadratic}};
}

reference::Mesh mesh_of(const program::MeshData& data) {
  reference::Mesh mesh;
  mesh.name = data.name;
  for (std::size_t i = 0; i < data.vertex_count(); ++i) {
    mesh.positions.push_back(
        {data.positions[3 * i], data.positions[3 * i + 1], data.positions[3 * i + 2], 1});
    if (!data.normals.empty())
      mesh.normals.push_back({data.normals[3 * i], data.normals[3 * i + 1], data.normals[3 * i + 2]});
    if (!data.colors.empty())
      mesh.colors.push_back(
          {data.colors[4 * i], data.colors[4 * i + 1], data.colors[4 * i + 2], data.colors[4 * i + 3]});
  }
  mesh.indices = data.indices;
  if (mesh.indices.empty())
    for (std::uint32_t i = 0; i < data.vertex_count(); ++i) mesh.indices.push_back(i);
  return mesh;
}

reference::Draw draw_of(const program::DrawCommand& command) {
  reference::Draw draw;
  draw.mesh = command.mesh;
  draw.material = draw.back_material = material_of(command.state.material);
  draw.color_material = command.state.color_material == ColorMaterial::none
                            ? reference::ColorMaterial::kNone
                            : reference::ColorMaterial::kAmbientAndDiffuse;
  draw.shading = reference::Shading::kPhong;
  return draw;
}

}  // namespace

reference::Scene reference_scene(const program::Scene& scene) {
  const auto [width, height] = std::pair{scene.framebuffer.width, scene.framebuffer.height};
  const Camera camera = scene.camera.at_aspect(static_cast<double>(width) / height);
  reference::Scene result;
  result.title = scene.title;
  result.framebuffer.width_px = width;
  result.framebuffer.height_px = height;
  result.camera.view_from_world = mat4(camera.view);
  result.camera.clip_from_view = mat4(camera.projection);
  const auto* lens = std::get_if<program::Lens>(&scene.camera.projection);
  result.camera.infinite_far = lens != nullptr && std::isinf(lens->far);
  result.light_model = {.ambient = vec4(scene.light_model.ambient),
                        .local_viewer = scene.light_model.local_viewer,
                        .two_sided = scene.light_model.two_sided};
  for (const Light& light : scene.lights) result.lights.push_back(light_of(light));
  for (const program::MeshData& mesh : scene.meshes) result.meshes.push_back(mesh_of(mesh));
  for (const program::SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.value))
      result.frame.push_back(reference::Clear{
          .color = vec4(clear->color.value()), .depth = clear->depth, .stencil = clear->stencil});
    if (const auto* draw = std::get_if<program::DrawCommand>(&command.value))
      result.frame.push_back(draw_of(*draw));
  }
  return result;
}

}  // namespace tessera::accuracy
