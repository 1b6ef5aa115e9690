#include "engine/program/scene/ramp_colors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>

#include "engine/program/imageio/picture.h"

namespace tessera::program {
namespace {

constexpr int kFactorColors = 8;    // vertices and textures: each colour has a ramp
constexpr int kPictureColors = 32;  // images and unlit draws

using Colors = std::vector<Color>;

Colors few_colors(std::span<const std::uint8_t> rgba, int count) {
  return rgba.empty() ? Colors{} : adaptive_palette(rgba, {.count = count});
}

Colors vertex_colors(const MeshData& mesh, int count) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(mesh.colors.size());
  for (const float c : mesh.colors)
    bytes.push_back(static_cast<std::uint8_t>(std::clamp(c, 0.0f, 1.0f) * 255 + 0.5f));
  return few_colors(bytes, count);
}

/// Colours of a texture, drawn over a small frame buffer.
Colors texture_colors(const Texture& texture, Renderer& renderer, int count) {
  constexpr int kSize = 64;
  FrameBuffer buffer({.width = kSize, .height = kSize, .depth = DepthFormat::none, .stencil_bits = 0});
  Frame frame(buffer, renderer);
  const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  const float texcoords[] = {0, 0, 1, 0, 1, 1, 0, 1};
  DrawState state;
  state.lighting = false;
  state.texture = &texture;
  state.texture_env = TextureEnv::replace;
  frame.clear({.color = Color{0, 0, 0, 1}});
  frame.draw({.primitive = Primitive::quads, .positions = positions, .texcoords = texcoords}, state);
  Picture picture(kSize, kSize);
  renderer.finish(frame, picture.target());
  return few_colors(picture.rgba, count);
}

Color product(const Color& x, const Color& y) { return {x.r * y.r, x.g * y.g, x.b * y.b, x.a}; }

/// A material whose light is filtered by a texel.
Material filtered(Material material, const Color& texel) {
  for (Color* color : {&material.ambient, &material.diffuse, &material.specular, &material.emission})
    *color = product(*color, texel);
  return material;
}

Material with_vertex_color(Material material, ColorMaterial mode, const Color& color) {
  switch (mode) {
    case ColorMaterial::none: break;
    case ColorMaterial::ambient_and_diffuse: material.ambient = material.diffuse = color; break;
    case ColorMaterial::diffuse: material.diffuse = color; break;
    case ColorMaterial::ambient: material.ambient = color; break;
    case ColorMaterial::emission: material.emission = color; break;
    case ColorMaterial::specular: material.specular = color; break;
  }
  return material;
}

class Gatherer {
 public:
  Gatherer(const Scene& scene, Renderer& renderer, RampColors& ramps)
      : scene_(scene), renderer_(renderer), ramps_(ramps) {
    start_group(scene.lights);
  }

  void operator()(const LightList& lights) { start_group(lights); }
  void operator()(const Clear& clear) {
    if (clear.color) ramps_.colors.push_back(*clear.color);
  }
  void operator()(const BitmapCommand& bitmap) { ramps_.colors.push_back(bitmap.bitmap.color); }
  void operator()(const ImageCommand& image) { append(few_colors(image.picture->rgba, kPictureColors)); }
  void operator()(const DrawCommand& draw) {
    const DrawState& state = draw.state;
    if (state.shadow_on) ramps_.colors.push_back(state.shadow_on->color);
    else if (state.lighting) add_lit(draw);
    else add_unlit(draw);
  }
  template <class Other>
  void operator()(const Other&) {}

 private:
  void start_group(const LightList& lights) { ramps_.groups.push_back({{}, lights, scene_.light_model}); }
  void append(const Colors& colors) {
    ramps_.colors.insert(ramps_.colors.end(), colors.begin(), colors.end());
  }
  /// The factors of a draw's colours: white, or the texels that modulate them. Texels that replace colours
  /// are added as they are.
  Colors texel_factors(const DrawState& state) {
    if (!state.texture) return {{1, 1, 1, 1}};
    Colors texels = texture_colors(*state.texture, renderer_, kFactorColors);
    if (state.texture_env == TextureEnv::modulate) return texels;
    append(texels);
    return {{1, 1, 1, 1}};
  }
  void add_lit(const DrawCommand& draw) {
    const MeshData& mesh = scene_.meshes[draw.mesh];
    std::vector<Material> materials{draw.state.material};
    if (draw.state.back_material && scene_.light_model.two_sided)
      materials.push_back(*draw.state.back_material);
    if (draw.state.color_material != ColorMaterial::none && !mesh.colors.empty()) {
      const std::vector<Material> plain = std::move(materials);
      materials.clear();
      for (const Material& material : plain)
        for (const Color& color : vertex_colors(mesh, kFactorColors))
          materials.push_back(with_vertex_color(material, draw.state.color_material, color));
    }
    for (const Color& texel : texel_factors(draw.state))
      for (const Material& material : materials)
        ramps_.groups.back().materials.push_back(filtered(material, texel));
  }
  void add_unlit(const DrawCommand& draw) {
    const MeshData& mesh = scene_.meshes[draw.mesh];
    const Colors colors =
        mesh.colors.empty() ? Colors{draw.state.material.diffuse} : vertex_colors(mesh, kPictureColors);
    for (const Color& texel : texel_factors(draw.state))
      for (const Color& color : colors) ramps_.colors.push_back(product(color, texel));
  }

  const Scene& scene_;
  Renderer& renderer_;
  RampColors& ramps_;
};

}  // namespace

void add_ramp_colors(const Scene& scene, Renderer& renderer, RampColors& ramps) {
  Gatherer gatherer(scene, renderer, ramps);
  for (const SceneCommand& command : scene.frame) std::visit(gatherer, command.value);
}

}  // namespace tessera::program
