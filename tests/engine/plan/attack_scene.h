// Scenes that attack the conditions under which effects are left out: each comes as close as it can to the
// border of one condition, from either side, and makes a mistake visible.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

struct AttackScene {
  std::string name;                                     ///< the attacked condition and the parameters
  FrameBufferFormat format{.width = 72, .height = 70};  ///< cuts tiles of every size
  std::vector<MeshData> meshes;                         ///< drawn in this order
  std::vector<DrawState> states;                        ///< per mesh, or one for all
  std::vector<Light> lights{Light{}};
  LightModel model{};
  std::shared_ptr<const Texture> texture;
  Camera camera{.view = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), .projection = perspective(40, 1, 0.5, 20)};
  /// Reasons that the engine must or must not give for the first draw.
  std::optional<EffectReason> claimed{}, not_claimed{};

  void record(Frame& frame) const;
  bool claims(EffectReason reason) const;
};

using AttackScenes = std::vector<AttackScene>;

// Families, per condition.
AttackScenes light_behind_attacks();
AttackScenes light_cone_attacks();
AttackScenes light_strength_attacks();
AttackScenes normal_attacks();
AttackScenes vertex_attacks();
AttackScenes alpha_attacks();
AttackScenes blend_attacks();
AttackScenes color_attacks();
AttackScenes depth_attacks();
AttackScenes buffer_attacks();

/// Grid of quads over -0.8..0.8 in x and y at z = 0, with normals bent by up to `bend` in x and y.
MeshData bent_grid(float bend = 0.2f, int side = 9);
/// The same colour at all vertices, or colours between 0 and 1 if `color` is absent.
void set_colors(MeshData& mesh, std::optional<Color> color, float alpha);

/// White, without ambient part. Its light on a white material is 1e7 times as bright as visible light, so
/// that a product of 1e-7 changes the picture.
Light glaring_light(float x, float y, float z, float w);
Material white_material(float alpha = 1);

const char* name_of(Shading shading);
/// A white mesh under one light. The name of the shading is appended to `name`.
AttackScene lit_scene(const std::string& name, Shading shading, MeshData mesh, const Light& light);
inline constexpr Shading kShadings[] = {Shading::flat, Shading::gouraud, Shading::phong};

}  // namespace tessera::test
