#include "engine/program/scene/model_draws.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace tessera::program {
namespace {

std::shared_ptr<const Texture> texture_of(const ModelImage& image, const TextureSampler& sampler) {
  return std::make_shared<const Texture>(
      TextureImage{
          .pixels = image.pixels.data(), .width = image.width, .height = image.height, .channels = 4},
      sampler);
}

bool has_alpha(const ModelPart& part, const MeshData& mesh, const Model& model) {
  if (part.texture && model.images[model.textures[*part.texture].image].has_alpha) return true;
  if (!part.uses_colors) return part.material.diffuse.a < 1;
  for (std::size_t i = 3; i < mesh.colors.size(); i += 4)
    if (mesh.colors[i] < 1) return true;
  return false;
}

DrawState state_of(const ModelPart& part, const Scene& scene) {
  DrawState state;
  state.material = part.material;
  state.shading = Shading::phong;
  const bool is_lit = part.primitive == Primitive::triangles && !part.is_unlit;
  state.lighting = is_lit;
  if (is_lit && part.uses_colors) state.color_material = ColorMaterial::ambient_and_diffuse;
  if (!part.is_double_sided) state.cull = Cull::back;
  if (part.texture) state.texture = scene.textures[*part.texture].get();
  if (part.alpha == ModelAlpha::mask)
    state.alpha_test = AlphaTest{.func = Compare::gequal, .ref = std::clamp(part.alpha_cutoff, 0.0f, 1.0f)};
  if (part.alpha == ModelAlpha::blend) {
    // Colours over the background; alpha becomes the covered share.
    state.blend = BlendState{.src_alpha = BlendFactor::one, .dst_alpha = BlendFactor::one_minus_src_alpha};
    state.depth.write = false;
  }
  return state;
}

void append(const std::vector<float>& from, std::vector<float>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Parts without an attribute get a value that changes nothing.
void fill_up(std::vector<float>& values, std::size_t vertices, std::size_t components, float value) {
  values.resize(vertices * components, value);
}

/// Collects parts that blend in one mesh.
class BlendedParts {
 public:
  void add(MeshData&& part, const DrawState& state) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
    if (!part.colors.empty()) fill_up(mesh_.colors, first, 4, 1);
    if (!part.texcoords.empty()) fill_up(mesh_.texcoords, first, 2, 0);
    if (!part.normals.empty()) fill_up(mesh_.normals, first, 3, 0);
    append(part.positions, mesh_.positions);
    const std::size_t vertices = mesh_.vertex_count();
    append(part.colors, mesh_.colors);
    append(part.texcoords, mesh_.texcoords);
    append(part.normals, mesh_.normals);
    if (!mesh_.colors.empty()) fill_up(mesh_.colors, vertices, 4, 1);
    if (!mesh_.texcoords.empty()) fill_up(mesh_.texcoords, vertices, 2, 0);
    if (!mesh_.normals.empty()) fill_up(mesh_.normals, vertices, 3, 0);
    for (const std::uint32_t index : part.indices) triangles_.indices.push_back(first + index);
    triangles_.state_of.insert(triangles_.state_of.end(), part.indices.size() / 3,
                               static_cast<std::uint32_t>(triangles_.states.size()));
    triangles_.states.push_back(state);
  }

  void move_to(Scene& scene) {
    if (triangles_.states.empty()) return;
    triangles_.mesh = scene.meshes.size();
    mesh_.name = "blended triangles";
    scene.meshes.push_back(std::move(mesh_));
    scene.blended = std::move(triangles_);
  }

 private:
  MeshData mesh_;
  BlendedTriangles triangles_;
};

}  // namespace

void add_model_draws(Model model, Scene& scene) {
  for (const ModelTexture& texture : model.textures)
    scene.textures.push_back(texture_of(model.images[texture.image], texture.sampler));
  std::vector<ModelPart> parts = model.parts;
  std::vector<MeshData> meshes = split_into_parts(model);
  BlendedParts blended;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ModelPart& part = parts[i];
    MeshData& mesh = meshes[i];
    mesh.primitive = part.primitive;
    if (part.alpha == ModelAlpha::blend && !has_alpha(part, mesh, model)) part.alpha = ModelAlpha::opaque;
    if (!part.uses_colors) mesh.colors.clear();
    const DrawState state = state_of(part, scene);
    if (part.alpha == ModelAlpha::blend && part.primitive == Primitive::triangles) {
      blended.add(std::move(mesh), state);
      continue;
    }
    scene.frame.push_back({DrawCommand{.mesh = scene.meshes.size(), .state = state}, ""});
    scene.meshes.push_back(std::move(mesh));
  }
  blended.move_to(scene);
}

}  // namespace tessera::program
