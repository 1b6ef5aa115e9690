#include "perf/accuracy/scene_list.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <nlohmann/json.hpp>

namespace tessera::accuracy {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kBunny = "/usr/share/glmark2/models/bunny.obj";  // Debian package glmark2-data

Json camera(Json eye, Json target, double fovy, double near = 0.5, double far = 60) {
  return {{"eye", std::move(eye)},
          {"target", std::move(target)},
          {"projection", {{"fovy", fovy}, {"near", near}, {"far", far}}}};
}

Json material(Json color, double specular, double shininess) {
  return {{"ambient", color},
          {"diffuse", color},
          {"specular", {specular, specular, specular, 1}},
          {"shininess", shininess}};
}

Json point_light(double x, double y, double z, Json color, Json attenuation) {
  return {{"position", {x, y, z, 1}},
          {"diffuse", color},
          {"specular", color},
          {"attenuation", std::move(attenuation)}};
}

/// A scene with one white light from the upper right, without draws.
Json empty_scene(Json view) {
  return {{"tessera", 1},
          {"framebuffer", {{"width", kSceneWidth}, {"height", kSceneHeight}, {"stencil", 0}}},
          {"camera", std::move(view)},
          {"light_model", {{"local_viewer", true}}},
          {"lights", {{{"position", {1, 1.2, 1, 0}}}}},
          {"materials", Json::object()},
          {"meshes", Json::object()},
          {"frame", {{{"clear", {{"color", {0.16, 0.18, 0.23, 1}}, {"depth", 1}}}}}}};
}

void add_mesh(Json& scene, const std::string& mesh, int detail) {
  scene["meshes"][mesh] = {{"builtin", mesh}, {"detail", detail}};
}

/// Appends a Phong-shaded draw.
Json& add_draw(Json& scene, const std::string& mesh, const std::string& material_name, Json transform) {
  scene["frame"].push_back({{"draw", mesh},
                            {"material", material_name},
                            {"shading", "phong"},
                            {"transform", std::move(transform)}});
  return scene["frame"].back();
}

/// A ground below the other meshes, and a wall behind them where colours vary smoothly, too. Grids lie in the
/// plane z = 0.
/// @param y, z       of ground and wall
/// @param half_size  of both
void add_room(Json& scene, int detail, double y, double z, double half_size) {
  scene["meshes"]["plane"] = {{"builtin", "grid"}, {"detail", detail}};
  scene["materials"]["ground"] = material({0.5, 0.5, 0.46, 1}, 0.3, 20);
  scene["materials"]["wall"] = material({0.3, 0.36, 0.46, 1}, 0.2, 12);
  const Json size = {{"scale", {half_size, half_size, 1}}};
  add_draw(scene, "plane", "ground", {{{"translate", {0, y, 0}}}, {{"rotate", {-90, 1, 0, 0}}}, size});
  add_draw(scene, "plane", "wall", {{{"translate", {0, y, z}}}, size});
}

SceneText text(const std::string& name, const std::string& title, const Json& scene) {
  return {.name = name, .title = title, .json = scene.dump()};
}

/// The wall in front of a point light: an interpolated highlight is wrong on large quads.
SceneText wall(int quads) {
  Json scene = empty_scene(camera({0, 0, 3}, {0, 0, 0}, 37));
  scene["lights"] = {point_light(0.3, 0.2, 1.1, {0.9, 0.85, 0.8, 1}, {1, 0, 0})};
  scene["materials"]["shiny"] = material({0.5, 0.3, 0.2, 1}, 0.6, 10);
  add_mesh(scene, "grid", quads);
  add_draw(scene, "grid", "shiny", {{{"scale", {1.3, 0.98, 1}}}});
  const std::string size = std::to_string(quads);
  SceneText result =
      text(wall_name(quads), "a shiny wall of " + size + "x" + size + " quads and a point light", scene);
  if (quads != 8) result.settings = SettingChoice::shading;
  result.in_quick_run = quads == 8;
  return result;
}

/// @param rows  of teapots, each farther away
SceneText teapots(const std::string& name, const std::string& title, Json view, int detail, int columns,
                  int rows) {
  Json scene = empty_scene(std::move(view));
  scene["lights"] = {point_light(3, 5, 4, {1, 0.98, 0.94, 1}, {1, 0, 0.004})};
  scene["materials"]["red"] = material({0.6, 0.2, 0.12, 1}, 0.8, 40);
  scene["materials"]["blue"] = material({0.15, 0.3, 0.6, 1}, 0.8, 40);
  add_mesh(scene, "teapot", detail);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      add_draw(scene, "teapot", (row + column) % 2 == 0 ? "red" : "blue",
               {{{"translate", {1.9 * (column - 0.5 * (columns - 1)), 0, -2.2 * row}}},
                {{"rotate", {35 * column + 20 * row, 0, 1, 0}}}});
  add_room(scene, 16, -0.5, -2.2 * rows - 2, 40);
  return text(name, title, scene);
}

/// A torus and two spheres under point lights on a spiral, which shine less the more there are.
SceneText lights(int count) {
  Json scene = empty_scene(camera({0, 1.6, 4.4}, {0, -0.1, 0}, 40));
  if (count == 64) {  // the reference takes 5 us per sample
    scene["framebuffer"]["width"] = kSceneWidth / 2;
    scene["framebuffer"]["height"] = kSceneHeight / 2;
  }
  scene["lights"] = Json::array();
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * (0.2 + 0.381966 * i);  // golden angle
    const double radius = 0.8 + 2.2 * std::sqrt((i + 0.5) / count);
    const double strength = 3 * std::pow(count, -0.7);
    const auto channel = [&](double phase) { return strength * (0.6 + 0.4 * std::cos(turn * 3 + phase)); };
    scene["lights"].push_back(point_light(radius * std::cos(turn), 1.1 + 0.2 * (i % 5),
                                          radius * std::sin(turn),
                                          {channel(0), channel(2.1), channel(4.2), 1}, {0.6, 0.2, 0.4}));
  }
  scene["light_model"]["ambient"] = {0.15, 0.15, 0.15, 1};
  scene["materials"]["ivory"] = material({0.75, 0.72, 0.65, 1}, 0.5, 30);
  add_mesh(scene, "torus", 32);
  add_mesh(scene, "sphere", 24);
  add_draw(scene, "torus", "ivory", {{{"translate", {0, 0, 0}}}, {{"rotate", {60, 1, 0.2, 0}}}});
  add_draw(scene, "sphere", "ivory", {{{"translate", {-1.7, -0.2, -0.6}}}, {{"scale", {0.5, 0.5, 0.5}}}});
  add_draw(scene, "sphere", "ivory", {{{"translate", {1.7, -0.2, -0.6}}}, {{"scale", {0.5, 0.5, 0.5}}}});
  add_room(scene, 24, -0.75, -3, 9);
  const std::string number = std::to_string(count);
  SceneText result = text(
      "lights-" + number,
      number + (count == 1 ? " point light" : " point lights") + " on a torus, spheres and a ground", scene);
  if (count == 64) result.settings = SettingChoice::steps;
  return result;
}

