// The colours, or palette indices, of the points of one triangle.
#pragma once

#include <optional>
#include <vector>

#include "lighting.h"
#include "scene.h"
#include "vertex_stage.h"

namespace tessera::reference {

/// What the colours of a draw depend on.
struct DrawColors {
  const Draw& draw;
  const LightModel& model;
  std::vector<EyeLight> lights;
  const FrameBufferFormat& format;
  bool mesh_has_colors = false;
  bool mesh_has_indices = false;
};

/// A shaded fragment.
struct Shade {
  Vec4 color;                   ///< 0..1
  std::optional<double> index;  ///< a palette index, continuous; if there is one it stands instead of the colour
};

class TriangleShader {
 public:
  /// The arguments must outlive this.
  TriangleShader(const Triangle& triangle, bool is_back, const DrawColors& colors);

  /// @param share  of each of the three corners, summing to 1; may lie outside 0..1 at a centre that is not covered: colours
  /// that are interpolated beyond 0..1 are clamped.
  Shade shade(Vec3 share) const;

 private:
  /// A point of the triangle: a corner or a pixel of Phong shading.
  struct Point {
    Vec3 position, normal;
    Vec4 vertex_color;
    double vertex_index = 0;
  };

  Vec4 color(const Point& point) const;
  double index(const Point& point) const;

  const Triangle& triangle_;
  const DrawColors& colors_;
  bool lights_back_;
  Material material_;       // of the side that is seen
  bool has_index_;
  std::array<Vec4, 3> corner_colors_;  // these and the next: all the provoking one's if flat; unused by lit Phong
  std::array<double, 3> corner_indices_{};
};

}  // namespace tessera::reference
