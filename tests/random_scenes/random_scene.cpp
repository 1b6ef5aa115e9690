#include "tests/random_scenes/random_scene.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera::test {
namespace {

using Json = nlohmann::ordered_json;

/// xorshift64*.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u | 1) {
    for (int i = 0; i < 8; ++i) roll();
  }
  std::uint32_t roll() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// From `low` to `high`, both included.
  int between(int low, int high) {
    return low + static_cast<int>(roll() % static_cast<std::uint32_t>(high - low + 1));
  }
  bool one_in(int n) { return between(1, n) == 1; }
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[static_cast<std::size_t>(between(0, static_cast<int>(values.size()) - 1))];
  }
  /// Thousandths as a number.
  double thousandths(int low, int high) { return between(low, high) / 1000.0; }
  Json color(int low, int high, double alpha = 1) {
    return {thousandths(low, high), thousandths(low, high), thousandths(low, high), alpha};
  }
  Json vector(int reach) {
    return {thousandths(-reach, reach), thousandths(-reach, reach), thousandths(-reach, reach)};
  }

 private:
  std::uint64_t state_;
};

/// Pixels per triangle, as powers of two: 2^first to 2^last.
struct SizeClass {
  int first, last;
};
constexpr SizeClass kSizeClasses[] = {{-1, 1}, {3, 5}, {7, 9}};

constexpr int kSceneHeight = 480;
constexpr int kMaxTriangles = 200000;
constexpr int kMinTriangles = 1000;

/// A built-in mesh of triangles * detail^2 - pole_triangles * detail triangles.
struct Shape {
  const char* name;
  int triangles;
  int pole_triangles = 0;
};
constexpr Shape kShapes[] = {{"teapot", 64, 8}, {"sphere", 4, 4}, {"torus", 4}, {"cube", 12}, {"grid", 2}};

/// The largest detail whose mesh has at most this number of triangles.
int detail_of(const Shape& shape, int triangles) {
  int detail = 2;
  while ((detail + 1) * (detail + 1) * shape.triangles <= triangles) ++detail;
  return detail;
}

Json random_light(Dice& dice) {
  Json light;
  const int kind = dice.between(0, 3);  // directional, point, spot, narrow spot
  light["diffuse"] = dice.color(0, 900);
  light["specular"] = dice.one_in(3) ? Json{0, 0, 0, 1} : dice.color(0, 800);
  if (dice.one_in(4)) light["ambient"] = dice.color(0, 150);
  Json position = dice.vector(4000);
  position.push_back(kind == 0 ? 0 : 1);
  if (kind == 0 && position[0] == 0 && position[1] == 0 && position[2] == 0) position[2] = 1;
  light["position"] = position;
  if (kind >= 2) {
    light["spot_direction"] = dice.vector(1000);
    light["spot_cutoff"] = kind == 2 ? dice.between(10, 90) : dice.between(0, 10);
    light["spot_exponent"] = dice.one_of({0, 1, 8, 40});
  }
  if (kind != 0 && dice.one_in(2))
    light["attenuation"] = {dice.thousandths(0, 1000), dice.thousandths(0, 500), dice.thousandths(0, 200)};
  return light;
}

Json random_lights(Dice& dice) {
  Json lights = Json::array();
  for (int n = dice.one_in(10) ? dice.between(32, 64) : dice.between(1, 8); n > 0; --n)
    lights.push_back(random_light(dice));
  return lights;
}

Json random_material(Dice& dice) {
  Json material;
  material["diffuse"] = dice.color(100, 1000, dice.one_of({1.0, 1.0, 1.0, 0.6, 0.0}));
  material["ambient"] = dice.color(0, 300);
  if (dice.one_in(2)) material["specular"] = dice.color(0, 800);
  if (dice.one_in(8)) material["emission"] = dice.color(0, 200);
  material["shininess"] = dice.one_of({0, 4, 20, 100, 1000});
  return material;
}

Json random_texture(Dice& dice) {
  const int channels = dice.one_of({1, 3, 3, 4, 4});
  const bool is_opaque = dice.one_in(2);
  Json rows = Json::array();
  const int width = dice.one_of({1, 4, 8}), height = dice.one_of({1, 4, 8});
  for (int y = 0; y < height; ++y) {
    std::string row;
    for (int i = 0; i < width * channels; ++i) {
      const bool is_alpha = channels == 4 && i % 4 == 3;
      const int level = is_alpha && is_opaque ? 255 : dice.between(0, 255);
      row.push_back("0123456789abcdef"[level / 16]);
      row.push_back("0123456789abcdef"[level % 16]);
    }
    rows.push_back(row);
  }
  return {{"channels", channels},
          {"rows", rows},
          {"mag", dice.one_of({"nearest", "linear"})},
          {"min", dice.one_of({"nearest", "linear", "linear_mipmap_linear", "nearest_mipmap_nearest"})},
          {"wrap_s", dice.one_of({"repeat", "clamp_to_edge", "mirrored_repeat"})}};
}