SceneText spots() {
  Json scene = empty_scene(camera({0, 2.2, 4.6}, {0, -0.3, 0}, 38));
  scene["lights"] = Json::array();
  for (int i = 0; i < 6; ++i) {
    const double turn = 2 * std::numbers::pi * i / 6;
    Json light = point_light(
        1.8 * std::cos(turn), 2, 1.8 * std::sin(turn),
        {0.5 + 0.4 * std::cos(turn), 0.5 + 0.4 * std::cos(turn + 2.1), 0.5 + 0.4 * std::cos(turn + 4.2), 1},
        {1, 0, 0.05});
    light["spot_direction"] = {-0.35 * std::cos(turn), -1, -0.35 * std::sin(turn)};
    light["spot_cutoff"] = 26;
    light["spot_exponent"] = 12;
    scene["lights"].push_back(std::move(light));
  }
  scene["materials"]["white"] = material({0.8, 0.8, 0.8, 1}, 0.4, 25);
  add_mesh(scene, "sphere", 24);
  add_draw(scene, "sphere", "white", {{{"translate", {0, 0, 0}}}, {{"scale", {0.75, 0.75, 0.75}}}});
  add_room(scene, 16, -0.75, -3, 8);
  return text("spots", "six spot lights on a sphere and a ground", scene);
}

/// One teapot, close, of a matt or a glossy material.
SceneText single_teapot(const std::string& name, const std::string& title, double specular,
                        double shininess) {
  Json scene = empty_scene(camera({0.4, 0.9, 2.9}, {0, -0.05, 0}, 40));
  scene["lights"] = {point_light(1.5, 2.4, 2.2, {1, 0.98, 0.94, 1}, {0.9, 0, 0.03})};
  scene["materials"]["surface"] = material({0.45, 0.4, 0.2, 1}, specular, shininess);
  add_mesh(scene, "teapot", 8);
  add_draw(scene, "teapot", "surface", {{{"rotate", {25, 0, 1, 0}}}});
  add_room(scene, 12, -0.5, -2.5, 10);
  return text(name, title, scene);
}

