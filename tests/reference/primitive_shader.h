// The colours, or palette indices, of the points of one point, line or polygon.
#pragma once

#include <vector>

#include "lighting.h"
#include "scene.h"
#include "shade.h"
#include "vertex_stage.h"
#include "window.h"

namespace tessera::reference {

/// What the colours of a draw depend on.
struct DrawColors {
  const Draw& draw;
  const LightModel& model;
  std::vector<EyeLight> lights;
  const FrameBufferFormat& format;
  const TextureSampler* texture = nullptr;  ///< null: none
  bool mesh_has_colors = false;
  bool mesh_has_indices = false;
};

class PrimitiveShader {
 public:
  /// The arguments must outlive this.
  PrimitiveShader(const Corners& corners, bool is_back, const DrawColors& colors);

  /// The shares may lie outside 0..1 at a centre that is not covered: colours that are interpolated beyond
  /// 0..1 are clamped.
  Shade shade(const Fragment& fragment) const;

 private:
  /// A point of the primitive: a corner or a pixel of Phong shading.
  struct SurfacePoint {
    Vec3 position, normal;
    Vec4 vertex_color;
    double vertex_index = 0;
  };

  Vec4 color(const SurfacePoint& point) const;
  double index(const SurfacePoint& point) const;
  Vec4 textured(Vec4 color, const Fragment& fragment) const;

  const Corners& corners_;
  const DrawColors& colors_;
  bool lights_back_;
  Material material_;  // of the side that is seen
  bool has_index_;
  // One for each corner, or if flat the provoking one's alone; lit Phong uses none.
  std::vector<Vec4> corner_colors_;
  std::vector<double> corner_indices_;  // instead of colours
};

}  // namespace tessera::reference
