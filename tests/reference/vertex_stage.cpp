#include "vertex_stage.h"

#include "generated_normals.h"

namespace tessera::reference {
namespace {

// The inverse transpose of the upper left 3x3 part; for a singular matrix its cofactors, which have the right direction.
Mat4 normal_matrix(const Mat4& m) {
  const auto column = [&](std::size_t c) { return Vec3{m.rows[0][c], m.rows[1][c], m.rows[2][c]}; };
  const Vec3 a = column(0), b = column(1), c = column(2);
  const double determinant = dot(a, cross(b, c));
  const double scale = determinant != 0 ? 1 / determinant : 1;
  const std::array<Vec3, 3> columns{scale * cross(b, c), scale * cross(c, a), scale * cross(a, b)};
  Mat4 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.rows[0][i] = columns[i].x;
    result.rows[1][i] = columns[i].y;
    result.rows[2][i] = columns[i].z;
  }
  return result;
}

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

}  // namespace

VertexStage::VertexStage(const Mesh& mesh, const Draw& draw, const Camera& camera)
    : mesh_(mesh),
      draw_(draw),
      eye_from_object_(multiply(camera.view_from_world, draw.world_from_object)),
      clip_from_eye_(camera.clip_from_view),
      normal_matrix_(normal_matrix(eye_from_object_)) {
  if (mesh.normals.empty() && draw.lighting && draw.shading != Shading::kFlat) mean_normals_ = mean_face_normals(mesh);
}

Vec3 VertexStage::object_normal(std::size_t triangle, std::uint32_t vertex) const {
  if (!mesh_.normals.empty()) return mesh_.normals[vertex];
  return draw_.shading == Shading::kFlat ? face_normal(mesh_, triangle) : mean_normals_[vertex];
}

Triangle VertexStage::triangle(std::size_t index) const {
  Triangle corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = mesh_.indices[3 * index + i];
    const Vec4 eye = transform(eye_from_object_, mesh_.positions[vertex]);
    corners[i].position_clip = transform(clip_from_eye_, eye);
    corners[i].position_eye = {eye.x / eye.w, eye.y / eye.w, eye.z / eye.w};
    if (draw_.lighting) {
      const Vec3 normal = transform_direction(normal_matrix_, object_normal(index, vertex));
      corners[i].normal_eye = draw_.normalize ? normalize(normal) : normal;
    }
    if (!mesh_.colors.empty()) corners[i].color = mesh_.colors[vertex];
  }
  return corners;
}

TriangleShader::TriangleShader(const Triangle& triangle, bool is_back, bool has_colors, const Draw& draw, const LightModel& model,
                               const std::vector<EyeLight>& lights)
    : triangle_(triangle),
      lights_back_(is_back && model.two_sided),
      has_colors_(has_colors),
      draw_(draw),
      model_(model),
      lights_(lights) {
  if (draw.shading == Shading::kFlat)
    corner_colors_.fill(corner_color(triangle[draw.provoking_vertex == ProvokingVertex::kFirst ? 0 : 2]));
  else
    for (std::size_t i = 0; i < 3; ++i) corner_colors_[i] = corner_color(triangle[i]);
}

Vec4 TriangleShader::color(Vec3 share) const {
  const auto& [a, b, c] = triangle_;
  if (draw_.shading == Shading::kFlat) return corner_colors_[0];
  if (draw_.shading == Shading::kGouraud || !draw_.lighting)
    return mix(share, corner_colors_[0], corner_colors_[1], corner_colors_[2]);
  const Vec3 normal = normalize(mix(share, a.normal_eye, b.normal_eye, c.normal_eye));
  return point_color(mix(share, a.position_eye, b.position_eye, c.position_eye), normal, mix(share, a.color, b.color, c.color));
}

Vec4 TriangleShader::corner_color(const Corner& corner) const {
  if (!draw_.lighting) return clamp01(has_colors_ ? corner.color : draw_.material.diffuse);
  return point_color(corner.position_eye, corner.normal_eye, corner.color);
}

Vec4 TriangleShader::point_color(Vec3 position, Vec3 normal, Vec4 vertex_color) const {
  const Material& material = lights_back_ ? draw_.back_material : draw_.material;
  const Material used = has_colors_ ? with_vertex_color(material, draw_.color_material, vertex_color) : material;
  return lit_color({position, lights_back_ ? -normal : normal, used}, model_, lights_);
}

}  // namespace tessera::reference
