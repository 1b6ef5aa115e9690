#include "engine/scene/model_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shading/trigonometry.h"

namespace tessera {
namespace {

constexpr double kFovy = 36;  // degrees

double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 middle_of_bounds(const MeshData& mesh) {
  std::array<double, 3> low, high;
  for (std::size_t k = 0; k < 3; ++k) low[k] = high[k] = mesh.positions[k];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min<double>(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max<double>(high[i % 3], mesh.positions[i]);
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

// From the front, a little from above and from the right; as near as the picture's edges allow. A vertex at x, y and z
// towards the viewer is inside if |y| <= (distance - z) tan(fovy / 2), and likewise for x.
SceneCamera framing_camera(const MeshData& mesh, double aspect, const std::string& name) {
  const SinCos azimuth = sin_cos_degrees(25), elevation = sin_cos_degrees(17), half_fovy = sin_cos_degrees(kFovy / 2);
  const Vec3 right{azimuth.cosine, 0, -azimuth.sine};
  const Vec3 back{elevation.cosine * azimuth.sine, elevation.sine, elevation.cosine * azimuth.cosine};  // towards the viewer
  const Vec3 up{-elevation.sine * azimuth.sine, elevation.cosine, -elevation.sine * azimuth.cosine};
  const Vec3 centre = middle_of_bounds(mesh);

  constexpr double kMargin = 1.08;
  const double tangent_y = half_fovy.sine / half_fovy.cosine / kMargin, tangent_x = tangent_y * aspect;
  double distance = 0, radius = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const Vec3 p{mesh.positions[i] - centre.x, mesh.positions[i + 1] - centre.y, mesh.positions[i + 2] - centre.z};
    distance = std::max(distance, dot(p, back) + std::max(std::abs(dot(p, right)) / tangent_x, std::abs(dot(p, up)) / tangent_y));
    radius = std::max(radius, std::sqrt(dot(p, p)));
  }
  if (!(radius > 0)) throw Error(name + ": all vertices are at one place");
  distance = std::max(distance, 1.5 * radius);  // what is long in the direction of view stays away from the viewer's eye
  const Vec3 eye{centre.x + distance * back.x, centre.y + distance * back.y, centre.z + distance * back.z};
  return {.view = look_at(eye, centre, {0, 1, 0}), .projection = Lens{.fovy = kFovy, .near = distance - 1.01 * radius, .far = distance + 1.01 * radius}};
}

}  // namespace

Scene model_scene(const Model& model, const std::string& name, int width, int height) {
  Scene scene{.name = name, .title = name};
  scene.framebuffer.width = width;
  scene.framebuffer.height = height;
  scene.camera = framing_camera(model.mesh, static_cast<double>(width) / height, name);
  scene.light_model.local_viewer = true;
  scene.light_model.two_sided = true;  // models from outside have holes, and faces wound the wrong way
  scene.lights = {Light{.position = {0.15f, 0.75f, 0.65f, 0}}};  // towards the viewer, over the left shoulder
  scene.warnings = model.warnings;
  scene.frame.push_back({Clear{.color = Color{0.18f, 0.2f, 0.25f, 1}, .depth = 1.0, .stencil = 0u}, ""});

  const bool is_split = model.parts.size() > 1;
  Model smooth;
  if (is_split && model.mesh.normals.empty()) {
    smooth = model;
    add_smooth_normals(smooth.mesh);
  }
  const Model& source = smooth.parts.empty() ? model : smooth;
  for (std::size_t part = 0; part < source.parts.size(); ++part) {
    scene.meshes.push_back(is_split ? part_mesh(source, part) : source.mesh);
    DrawCommand draw{.mesh = part};
    draw.state.material = source.parts[part].material;
    if (source.parts[part].material_name.empty()) draw.state.color_material = ColorMaterial::ambient_and_diffuse;  // where there are colours
    draw.state.shading = Shading::phong;
    scene.frame.push_back({draw, ""});
  }
  return scene;
}

}  // namespace tessera
