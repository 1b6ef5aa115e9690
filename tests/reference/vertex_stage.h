// The corners of a draw's primitives in eye and clip space.
#pragma once

#include <vector>

#include "primitives.h"
#include "scene.h"
#include "texture_sampler.h"

namespace tessera::reference {

struct Corner {
  Vec4 position_clip;
  Vec3 position_eye;
  Vec3 position_world;  ///< for stages
  Vec3 normal_eye;      ///< normalized if the draw says so; null if unlit
  Vec4 color;           ///< the vertex colour; unused if the mesh has none
  TexCoord texcoord;
  double index = 0;  ///< the palette index; unused if the mesh has none
};

/// Corners of one point, line or polygon, in the order of Primitive::vertices.
struct Corners {
  std::vector<Corner> all;
  std::size_t provoking = 0;
};

/// Iterates over the primitives of a mesh under one draw and one camera.
class VertexStage {
 public:
  VertexStage(const Mesh& mesh, const Draw& draw, const Camera& camera);

  std::size_t primitive_count() const { return reference::primitive_count(mesh_); }
  Corners corners(std::size_t primitive) const;

 private:
  Vec3 object_normal(std::size_t primitive, std::uint32_t vertex) const;

  const Mesh& mesh_;
  const Draw& draw_;
  Mat4 eye_from_object_;
  Mat4 clip_from_eye_;
  Mat4 normal_matrix_;
  std::vector<Vec3> mean_normals_;
};

}  // namespace tessera::reference
