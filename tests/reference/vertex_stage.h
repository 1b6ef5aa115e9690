// The corners of a draw in eye and clip space, and the colours of its triangles.
#pragma once

#include <vector>

#include "lighting.h"
#include "scene.h"

namespace tessera::reference {

struct Corner {
  Vec4 position_clip;
  Vec3 position_eye;
  Vec3 normal_eye;  ///< normalized if the draw says so; null if the draw is unlit
  Vec4 color;       ///< the vertex colour as given; unused if the mesh has none
};

using Triangle = std::array<Corner, 3>;

/// The triangles of a mesh under one draw and one camera, one at a time.
class VertexStage {
 public:
  VertexStage(const Mesh& mesh, const Draw& draw, const Camera& camera);

  std::size_t triangle_count() const { return mesh_.indices.size() / 3; }
  Triangle triangle(std::size_t index) const;

 private:
  Vec3 object_normal(std::size_t triangle, std::uint32_t vertex) const;

  const Mesh& mesh_;
  const Draw& draw_;
  Mat4 eye_from_object_;
  Mat4 clip_from_eye_;
  Mat4 normal_matrix_;
  std::vector<Vec3> mean_normals_;
};

/// Colours the points of one triangle.
class TriangleShader {
 public:
  TriangleShader(const Triangle& triangle, bool is_back, bool has_colors, const Draw& draw, const LightModel& model,
                 const std::vector<EyeLight>& lights);

  /// @param share  of each of the three corners, summing to 1.
  Vec4 color(Vec3 share) const;

 private:
  Vec4 corner_color(const Corner& corner) const;
  Vec4 point_color(Vec3 position, Vec3 normal, Vec4 vertex_color) const;

  const Triangle& triangle_;
  bool lights_back_;
  bool has_colors_;
  const Draw& draw_;
  const LightModel& model_;
  const std::vector<EyeLight>& lights_;
  std::array<Vec4, 3> corner_colors_;  // all the provoking one's if flat; unused by lit Phong
};

}  // namespace tessera::reference
