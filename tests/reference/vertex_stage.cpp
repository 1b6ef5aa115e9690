#include "vertex_stage.h"

#include "generated_normals.h"
#include "named_stages.h"

namespace tessera::reference {
namespace {

// Inverse transpose of the upper left 3x3 part. For a singular matrix its cofactors, which have the right
// direction.
Mat4 normal_matrix(const Mat4& m) {
  const auto column = [&](std::size_t c) { return Vec3{m.rows[0][c], m.rows[1][c], m.rows[2][c]}; };
  const Vec3 a = column(0);
  const Vec3 b = column(1);
  const Vec3 c = column(2);
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

}  // namespace

VertexStage::VertexStage(const Mesh& mesh, const Draw& draw, const Camera& camera)
    : mesh_(mesh),
      draw_(draw),
      eye_from_object_(multiply(camera.view_from_world, draw.world_from_object)),
      clip_from_eye_(camera.clip_from_view),
      normal_matrix_(normal_matrix(eye_from_object_)) {
  if (mesh.normals.empty() && draw.lighting && draw.shading != Shading::kFlat)
    mean_normals_ = mean_face_normals(mesh);
}

Vec3 VertexStage::object_normal(std::size_t primitive, std::uint32_t vertex) const {
  if (!mesh_.normals.empty()) return mesh_.normals[vertex];
  return draw_.shading == Shading::kFlat ? face_normal(mesh_, primitive) : mean_normals_[vertex];
}

Corners VertexStage::corners(std::size_t index) const {
  const Primitive primitive = reference::primitive(mesh_, index, draw_.provoking_vertex);
  Corners corners{{}, primitive.provoking};
  for (const std::uint32_t vertex : primitive.vertices) {
    Corner corner;
    const Vec4 eye = transform(eye_from_object_, mesh_.positions[vertex]);
    corner.position_clip = transform(clip_from_eye_, eye);
    corner.position_eye = {eye.x / eye.w, eye.y / eye.w, eye.z / eye.w};
    if (draw_.lighting) {
      const Vec3 normal = transform_direction(normal_matrix_, object_normal(index, vertex));
      corner.normal_eye = draw_.normalize ? normalize(normal) : normal;
    }
    if (!mesh_.colors.empty()) corner.color = mesh_.colors[vertex];
    if (!mesh_.texcoords.empty()) corner.texcoord = {mesh_.texcoords[vertex][0], mesh_.texcoords[vertex][1]};
    if (!mesh_.color_indices.empty()) corner.index = mesh_.color_indices[vertex];
    const Vec4 world = transform(draw_.world_from_object, mesh_.positions[vertex]);
    corner.position_world = {world.x / world.w, world.y / world.w, world.z / world.w};
    run_stages(draw_, mesh_, mesh_.positions[vertex], corner);
    corners.all.push_back(corner);
  }
  return corners;
}

}  // namespace tessera::reference
