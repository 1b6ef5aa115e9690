// Attacks on facts about vertices: equal colours, vertices that are not finite or not used, clipped
// triangles, vertex colours as materials.
#include <array>
#include <cmath>
#include <limits>

#include "tests/engine/plan/attack_scene.h"

namespace tessera::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

AttackScene scene_of_mesh(const std::string& name, Shading shading, MeshData mesh) {
  AttackScene scene{.name = name + ", " + name_of(shading)};
  scene.meshes = {std::move(mesh)};
  scene.states = {DrawState{}};
  scene.states[0].material = white_material();
  scene.states[0].shading = shading;
  return scene;
}

/// Adds a vertex that no triangle uses.
void add_unused_vertex(MeshData& mesh, std::array<float, 3> position, std::array<float, 3> normal) {
  mesh.positions.insert(mesh.positions.end(), position.begin(), position.end());
  mesh.normals.insert(mesh.normals.end(), normal.begin(), normal.end());
  mesh.texcoords.insert(mesh.texcoords.end(), {0, 0});
  if (!mesh.colors.empty()) mesh.colors.insert(mesh.colors.end(), {kNaN, 0.5f, 0.5f, 0.25f});
}

// A light is behind all vertices but one, which no triangle uses.
void add_unused_vertices(AttackScenes& scenes) {
  struct Unused {
    const char* name;
    std::array<float, 3> position, normal;
  };
  const Unused kUnused[] = {{"facing the light", {0, 0, 0}, {0, 0, -1}},
                            {"NaN position", {kNaN, 0, 0}, {0, 0, 1}},
                            {"infinite position", {0, kInfinity, 0}, {0, 0, 1}},
                            {"NaN normal", {0, 0, 0}, {0, kNaN, 1}},
                            {"largest position", {3e38f, -3e38f, 3e38f}, {0, 0, 1}}};
  for (const Unused& unused : kUnused)
    for (const float w : {0.0f, 1.0f})
      for (const Shading shading : kShadings) {
        MeshData mesh = bent_grid();
        add_unused_vertex(mesh, unused.position, unused.normal);
        AttackScene scene = scene_of_mesh(
            std::string("unused vertex: ") + unused.name + (w == 0 ? ", directional light" : ", point light"),
            shading, std::move(mesh));
        scene.lights = {Light{}, glaring_light(0.1f, 0.1f, -2, w)};
        // The proof for a directional light does not depend on positions, if they are finite.
        const bool is_far = unused.position[0] > 1e38f;
        if (w == 0 && is_far) scene.claimed = EffectReason::light_behind;
        else scene.not_claimed = EffectReason::light_behind;
        scenes.push_back(scene);
      }
}

// The same with a vertex that triangles use: they are dropped.
void add_vertices_that_are_not_finite(AttackScenes& scenes) {
  for (const float bad : {kNaN, kInfinity})
    for (const char* const attribute : {"position", "normal", "color"})
      for (const Shading shading : kShadings) {
        MeshData mesh = bent_grid();
        set_colors(mesh, Color{0.4f, 0.4f, 0.4f, 1}, 1);
        if (attribute[0] == 'p') mesh.positions[3 * 44] = bad;
        if (attribute[0] == 'n') mesh.normals[3 * 44] = bad;
        if (attribute[0] == 'c') mesh.colors[4 * 44] = bad;
        AttackScene scene = scene_of_mesh(std::string(attribute) + (std::isnan(bad) ? " NaN" : " infinite"),
                                          shading, std::move(mesh));
        scene.lights = {Light{}, glaring_light(0.1f, 0.1f, -2, 0)};
        scene.states[0].blend = BlendState{};
        scenes.push_back(scene);
        scene.name += ", unlit";
        scene.states[0].lighting = false;
        scenes.push_back(scene);
      }
}

