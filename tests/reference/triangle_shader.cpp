#include "triangle_shader.h"

#include "pixel_format.h"

namespace tessera::reference {
namespace {

template <class T>
T mix(Vec3 share, T a, T b, T c) {
  return share.x * a + share.y * b + share.z * c;
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

// Each side of a lit draw by its own material.
bool draws_indices(const DrawColors& colors, const Material& material) {
  if (colors.format.color_mode != ColorMode::kIndex) return false;
  return colors.draw.lighting ? material.color_indexes.has_value() : colors.mesh_has_indices;
}

bool is_lit_at_pixels(const Draw& draw) { return draw.lighting && draw.shading == Shading::kPhong; }

}  // namespace

TriangleShader::TriangleShader(const Triangle& triangle, bool is_back, const DrawColors& colors)
    : triangle_(triangle),
      colors_(colors),
      lights_back_(is_back && colors.model.two_sided),
      material_(lights_back_ ? colors.draw.back_material : colors.draw.material),
      has_index_(draws_indices(colors, material_)) {
  const Draw& draw = colors.draw;
  if (is_lit_at_pixels(draw)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t provoking = draw.provoking_vertex == ProvokingVertex::kFirst ? 0 : 2;
    const Corner& corner = triangle[draw.shading == Shading::kFlat ? provoking : i];
    const Point point{corner.position_eye, corner.normal_eye, corner.color, corner.index};
    if (has_index_) corner_indices_[i] = index(point);
    else corner_colors_[i] = color(point);
  }
}

Shade TriangleShader::shade(Vec3 share) const {
  const auto& [a, b, c] = triangle_;
  if (is_lit_at_pixels(colors_.draw)) {
    const Point point{mix(share, a.position_eye, b.position_eye, c.position_eye),
                      normalize(mix(share, a.normal_eye, b.normal_eye, c.normal_eye)), mix(share, a.color, b.color, c.color)};
    if (has_index_) return {{}, index(point)};
    return {clamp01(color(point)), {}};
  }
  const bool flat = colors_.draw.shading == Shading::kFlat;
  if (has_index_) return {{}, flat ? corner_indices_[0] : mix(share, corner_indices_[0], corner_indices_[1], corner_indices_[2])};
  return {clamp01(flat ? corner_colors_[0] : mix(share, corner_colors_[0], corner_colors_[1], corner_colors_[2])), {}};
}

Vec4 TriangleShader::color(const Point& point) const {
  if (!colors_.draw.lighting) return clamp01(colors_.mesh_has_colors ? point.vertex_color : colors_.draw.material.diffuse);
  const Material used = colors_.mesh_has_colors ? with_vertex_color(material_, colors_.draw.color_material, point.vertex_color) : material_;
  return lit_color({point.position, lights_back_ ? -point.normal : point.normal, used}, colors_.model, colors_.lights);
}

// Masked right after lighting, or in its place.
double TriangleShader::index(const Point& point) const {
  const Vec3 normal = lights_back_ ? -point.normal : point.normal;
  const double index = colors_.draw.lighting
                           ? lit_index({point.position, normal, material_}, *material_.color_indexes, colors_.model, colors_.lights)
                           : point.vertex_index;
  return masked_index(index, colors_.format.color_bits);
}

}  // namespace tessera::reference