/// A lit checkerboard to the horizon. Mipmaps: without them a checkerboard aliases.
SceneText textured_floor() {
  constexpr int kQuads = 8;
  Json scene = empty_scene(camera({0.4, 0.7, 4}, {0, -0.35, 0}, 45, 0.2, 80));
  Json positions = Json::array(), normals = Json::array(), texcoords = Json::array(), indices = Json::array();
  for (int j = 0; j <= kQuads; ++j)
    for (int i = 0; i <= kQuads; ++i) {
      const double s = static_cast<double>(i) / kQuads, t = static_cast<double>(j) / kQuads;
      positions.push_back({24 * s - 12, -0.75, 4 - 36 * t});
      normals.push_back({0, 1, 0});
      texcoords.push_back({12 * s, 18 * t});
    }
  for (int j = 0; j < kQuads; ++j)
    for (int i = 0; i < kQuads; ++i) {
      const int corner = j * (kQuads + 1) + i;
      for (const int index : {corner, corner + 1, corner + kQuads + 2, corner + kQuads + 1})
        indices.push_back(index);
    }
  scene["meshes"]["floor"] = {{"primitive", "quads"},
                              {"positions", positions},
                              {"normals", normals},
                              {"texcoords", texcoords},
                              {"indices", indices}};
  // A tile of 64x64 texels: a checkerboard of 2x2 fields with a dark joint and a slight ramp.
  constexpr int kTexels = 64;
  Json rows = Json::array();
  for (int y = 0; y < kTexels; ++y) {
    std::string row;
    for (int x = 0; x < kTexels; ++x) {
      const bool is_joint = x % 32 < 2 || y % 32 < 2;
      const int level = is_joint ? 60 : ((x / 32 + y / 32) % 2 == 0 ? 225 : 120) + (x + y) / 8;
      constexpr char kDigits[] = "0123456789abcdef";
      row += {kDigits[level / 16], kDigits[level % 16]};
    }
    rows.push_back(row);
  }
  scene["textures"]["tile"] = {
      {"rows", rows}, {"channels", 1}, {"mag", "linear"}, {"min", "linear_mipmap_linear"}};
  scene["lights"] = {point_light(0.5, 1.5, 0.5, {1, 0.95, 0.85, 1}, {0.7, 0.03, 0.02})};
  scene["materials"]["stone"] = material({0.85, 0.85, 0.85, 1}, 0.25, 20);
  add_draw(scene, "floor", "stone", Json::array())["texture"] = "tile";
  return text("floor", "a textured floor to the horizon, trilinear, lit by a point light", scene);
}

/// Pairs of panels that cross at small angles, up to far away: depth differences shrink with the square of
/// the distance. 24 bits resolve them, 16 do not.
SceneText steep_depth() {
  Json scene = empty_scene(camera({0, 1.2, 4}, {0, 0.4, -6}, 40, 0.1, 2000));
  scene["materials"]["near"] = material({0.7, 0.45, 0.15, 1}, 0.3, 20);
  scene["materials"]["far"] = material({0.2, 0.4, 0.55, 1}, 0.3, 20);
  scene["meshes"]["panel"] = {{"builtin", "grid"}, {"detail", 8}};
  for (int i = 0; i < 7; ++i) {
    const double distance = 2.5 * std::pow(1.62, i);
    const double size = 0.16 * distance;
    for (const int side : {-1, 1})
      add_draw(scene, "panel", side < 0 ? "near" : "far",
               {{{"translate",
                  {(i % 3 - 1) * 0.42 * distance, 0.02 * distance + 0.28 * (i % 2) * distance,
                   4 - 1.6 * distance}}},
                {{"rotate", {side * 2.0, 0, 1, 0}}},
                {{"scale", {size, size, size}}}});
  }
  add_room(scene, 16, -0.75, -75, 160);
  return text("depth", "crossing panels from near to far, near plane 0.1, far plane 2000", scene);
}

SceneText bunny() {
  Json scene = empty_scene(camera({1.2, 0.9, 3.4}, {0, 0, 0}, 36));
  scene["lights"] = {point_light(1.5, 3, 3, {1, 0.98, 0.94, 1}, {1, 0, 0.01})};
  scene["materials"]["clay"] = material({0.6, 0.42, 0.3, 1}, 0.35, 25);
  scene["meshes"]["bunny"] = {{"file", kBunny}};
  add_draw(scene, "bunny", "clay", Json::array());
  add_room(scene, 12, -1, -2.5, 10);
  SceneText result = text("bunny", "the Stanford bunny, 69,666 triangles", scene);
  result.settings = SettingChoice::steps;
  return result;
}

}  // namespace

std::string wall_name(int quads) { return "wall-" + std::to_string(quads); }

std::vector<SceneText> scene_list() {
  std::vector<SceneText> scenes;
  for (const int quads : kWallQuads) scenes.push_back(wall(quads));
  scenes.push_back(teapots("teapots-near", "three teapots of 4,096 triangles each, close",
                           camera({0, 1.2, 6.2}, {0, 0, 0}, 38), 8, 3, 1));
  scenes.back().in_quick_run = true;
  scenes.push_back(teapots("teapots-far", "35 teapots of 1,024 triangles each, far away",
                           camera({0, 4.5, 10}, {0, -1, -3.5}, 42), 4, 7, 5));
  for (const int count : {1, 8, 64}) scenes.push_back(lights(count));
  scenes.push_back(spots());
  scenes.push_back(single_teapot("matt", "a teapot without highlights", 0, 0));
  scenes.push_back(single_teapot("glossy", "a teapot with a narrow highlight, shininess 120", 1, 120));
  scenes.push_back(textured_floor());
  scenes.back().in_quick_run = true;
  scenes.push_back(steep_depth());
  if (std::filesystem::exists(kBunny)) scenes.push_back(bunny());
  return scenes;
}

}  // namespace tessera::accuracy
