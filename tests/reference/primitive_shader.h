// Colours or palette indices at the points of one point, line or polygon.
#pragma once

#include <vector>

#include "lighting.h"
#include "scene.h"
#include "shade.h"
#include "vertex_stage.h"
#include "window.h"

namespace tessera::reference {

/// Colour inputs of a draw.
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
  /// The arguments must outlive the shader.
  PrimitiveShader(const Corners& corners, bool is_back, const DrawColors& colors);

  /// The weights may lie outside 0..1 at an uncovered pixel centre; colours interpolated beyond 0..1 are
  /// clamped.
  Shade shade(const Fragment& fragment) const;

 private:
  /// A point of the primitive: a corner, or a pixel under Phong shading.
  struct SurfacePoint {
    Vec3 position;
    Vec3 normal;
    Vec4 vertex_color;
    double vertex_index = 0;
  };

  Vec4 color(const SurfacePoint& point) const;
  double index(const SurfacePoint& point) const;
  Vec4 textured(Vec4 color, const Fragment& fragment) const;
  Shade unstaged(const Fragment& fragment) const;

  const Corners& corners_;
  const DrawColors& colors_;
  bool lights_back_;
  Material material_;  // material of the visible side
  bool has_index_;
  // One per corner, or one for the provoking vertex under flat shading; unused for lit Phong shading.
  std::vector<Vec4> corner_colors_;
  std::vector<double> corner_indices_;  // for index buffers
};

}  // namespace tessera::reference