Json random_stencil(Dice& dice) {
  return {{"func", dice.one_of({"always", "equal", "gequal", "notequal"})},
          {"ref", dice.between(0, 3)},
          {"fail", dice.one_of({"keep", "incr", "zero"})},
          {"zfail", dice.one_of({"keep", "decr_wrap"})},
          {"zpass", dice.one_of({"keep", "incr", "replace", "invert"})}};
}

void add_operations(Json& draw, Dice& dice, bool is_rgb) {
  if (dice.one_in(4)) draw["stencil"] = random_stencil(dice);
  if (is_rgb && dice.one_in(5))
    draw["alpha_test"] = {{"func", dice.one_of({"greater", "lequal", "notequal"})},
                          {"ref", dice.one_of({0.0, 0.5, 1.0})}};
  if (is_rgb && dice.one_in(3))
    draw["blend"] = {{"src", dice.one_of({"src_alpha", "src_alpha", "one"})},
                     {"dst", dice.one_of({"one_minus_src_alpha", "one_minus_src_alpha", "one", "zero"})},
                     {"equation", dice.one_of({"add", "add", "add", "reverse_subtract", "max"})}};
  else if (dice.one_in(10)) draw["logic_op"] = dice.one_of({"copy", "xor", "invert", "or"});
  if (dice.one_in(8))
    draw["color_mask"] = is_rgb ? Json{true, dice.one_in(2), true, true} : Json{true, true, true, true};
  if (dice.one_in(8)) draw["scissor"] = {dice.between(0, 200), dice.between(0, 150), 400, 300};
  if (dice.one_in(6))
    draw["depth"] = {{"test", dice.one_of({"lequal", "always", "greater"})}, {"write", dice.one_in(2)}};
  if (dice.one_in(10)) draw["polygon_offset"] = {1, 1};
}

Json random_transform(Dice& dice, double size) {
  return {
      {{"translate",
        {dice.thousandths(-1500, 1500), dice.thousandths(-1000, 1000), dice.thousandths(-1500, 500)}}},
      {{"rotate", {dice.between(0, 359), dice.thousandths(-1000, 1000), dice.thousandths(-1000, 1000), 1}}},
      {{"scale", {size, size, size}}}};
}

Json random_draw(Dice& dice, const std::string& mesh, double size, bool is_rgb) {
  Json draw;
  draw["draw"] = mesh;
  draw["material"] = dice.one_of({"a", "b", "c"});
  draw["transform"] = random_transform(dice, size);
  draw["shading"] = dice.one_of({"flat", "gouraud", "gouraud", "phong", "phong"});
  if (dice.one_in(6)) draw["lighting"] = false;
  if (dice.one_in(4)) draw["cull"] = dice.one_of({"back", "front"});
  if (dice.one_in(12)) draw["polygon_mode"] = dice.one_of({"line", "point"});
  if (dice.one_in(5)) draw["normalize"] = false;
  if (is_rgb && dice.one_in(3)) {
    draw["texture"] = "t";
    draw["texture_env"] = dice.one_of({"modulate", "modulate", "replace", "decal", "blend", "add"});
  }
  add_operations(draw, dice, is_rgb);
  return draw;
}

Json random_framebuffer(Dice& dice, bool is_rgb) {
  Json buffer{{"width", 640}, {"height", kSceneHeight}};
  buffer["color"] = is_rgb ? Json{{"mode", "rgb"}, {"bits", dice.one_of({24, 24, 24, 24, 16, 8})}}
                           : Json{{"mode", "index"}, {"bits", 8}};
  buffer["depth"] = dice.one_of({"unorm16", "unorm24", "unorm24", "unorm32", "float32"});
  if (!is_rgb) return buffer;
  if (dice.one_in(8)) buffer["alpha"] = 8;
  if (dice.one_in(8)) buffer["dither"] = dice.one_of({"bayer2", "bayer4", "bayer8"});
  if (dice.one_in(8)) buffer["samples"] = dice.one_of({4, 8});
  return buffer;
}