// Triangles reach behind the eye, with w of 1 and with other w. The light reaches only one of their ends.
void add_clipped_triangles(AttackScenes& scenes) {
  for (const float w : {1.0f, -1.0f, 0.25f})
    for (const float light_z : {6.0f, 3.0f, -30.0f})
      for (const Shading shading : kShadings) {
        MeshData mesh;
        mesh.position_components = 4;
        mesh.positions = {-1, -1, -6, 1, 1 * w, -1 * w, 9 * w, w, 1, -1, -6, 1};
        mesh.normals = {0, 1, 0, 0, 1, 0.1f, 0, 1, 0};
        mesh.indices = {0, 1, 2};
        if (w == 1) {  // the same with three components
          mesh.position_components = 3;
          mesh.positions = {-1, -1, -6, 1, -1, 9, 1, -1, -6};
        }
        AttackScene scene = scene_of_mesh(
            "clipped triangle, w " + std::to_string(w) + ", light at z " + std::to_string(light_z), shading,
            std::move(mesh));
        Light light = glaring_light(0, 0, light_z, 1);
        light.spot_direction = {0, -1, 0};
        light.spot_cutoff = 50;
        scene.lights = {Light{.diffuse = {0.3f, 0.3f, 0.3f, 1}, .position = {0, 1, 1, 0}}, light};
        scenes.push_back(scene);
      }
}

}  // namespace

AttackScenes vertex_attacks() {
  AttackScenes scenes;
  add_unused_vertices(scenes);
  add_vertices_that_are_not_finite(scenes);
  add_clipped_triangles(scenes);
  return scenes;
}

// Vertex colours that are equal but for an ulp or a sign, in every kind of colour buffer; as materials of
// lights that are left out.
AttackScenes color_attacks() {
  AttackScenes scenes;
  struct Odd {
    const char* name;
    std::size_t component;
    float value;
  };
  constexpr float kLevel = 127.5f / 255;  // between two levels
  const Odd kOdds[] = {{"none", 0, kLevel},
                       {"red ulp", 0, std::nextafter(kLevel, 1.0f)},
                       {"blue ulp", 2, std::nextafter(kLevel, 0.0f)},
                       {"alpha ulp", 3, 1 - 0x1p-24f},
                       {"NaN", 1, kNaN}};
  for (const Odd& odd : kOdds)
    for (const int bits : {24, 2, 16})
      for (const bool is_index : {false, true})
        for (const std::size_t vertex : {std::size_t{0}, std::size_t{55}}) {
          if (is_index && bits != 16) continue;
          MeshData mesh = bent_grid();
          set_colors(mesh, Color{kLevel, kLevel, kLevel, 1}, 1);
          mesh.colors[4 * vertex + odd.component] = odd.value;
          AttackScene scene = scene_of_mesh("equal colours but " + std::string(odd.name) + " at vertex " +
                                                std::to_string(vertex) + ", " + std::to_string(bits) +
                                                " bits" + (is_index ? " of an index" : ""),
                                            kShadings[scenes.size() % 3], std::move(mesh));
          scene.format.color_bits = is_index ? 8 : bits;
          if (is_index) scene.format.color_mode = ColorMode::index;
          scene.states[0].lighting = false;
          (odd.name[0] == 'n' ? scene.claimed : scene.not_claimed) = EffectReason::equal_colors;
          scenes.push_back(scene);
        }
  for (const float zero : {0.0f, -0.0f}) {
    MeshData mesh = bent_grid();
    set_colors(mesh, Color{0, 0, 0, 1}, 1);
    for (std::size_t i = 4; i < mesh.colors.size(); i += 8) mesh.colors[i] = -zero;
    scenes.push_back(scene_of_mesh("zeros of both signs", Shading::gouraud, std::move(mesh)));
    scenes.back().states[0].lighting = false;
  }
  for (const ColorMaterial mode : {ColorMaterial::ambient_and_diffuse, ColorMaterial::diffuse,
                                   ColorMaterial::ambient, ColorMaterial::emission, ColorMaterial::specular})
    for (const float ambient : {0.0f, 0.2f})
      for (const Shading shading : {Shading::gouraud, Shading::phong}) {
        MeshData mesh = bent_grid();
        set_colors(mesh, std::nullopt, 1);
        AttackScene scene = scene_of_mesh("colour material " + std::to_string(static_cast<int>(mode)) +
                                              (ambient == 0 ? "" : ", ambient light"),
                                          shading, std::move(mesh));
        Light behind = glaring_light(0, 0.2f, -2, 1);
        behind.ambient = {ambient, ambient, 0, 1};
        scene.lights = {Light{}, behind};
        scene.states[0].color_material = mode;
        scene.states[0].blend = BlendState{};
        if (ambient == 0) scene.claimed = EffectReason::light_behind;
        scenes.push_back(scene);
      }
  return scenes;
}

}  // namespace tessera::test
