// Spheres under 1 to 8 point or spot lights, with per-vertex and per-pixel lighting.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
namespace {

constexpr double kDistance = 4;  // from the eye to the sphere's centre
constexpr double kRadius = 1.9;
constexpr float kRed = 0.41f;  // ambient and diffuse reflectance
constexpr float kShininess = 50;

// Columns of a sphere with about that many triangles.
constexpr int kColumns20k = 142;
constexpr int kColumns500k = 708;

struct LitSphere {
  int columns = kColumns20k;  ///< the sphere has columns^2 triangles
  Shading shading = Shading::phong;
  int lights = 1;
  bool has_spots = false;  ///< spot lights instead of point lights
};

/// Lights in a ring in front of the sphere, near enough for their directions to vary over it.
std::vector<Light> ring_of_lights(int count, bool are_spots) {
  std::vector<Light> lights;
  for (int k = 0; k < count; ++k) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / 8;
    const float x = 3 * std::cos(angle);
    const float y = 3 * std::sin(angle);
    const float z = 3;
    Light light;
    light.position = {x, y, z, 1};
    light.diffuse = {0.4f, 0.4f, 0.4f, 1};
    light.specular = {0.5f, 0.5f, 0.5f, 1};
    light.attenuation_linear = 0.05f;
    if (are_spots) {
      light.spot_direction = {-x, -y, -z};
      light.spot_cutoff = 40;
      light.spot_exponent = 8;
    }
    lights.push_back(light);
  }
  return lights;
}

/// Red, 0 to 1, of the sphere's point nearest to the eye, by the lighting equation in double precision.
double red_at_center(const std::vector<Light>& lights) {
  double red = 0.2 * kRed;
  for (const Light& light : lights) {
    const double x = light.position[0];
    const double y = light.position[1];
    const double z = light.position[2] - kRadius;
    const double distance = std::hypot(x, y, z);
    // The normal and the direction to the eye are both +z. Cosines between the normal and the direction to
    // the light, and between the normal and Blinn's half vector.
    const double cos_light = z / distance;
    const double cos_half = std::sqrt((1 + cos_light) / 2);
    double strength = 1 / (1 + double{light.attenuation_linear} * distance);
    if (light.spot_cutoff < 180) {
      // The spot points to the origin.
      const double aim = std::hypot(light.position[0], light.position[1], light.position[2]);
      const double cos_aim =
          (x * light.position[0] + y * light.position[1] + z * light.position[2]) / (distance * aim);
      const bool is_in_cone = cos_aim >= std::cos(double{light.spot_cutoff} * std::numbers::pi / 180);
      strength *= is_in_cone ? std::pow(cos_aim, light.spot_exponent) : 0;
    }
    const double diffuse = cos_light * light.diffuse.r * kRed;
    const double highlight = std::pow(cos_half, kShininess) * light.specular.r;
    red += strength * (diffuse + highlight);
  }
  return std::min(red, 1.0);
}

/// Checks the covered area and the red of the central pixel.
///
/// The outline is a circle: the tangents from the eye to the sphere meet the image plane, at distance 1, at
/// kRadius / sqrt(kDistance^2 - kRadius^2) from its centre. The image plane is 1 unit high.
std::string sphere_fault(const Picture& picture, double red) {
  const double radius = kRadius / std::sqrt(kDistance * kDistance - kRadius * kRadius) * picture.height;
  const double expected = std::numbers::pi * radius * radius;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    covered += (picture.rgba[i] | picture.rgba[i + 1] | picture.rgba[i + 2]) != 0 ? 1 : 0;
  const bool is_cut = 2 * radius > std::min(picture.width, picture.height);
  const double difference = std::abs(static_cast<double>(covered) - expected);
  if (!is_cut && difference > 0.005 * expected + 8 * radius)
    return "covers " + std::to_string(covered) + " pixels, expected about " +
           std::to_string(std::llround(expected));
  const auto center = static_cast<std::size_t>(picture.height / 2 * picture.width + picture.width / 2);
  const int found = picture.rgba[4 * center];
  if (std::abs(found - 255 * red) > 5)
    return "red at the centre is " + std::to_string(found) + ", expected about " +
           std::to_string(std::lround(255 * red));
  return {};
}

