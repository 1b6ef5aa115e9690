#include "tests/engine/plan/attack_scene.h"

#include <algorithm>

namespace tessera::test {

void AttackScene::record(Frame& frame) const {
  const bool has_rgb = format.color_mode == ColorMode::rgb;
  Clear clear{.depth = 1.0, .stencil = 1};
  if (has_rgb) clear.color = Color{0.25f, 0.45f, 0.65f, 0.5f};
  else clear.index = 1;
  frame.clear(clear);
  frame.set_camera(camera);
  frame.set_lights(lights);
  frame.set_light_model(model);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    DrawState state = states[std::min(i, states.size() - 1)];
    state.texture = texture.get();
    frame.draw(meshes[i].view(), state);
  }
}

bool AttackScene::claims(EffectReason reason) const {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  const std::vector<EffectNote> notes = frame.effects(0);
  return std::any_of(notes.begin(), notes.end(),
                     [&](const EffectNote& note) { return note.reason == reason; });
}

MeshData bent_grid(float bend, int side) {
  MeshData mesh;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      const float u = 2.0f * static_cast<float>(x) / static_cast<float>(side) - 1;
      const float v = 2.0f * static_cast<float>(y) / static_cast<float>(side) - 1;
      mesh.positions.insert(mesh.positions.end(), {0.8f * u, 0.8f * v, 0});
      mesh.normals.insert(mesh.normals.end(), {bend * u, bend * v, 1});
      mesh.texcoords.insert(mesh.texcoords.end(), {u, v});
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (side + 1) + x);
      const auto b = a + static_cast<std::uint32_t>(side) + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return mesh;
}

void set_colors(MeshData& mesh, std::optional<Color> color, float alpha) {
  Random random(7);
  mesh.colors.clear();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Color c =
        color.value_or(Color{random.between(0, 1), random.between(0, 1), random.between(0, 1), 1});
    mesh.colors.insert(mesh.colors.end(), {c.r, c.g, c.b, alpha});
  }
}

Light glaring_light(float x, float y, float z, float w) {
  Light light;
  light.position = {x, y, z, w};
  light.diffuse = {1e7f, 0.7e7f, 0.4e7f, 1};
  return light;
}

Material white_material(float alpha) {
  Material material;
  material.ambient = {0.3f, 0.2f, 0.1f, 1};
  material.diffuse = {1, 1, 1, alpha};
  return material;
}

AttackScene lit_scene(const std::string& name, Shading shading, MeshData mesh, const Light& light) {
  AttackScene scene{.name = name + ", " + name_of(shading)};
  scene.meshes = {std::move(mesh)};
  scene.states = {DrawState{}};
  scene.states[0].material = white_material();
  scene.states[0].shading = shading;
  scene.lights = {light};
  return scene;
}

const char* name_of(Shading shading) {
  switch (shading) {
    case Shading::flat: return "flat";
    case Shading::gouraud: return "gouraud";
    case Shading::phong: return "phong";
  }
  return "";
}

}  // namespace tessera::test
