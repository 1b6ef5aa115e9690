#include "engine/program/scene/model_draws.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "engine/program/imageio/picture.h"

namespace tessera::program {
namespace {

std::shared_ptr<const Picture> picture_of(ModelImage& image) {
  auto picture = std::make_shared<Picture>(0, 0);
  picture->width = image.width;
  picture->height = image.height;
  picture->rgba = std::move(image.pixels);
  return picture;
}

/// Appends an attribute of a part, or the same value for each of its vertices if the part lacks it.
void append(const std::vector<float>& from, std::size_t vertices, std::initializer_list<float> value,
            std::vector<float>& to) {
  if (!from.empty()) to.insert(to.end(), from.begin(), from.end());
  else
    for (std::size_t i = 0; i < vertices; ++i) to.insert(to.end(), value);
}

/// Collects parts that blend in one mesh. Parts without an attribute get a value that changes nothing.
class BlendedParts {
 public:
  void add(MeshData&& part, DrawCommand draw) {
    has_colors_ = has_colors_ || !part.colors.empty();
    has_texcoords_ = has_texcoords_ || !part.texcoords.empty();
    has_normals_ = has_normals_ || !part.normals.empty();
    parts_.push_back(std::move(part));
    draws_.push_back(std::move(draw));
  }

  void move_to(Scene& scene) {
    if (draws_.empty()) return;
    BlendedTriangles triangles{.mesh = scene.meshes.size()};
    MeshData mesh{.name = "blended triangles"};
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
      append_vertices(parts_[i], draws_[i].state.material.diffuse, mesh);
      for (const std::uint32_t index : parts_[i].indices) triangles.indices.push_back(first + index);
      triangles.draw_of.insert(triangles.draw_of.end(), parts_[i].indices.size() / 3,
                               static_cast<std::uint32_t>(i));
      draws_[i].mesh = triangles.mesh;
    }
    triangles.draws = std::move(draws_);
    scene.meshes.push_back(std::move(mesh));
    scene.blended = std::move(triangles);
  }

 private:
  /// @param unlit  colour of the part's unlit draw without vertex colours
  void append_vertices(const MeshData& part, const Color& unlit, MeshData& mesh) const {
    const std::size_t vertices = part.vertex_count();
    append(part.positions, vertices, {}, mesh.positions);
    if (has_colors_) append(part.colors, vertices, {unlit.r, unlit.g, unlit.b, unlit.a}, mesh.colors);
    if (has_texcoords_) append(part.texcoords, vertices, {0, 0}, mesh.texcoords);
    if (has_normals_) append(part.normals, vertices, {0, 0, 0}, mesh.normals);
  }

  std::vector<MeshData> parts_;
  std::vector<DrawCommand> draws_;
  bool has_colors_ = false, has_texcoords_ = false, has_normals_ = false;
};

}  // namespace

std::vector<std::shared_ptr<const Texture>> make_textures(
    Model& model, std::vector<std::shared_ptr<const Picture>>& pictures) {
  std::vector<std::shared_ptr<const Picture>> images;
  for (ModelImage& image : model.images) images.push_back(picture_of(image));
  std::vector<std::shared_ptr<const Texture>> textures;
  for (const ModelTexture& texture : model.textures) {
    const std::shared_ptr<const Picture>& picture = images[texture.image];
    textures.push_back(std::make_shared<const Texture>(TextureImage{.pixels = picture->rgba.data(),
                                                                    .width = picture->width,
                                                                    .height = picture->height,
                                                                    .channels = 4},
                                                       texture.sampler));
    pictures.push_back(picture);
  }
  return textures;
}

bool has_alpha(const ModelPart& part, const MeshData& mesh, const Model& model) {
  if (part.texture && model.images[model.textures[*part.texture].image].has_alpha) return true;
  if (!part.uses_colors) return part.material.diffuse.a < 1;
  for (std::size_t i = 3; i < mesh.colors.size(); i += 4)
    if (mesh.colors[i] < 1) return true;
  return false;
}

DrawState part_state(const ModelPart& part, const Texture* texture) {
  DrawState state;
  state.material = part.material;
  state.shading = Shading::phong;
  const bool is_lit = part.primitive == Primitive::triangles && !part.is_unlit;
  state.lighting = is_lit;
  if (is_lit && part.uses_colors) state.color_material = ColorMaterial::ambient_and_diffuse;
  if (!part.is_double_sided) state.cull = Cull::back;
  state.texture = texture;
  if (part.alpha == ModelAlpha::mask)
    state.alpha_test = AlphaTest{.func = Compare::gequal, .ref = std::clamp(part.alpha_cutoff, 0.0f, 1.0f)};
  if (part.alpha == ModelAlpha::blend) {
    // Colours over the background; alpha becomes the covered share.
    state.blend = BlendState{.src_alpha = BlendFactor::one, .dst_alpha = BlendFactor::one_minus_src_alpha};
    state.depth.write = false;
  }
  return state;
}

void add_model_draws(Model model, Scene& scene) {
  scene.textures = make_textures(model, scene.texture_pictures);
  std::vector<ModelPart> parts = model.parts;
  std::vector<MeshData> meshes = split_into_parts(model);
  BlendedParts blended;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ModelPart& part = parts[i];
    MeshData& mesh = meshes[i];
    mesh.primitive = part.primitive;
    if (part.alpha == ModelAlpha::blend && !has_alpha(part, mesh, model)) part.alpha = ModelAlpha::opaque;
    if (!part.uses_colors) mesh.colors.clear();
    const Texture* const texture = part.texture ? scene.textures[*part.texture].get() : nullptr;
    DrawCommand draw{
        .mesh = scene.meshes.size(), .state = part_state(part, texture), .material_name = part.material_name};
    if (part.alpha == ModelAlpha::blend && part.primitive == Primitive::triangles) {
      blended.add(std::move(mesh), std::move(draw));
      continue;
    }
    scene.frame.push_back({std::move(draw), ""});
    scene.meshes.push_back(std::move(mesh));
  }
  blended.move_to(scene);
}

}  // namespace tessera::program
