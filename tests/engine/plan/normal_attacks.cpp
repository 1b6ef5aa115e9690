// Attacks on the conditions about normals and faces: null normals, normals that pass through zero, generated
// normals, back faces, viewers.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tests/engine/plan/attack_scene.h"

namespace tessera::test {
namespace {

struct NormalKind {
  const char* name;
  std::function<void(MeshData&)> change;
};

/// Sets the normal of each vertex from its number.
template <class Normal>
std::function<void(MeshData&)> each(const Normal& normal) {
  return [normal](MeshData& mesh) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      const std::array<float, 3> n = normal(i);
      std::copy(n.begin(), n.end(), mesh.normals.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  };
}

const NormalKind kNormalKinds[] = {
    {"one null normal", [](MeshData& mesh) { std::fill_n(mesh.normals.begin() + 30, 3, 0.0f); }},
    {"null normals", each([](std::size_t) {
       return std::array{0.0f, 0.0f, 0.0f};
     })},
    {"normals through zero", each([](std::size_t i) {
       return std::array{0.0f, 0.1f, i % 2 == 0 ? 1.0f : -1.0f};
     })},
    {"one normal towards the light", [](MeshData& mesh) { mesh.normals[3 * 57 + 2] = -1; }},
    {"tiny normals", each([](std::size_t i) {
       return std::array{0.0f, i % 3 == 0 ? 0x1p-130f : 0.0f, 0x1p-128f};
     })},
    {"huge normals", each([](std::size_t i) {
       return std::array{0.0f, i % 3 == 0 ? 0x1p90f : 0.0f, 0x1p92f};
     })},
    {"generated normals", [](MeshData& mesh) { mesh.normals.clear(); }},
};

void add_kinds_of_normals(AttackScenes& scenes) {
  for (const NormalKind& kind : kNormalKinds)
    for (const float z : {1.0f, -1.0f})
      for (const bool normalize : {true, false})
        for (const Shading shading : kShadings) {
          MeshData mesh = bent_grid();
          kind.change(mesh);
          AttackScene scene = lit_scene(std::string(kind.name) + (z < 0 ? ", light behind" : "") +
                                            (normalize ? "" : ", not normalized"),
                                        shading, std::move(mesh), glaring_light(0.1f, 0.2f, z, 0));
          scene.states[0].normalize = normalize;
          scene.not_claimed = EffectReason::light_behind;
          scenes.push_back(scene);
        }
}

// The grid is turned around: its back is visible, and lit with reversed normals.
void add_back_faces(AttackScenes& scenes) {
  for (const bool two_sided : {true, false})
    for (const float z : {1.0f, -1.0f})
      for (const Cull cull : {Cull::none, Cull::back, Cull::front})
        for (const FrontFace front : {FrontFace::ccw, FrontFace::cw}) {
          const Shading shading = kShadings[scenes.size() % 3];
          AttackScene scene = lit_scene(std::string("back faces") + (two_sided ? ", two-sided" : "") +
                                            (z < 0 ? ", light behind" : "") +
                                            (front == FrontFace::cw ? ", clockwise fronts" : "") + ", cull " +
                                            std::to_string(static_cast<int>(cull)),
                                        shading, bent_grid(), glaring_light(0.3f, 0, z, 0));
          scene.meshes.push_back(scene.meshes[0]);
          scene.states.push_back(scene.states[0]);
          scene.states[1].transform = translate(0.3, 0.2, 0.3) * rotate(170, 0, 1, 0);
          for (DrawState& state : scene.states) {
            state.cull = cull;
            state.front_face = front;
            state.back_material = Material{.diffuse = {0.2f, 0.9f, 0.3f, 1}, .specular = {0.5f, 0, 0, 1}};
          }
          scene.model.two_sided = two_sided;
          scenes.push_back(scene);
        }
}

// One normal: the highlight still varies under a local viewer.
void add_equal_normals(AttackScenes& scenes) {
  for (const bool local_viewer : {false, true})
    for (const SpecularModel specular : {SpecularModel::blinn, SpecularModel::phong})
      for (const Shading shading : kShadings) {
        AttackScene scene = lit_scene(std::string("equal normals") + (local_viewer ? ", local viewer" : "") +
                                          (specular == SpecularModel::phong ? ", Phong" : ""),
                                      shading, bent_grid(0), Light{.position = {0.3f, 0.2f, 1, 0}});
        scene.states[0].material.specular = {0.6f, 0.7f, 0.8f, 1};
        scene.states[0].material.shininess = 30;
        scene.states[0].material.diffuse = {0.3f, 0.2f, 0.2f, 1};
        scene.model.local_viewer = local_viewer;
        scene.model.specular = specular;
        (local_viewer ? scene.not_claimed : scene.claimed) = EffectReason::equal_normals;
        scenes.push_back(scene);
        scene.name += ", one differs by an ulp";
        scene.meshes[0].normals[3 * 20 + 2] = std::nextafter(1.0f, 2.0f);
        scene.not_claimed = EffectReason::equal_normals;
        scene.claimed.reset();
        scenes.push_back(scene);
      }
}

}  // namespace

AttackScenes normal_attacks() {
  AttackScenes scenes;
  add_kinds_of_normals(scenes);
  add_back_faces(scenes);
  add_equal_normals(scenes);
  return scenes;
}

}  // namespace tessera::test
