// Spheres under 1 to 8 point or spot lights, with per-vertex and per-pixel lighting.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/passing_stages.h"
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
  bool has_stage = false;  ///< a fragment stage that passes colours through
  bool is_textured = false;
};

/// Texture coordinates from 0 to 1 around the sphere and from pole to pole.
void add_texcoords(MeshData& mesh, int columns, int rows) {
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      mesh.texcoords.insert(mesh.texcoords.end(), {static_cast<float>(x) / static_cast<float>(columns),
                                                   static_cast<float>(y) / static_cast<float>(rows)});
}

constexpr int kTexels = 512;  // per side

/// RGBA. Red is 1, so that it stays as the lighting equation has it; green and blue are smooth waves.
std::vector<std::uint8_t> wave_texels() {
  std::vector<std::uint8_t> texels;
  const auto wave = [](int i) {
    return static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::sin(2 * std::numbers::pi * i / 32)));
  };
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) texels.insert(texels.end(), {255, wave(x + y), wave(2 * y), 255});
  return texels;
}

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
          .is_textured = scene.is_textured,
          .normalizes = scene.shading == Shading::phong};
}

Drawing lit_sphere(int width, int height, const LitSphere& scene) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  drawing.meshes.push_back(sphere(scene.columns, scene.columns / 2, static_cast<float>(kRadius)));
  const rivals::LitDraw lit = lit_draw(width, height, scene);
  std::vector<std::uint8_t> texels;
  if (scene.is_textured) {
    add_texcoords(drawing.meshes.front(), scene.columns, scene.columns / 2);
    texels = wave_texels();
    drawing.textures.emplace_back(
        TextureImage{.pixels = texels.data(), .width = kTexels, .height = kTexels, .bottom_row_first = true});
  }
  drawing.record = [lit, has_stage = scene.has_stage](const Drawing& d, Frame& frame) {
    frame.set_camera(lit.camera);
    frame.set_lights(lit.lights);
    frame.set_light_model(lit.model);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.shading = lit.shading;
    state.normalize = lit.normalizes;
    state.cull = Cull::back;
    state.material = lit.material;
    if (has_stage) state.fragment_stage = kPassingFragmentStage;
    if (!d.textures.empty()) state.texture = &d.textures.front();
    frame.draw(d.meshes.front().view(), state);
  };
  drawing.gl_workload = [lit, texels](const Drawing& d) {
    return GlWorkload{.mesh = d.meshes.front(),
                      .shaders = rivals::lit_shaders(lit),
                      .width = d.format.width,
                      .height = d.format.height,
                      .tests_depth = true,
                      .culls_back = true,
                      .texture_size = texels.empty() ? 0 : kTexels,
                      .texels = texels};
  };
  if (scene.has_stage) drawing.gl_workload = nullptr;
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

WorkloadEntry phong_with_stage() {
  WorkloadEntry entry =
      drawn_outside_mean("stage-phong-20k-8", "phong-20k-8 with a fragment stage that passes colours through",
                         [](int width, int height, std::uint32_t) {
                           return lit_sphere(width, height, {.lights = 8, .has_stage = true});
                         });
  entry.baseline = "phong-20k-8";
  return entry;
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
  list.push_back(drawn_outside_mean("textured-20k",
                                    "a sphere of 20k triangles, lit per vertex by a point light, times a "
                                    "trilinear texture of 512x512 texels",
                                    [](int width, int height, std::uint32_t) {
                                      return lit_sphere(width, height,
                                                        {.shading = Shading::gouraud, .is_textured = true});
                                    }));
  list.push_back(drawn_outside_mean(
      "small-64x64", "a frame of 64x64 pixels: a sphere of 400 triangles, lit per pixel by a point light",
      [](int, int, std::uint32_t) { return lit_sphere(64, 64, {.columns = 20}); }));
  for (const auto& [width, height] :
       {std::pair{320, 200}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}, {7680, 4320}})
    list.push_back(sphere_in_frame(width, height));
  return list;
}

}  // namespace tessera::bench
