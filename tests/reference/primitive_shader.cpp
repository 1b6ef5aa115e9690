#include "primitive_shader.h"

#include <algorithm>

#include "named_stages.h"
#include "pixel_format.h"
#include "texture_env.h"

namespace tessera::reference {
namespace {

/// Weighted sum of `of(corner)` over the corners.
template <class Of>
auto mix(const CornerWeights& weights, const Of& of) {
  auto sum = weights[0] * of(0);
  for (std::size_t i = 1; i < weights.size(); ++i) sum = sum + weights[i] * of(i);
  return sum;
}

double lower(double a, double b) { return std::min(a, b); }
double higher(double a, double b) { return std::max(a, b); }
TexCoord lower(TexCoord a, TexCoord b) { return {std::min(a.s, b.s), std::min(a.t, b.t)}; }
TexCoord higher(TexCoord a, TexCoord b) { return {std::max(a.s, b.s), std::max(a.t, b.t)}; }
Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 higher(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
Vec4 lower(Vec4 a, Vec4 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}
Vec4 higher(Vec4 a, Vec4 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}

/// Weighted sum of `of(corner)`, for polygons clamped to the range of the corners: a pixel's centre may lie
/// outside if only samples are covered.
template <class Of>
auto mix_within(const CornerWeights& weights, const Of& of) {
  const auto mixed = mix(weights, of);
  if (weights.size() < 3) return mixed;
  auto low = of(0), high = of(0);
  for (std::size_t i = 1; i < weights.size(); ++i) low = lower(low, of(i)), high = higher(high, of(i));
  return lower(higher(mixed, low), high);
}

Material with_vertex_color(Material material, ColorMaterial mode, Vec4 color) {
  switch (mode) {
    case ColorMaterial::kNone: break;
    case ColorMaterial::kAmbientAndDiffuse: material.ambient = material.diffuse = color; break;
    case ColorMaterial::kDiffuse: material.diffuse = color; break;
    case ColorMaterial::kAmbient: material.ambient = color; break;
    case ColorMaterial::kEmission: material.emission = color; break;
    case ColorMaterial::kSpecular: material.specular = color; break;
  }
  return material;
}

// Each side of a lit draw depends on its own material.
bool draws_indices(const DrawColors& colors, const Material& material) {
  if (colors.format.color_mode != ColorMode::kIndex) return false;
  return colors.draw.lighting ? material.color_indexes.has_value() : colors.mesh_has_indices;
}

bool is_lit_at_pixels(const Draw& draw) { return draw.lighting && draw.shading == Shading::kPhong; }

}  // namespace

PrimitiveShader::PrimitiveShader(const Corners& corners, bool is_back, const DrawColors& colors)
    : corners_(corners),
      colors_(colors),
      lights_back_(is_back && colors.model.two_sided),
      material_(lights_back_ ? colors.draw.back_material : colors.draw.material),
      has_index_(draws_indices(colors, material_)) {
  if (is_lit_at_pixels(colors.draw)) return;
  const auto evaluate = [&](const Corner& corner) {
    const SurfacePoint point{corner.position_eye, corner.normal_eye, corner.color, corner.index};
    if (has_index_) corner_indices_.push_back(index(point));
    else corner_colors_.push_back(color(point));
  };
  if (colors.draw.shading == Shading::kFlat) evaluate(corners.all[corners.provoking]);
  else
    for (const Corner& corner : corners.all) evaluate(corner);
}

Shade PrimitiveShader::shade(const Fragment& fragment) const {
  const Shade shade = unstaged(fragment);
  if (colors_.draw.stages.empty() || shade.index) return shade;
  const Vec3 world =
      mix_within(fragment.weights, [&](std::size_t i) { return corners_.all[i].position_world; });
  return staged_color(colors_.draw, colors_.format, fragment, world, shade);
}

Shade PrimitiveShader::unstaged(const Fragment& fragment) const {
  const CornerWeights& weights = fragment.weights;
  if (is_lit_at_pixels(colors_.draw)) {
    const auto mixed = [&](auto member) {
      return mix_within(weights, [&](std::size_t i) { return corners_.all[i].*member; });
    };
    const SurfacePoint point{mixed(&Corner::position_eye), normalize(mixed(&Corner::normal_eye)),
                             mixed(&Corner::color)};
    if (has_index_) return {{}, index(point)};
    return {textured(clamp01(color(point)), fragment), {}};
  }
  const auto interpolated = [&](const auto& values) {
    return values.size() == 1 ? values[0] : mix_within(weights, [&](std::size_t i) { return values[i]; });
  };
  if (has_index_) return {{}, interpolated(corner_indices_)};
  return {textured(clamp01(interpolated(corner_colors_)), fragment), {}};
}

Vec4 PrimitiveShader::textured(Vec4 color, const Fragment& fragment) const {
  if (colors_.texture == nullptr) return color;
  const TextureSampler& texture = *colors_.texture;
  const auto texcoord = [&](std::size_t i) { return corners_.all[i].texcoord; };
  const double level =
      texture.level_of_detail(mix(fragment.weights_dx, texcoord), mix(fragment.weights_dy, texcoord));
  return reference::textured(colors_.draw.texture_env, color,
                             texture.sample(mix_within(fragment.weights, texcoord), level),
                             texture.channels(), colors_.draw.texture_env_color);
}

Vec4 PrimitiveShader::color(const SurfacePoint& point) const {
  if (!colors_.draw.lighting)
    return clamp01(colors_.mesh_has_colors ? point.vertex_color : colors_.draw.material.diffuse);
  const Material used = colors_.mesh_has_colors
                            ? with_vertex_color(material_, colors_.draw.color_material, point.vertex_color)
                            : material_;
  return lit_color({point.position, lights_back_ ? -point.normal : point.normal, used}, colors_.model,
                   colors_.lights);
}

// Masked right after lighting, or for unlit draws right after reading the vertex index.
double PrimitiveShader::index(const SurfacePoint& point) const {
  const Vec3 normal = lights_back_ ? -point.normal : point.normal;
  const double index = colors_.draw.lighting
                           ? lit_index({point.position, normal, material_}, *material_.color_indexes,
                                       colors_.model, colors_.lights)
                           : point.vertex_index;
  return masked_index(index, colors_.format.color_bits);
}

}  // namespace tessera::reference