rivals::LitDraw lit_draw(int width, int height, const LitSphere& scene) {
  const double aspect = static_cast<double>(width) / height;
  return {.camera = {.view = translate(0, 0, -kDistance),
                     .projection = frustum(-0.5 * aspect, 0.5 * aspect, -0.5, 0.5, 1, 20)},
          .lights = ring_of_lights(scene.lights, scene.has_spots),
          .model = {.local_viewer = true},
          .material = {.ambient = {kRed, 0.135f, 0.067f, 1},
                       .diffuse = {kRed, 0.135f, 0.067f, 1},
                       .specular = {1, 1, 1, 1},
                       .shininess = kShininess},
          .shading = scene.shading,
          .normalizes = scene.shading == Shading::phong};
}

Drawing lit_sphere(int width, int height, const LitSphere& scene) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  drawing.meshes.push_back(sphere(scene.columns, scene.columns / 2, static_cast<float>(kRadius)));
  const rivals::LitDraw lit = lit_draw(width, height, scene);
  drawing.record = [lit](const Drawing& d, Frame& frame) {
    frame.set_camera(lit.camera);
    frame.set_lights(lit.lights);
    frame.set_light_model(lit.model);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.shading = lit.shading;
    state.normalize = lit.normalizes;
    state.cull = Cull::back;
    state.material = lit.material;
    frame.draw(d.meshes.front().view(), state);
  };
  drawing.gl_workload = [lit](const Drawing& d) {
    return GlWorkload{.mesh = d.meshes.front(),
                      .shaders = rivals::lit_shaders(lit),
                      .tests_depth = true,
                      .culls_back = true};
  };
  drawing.fault = [red = red_at_center(lit.lights)](const Picture& picture) {
    return sphere_fault(picture, red);
  };
  return drawing;
}

/// @param size  number of triangles in words, part of the name
WorkloadEntry lit_entry(const std::string& size, const LitSphere& scene) {
  const bool is_phong = scene.shading == Shading::phong;
  const std::string count = std::to_string(scene.lights);
  const std::string name =
      (is_phong ? "phong-" : "vertex-") + size + "-" + count + (scene.has_spots ? "-spot" : "");
  const std::string description =
      "a sphere of " + size + " triangles, lit per " + (is_phong ? "pixel" : "vertex") + " by " + count +
      (scene.has_spots ? " spot" : " point") + (scene.lights > 1 ? " lights" : " light");
  return drawn(name, description,
               [scene](int width, int height, std::uint32_t) { return lit_sphere(width, height, scene); });
}

}  // namespace

WorkloadEntry sphere_in_frame(int width, int height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  return drawn_outside_mean(
      "size-" + size, "phong-20k-1 in a frame of " + size, [=](int, int, std::uint32_t) {
        Drawing drawing = lit_sphere(width, height, {});
        drawing.gl_workload = nullptr;  // rivals draw frames of the size from the command line only
        return drawing;
      });
}

WorkloadEntry sphere_with_lights(int lights) { return lit_entry("20k", {.lights = lights}); }

std::vector<WorkloadEntry> lit_workloads() {
  std::vector<WorkloadEntry> list;
  for (const auto& [size, columns] : {std::pair{"20k", kColumns20k}, {"500k", kColumns500k}})
    for (const int lights : {1, 8})
      list.push_back(lit_entry(size, {.columns = columns, .shading = Shading::gouraud, .lights = lights}));
  for (const bool has_spots : {false, true})
    for (const int lights : {1, 4, 8})
      list.push_back(lit_entry("20k", {.lights = lights, .has_spots = has_spots}));
  for (const auto& [width, height] :
       {std::pair{320, 200}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}, {7680, 4320}})
    list.push_back(sphere_in_frame(width, height));
  return list;
}

}  // namespace tessera::bench