/// Adds the meshes and draws of a scene, with triangles of the scene's size class.
void add_objects(Json& scene, Dice& dice, const SizeClass& sizes, bool is_rgb) {
  const int objects = dice.between(1, 12);
  int triangles = 0, pole_triangles = 0;
  for (int i = 0; i < objects || triangles - pole_triangles < kMinTriangles; ++i) {
    const double size = dice.thousandths(300, 1300);
    // A sphere of this radius at the distance of the origin: 2 pi r^2 pixels on both of its sides.
    const double radius = size * kSceneHeight / 4;
    const double area = 6.28 * radius * radius;
    const int power = dice.between(sizes.first, sizes.last);
    const double pixels = power < 0 ? 0.5 : static_cast<double>(1 << power);
    const int share = std::max((kMaxTriangles - triangles) / 2, 64);
    const Shape shape = kShapes[dice.between(0, 4)];
    const int detail = std::min(detail_of(shape, std::min(static_cast<int>(area / pixels), share)), 512);
    triangles += detail * detail * shape.triangles;
    pole_triangles += detail * shape.pole_triangles;
    const std::string mesh = "m" + std::to_string(i);
    scene["meshes"][mesh] = {{"builtin", shape.name}, {"detail", detail}};
    scene["frame"].push_back(random_draw(dice, mesh, size, is_rgb));
  }
}

Json random_stages(Dice& dice, bool has_samples) {
  Json stages = Json::array();
  for (int n = dice.between(0, 3); n > 0; --n) {
    switch (dice.between(0, 6)) {
      case 0: stages.push_back({{"name", "gradient_object_y"}}); break;
      case 1:
        stages.push_back({{"name", "gradient_screen_y"},
                          {"colors", {dice.color(0, 1000), dice.color(0, 1000, 0.5), dice.color(0, 1000)}}});
        break;
      case 2: stages.push_back({{"name", "uncover"}, {"amount", dice.thousandths(200, 1000)}}); break;
      case 3: stages.push_back({{"name", "reverse_z"}, {"space", "clip"}}); break;
      case 4:
        // With several samples the depth of sample 0 replaces those of all samples.
        if (!has_samples) stages.push_back({{"name", "reverse_z"}, {"space", "window"}});
        break;
      case 5: stages.push_back({{"name", "zoom"}, {"factor", dice.thousandths(400, 2500)}}); break;
      default:
        stages.push_back({{"name", "falloff"},
                          {"from", dice.vector(2000)},
                          {"exponent", dice.one_of({0.0, 0.5, 1.0, 1.5, 2.0})}});
    }
  }
  return stages;
}

/// At most two stages that need three extra varyings each.
bool fits_extras(const Json& stages) {
  return std::count_if(stages.begin(), stages.end(),
                       [](const Json& stage) { return stage["name"] == "falloff"; }) <= 2;
}

}  // namespace

std::string random_scene(std::uint64_t seed) {
  Dice dice(seed);
  const bool is_rgb = !dice.one_in(12);
  Json scene;
  scene["tessera"] = 1;
  scene["title"] = "random scene " + std::to_string(seed);
  scene["framebuffer"] = random_framebuffer(dice, is_rgb);
  scene["camera"] = {{"eye", {0, 0.3, 4.83}}, {"target", {0, 0, 0}}};
  scene["light_model"] = {{"local_viewer", dice.one_in(3)},
                          {"two_sided", dice.one_in(4)},
                          {"specular", dice.one_of({"blinn", "blinn", "phong"})}};
  scene["lights"] = random_lights(dice);
  for (const char* name : {"a", "b", "c"}) scene["materials"][name] = random_material(dice);
  scene["textures"]["t"] = random_texture(dice);
  scene["frame"] = Json::array({{{"clear", {{"color", dice.color(0, 500)}, {"depth", 1}, {"stencil", 0}}}}});
  add_objects(scene, dice, kSizeClasses[seed % 3], is_rgb);
  return scene.dump(1) + "\n";
}

std::string random_scene_with_stages(std::uint64_t seed) {
  Json scene = Json::parse(random_scene(seed));
  Dice dice(seed + 1000000);
  scene["framebuffer"]["width"] = 200;
  scene["framebuffer"]["height"] = 150;
  const bool has_samples = scene["framebuffer"].contains("samples");
  for (auto& [name, mesh] : scene["meshes"].items()) mesh["detail"] = std::min(mesh["detail"].get<int>(), 6);
  for (Json& command : scene["frame"]) {
    if (!command.contains("draw")) continue;
    const Json stages = random_stages(dice, has_samples);
    if (fits_extras(stages)) command["stages"] = stages;
    // Where alpha equals the reference, or bits of levels are combined, roundings would change the picture.
    if (command.contains("alpha_test")) command["alpha_test"]["ref"] = 0.37;
    command.erase("logic_op");
    if (command.contains("scissor")) command["scissor"] = {20, 15, 120, 100};
  }
  return scene.dump(1) + "\n";
}

}  // namespace tessera::test
