#include "engine/plan/view_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "raster/fixed_point.h"
#include "raster/vertex_bounds.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kSampledVertices = 8;
constexpr std::size_t kPlanes = 6;

/// A linear form a x + b y + c z + d in object space. Points where it is negative are invisible.
using Plane = std::array<double, 4>;
using Planes = std::array<Plane, kPlanes>;

/// The planes left w <= x, x <= right w, bottom w <= y, y <= top w of a rectangle, and those of the depth
/// range. Whatever covers a pixel satisfies all of them. The forms are linear: if the vertices of a triangle
/// violate one of them, so do all of its points.
class VisibleVolume {
 public:
  VisibleVolume(const VertexTransform& transform, const PixelRect& rect) : transform_(transform) {
    const auto from_center = [](int pixel, std::int32_t center) {
      return pixel - static_cast<double>(center) / kSubpixelScale;
    };
    left_ = from_center(rect.x0, transform.center_x);
    right_ = from_center(rect.x1, transform.center_x);
    bottom_ = -from_center(rect.y1, transform.center_y);  // the raster's y axis points down
    top_ = -from_center(rect.y0, transform.center_y);
  }

  /// The forms at a point or column of clip space: x, y, z, w.
  std::array<double, kPlanes> forms(double x, double y, double z, double w) const {
    const double x_pixels = x * transform_.half_width, y_pixels = y * transform_.half_height;
    return {x_pixels - left_ * w,
            right_ * w - x_pixels,
            y_pixels - bottom_ * w,
            top_ * w - y_pixels,
            transform_.reversed ? w - z : z + w,
            transform_.reversed ? z : w - z};
  }
  /// Whether a vertex violates a plane.
  bool may_exclude(const float* position) const {
    double clip[4];
    for (int r = 0; r < 4; ++r) {
      const double* const row = transform_.clip_from_object + 4 * r;
      clip[r] = row[0] * position[0] + row[1] * position[1] + row[2] * position[2] + row[3];
    }
    const std::array<double, kPlanes> values = forms(clip[0], clip[1], clip[2], clip[3]);
    return std::any_of(values.begin(), values.end(), [](double value) { return value < 0; });
  }
  /// The forms in object space.
  Planes planes() const {
    const double* const m = transform_.clip_from_object;
    Planes planes;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<double, kPlanes> column = forms(m[k], m[4 + k], m[8 + k], m[12 + k]);
      for (std::size_t p = 0; p < kPlanes; ++p) planes[p][k] = column[p];
    }
    return planes;
  }

 private:
  const VertexTransform& transform_;
  double left_, right_, bottom_, top_;  ///< sides of the rectangle from the viewport's centre, pixels
};

/// Upper bound of the form over a box, with a margin for roundings: 2^-40 of the sum of the terms'
/// magnitudes. The window position of a visible point is off by at most 1/512 pixel; pixels are sampled at
/// least 1/16 pixel inside of the rectangle.
double upper_bound(const Plane& plane, const FloatBox& box) {
  double sum = plane[3];
  double magnitude = std::abs(plane[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    const double at_low = plane[k] * box.low[k], at_high = plane[k] * box.high[k];
    sum += std::max(at_low, at_high);
    magnitude += std::max(std::abs(at_low), std::abs(at_high));
  }
  return sum + std::ldexp(magnitude, -40);
}

}  // namespace

bool is_outside_view(const DrawPlan& plan, const MeshArrays& mesh, InstructionSet isa) {
  if (plan.topology != Topology::triangles || plan.outlines) return false;
  if (mesh.vertices == 0 || mesh.components != 3 || plan.rect.empty()) return false;
  const VisibleVolume volume(plan.transform, plan.rect);
  if (!volume.may_exclude(mesh.positions.at(0))) return false;
  const Planes planes = volume.planes();
  std::array<bool, kPlanes> may_separate;
  may_separate.fill(true);
  const auto keep_separating_planes = [&](const FloatBox& box) {
    bool any = false;
    for (std::size_t p = 0; p < kPlanes; ++p) {
      may_separate[p] = may_separate[p] && upper_bound(planes[p], box) < 0;
      any |= may_separate[p];
    }
    return any;
  };
  for (std::size_t s = 0; s < kSampledVertices; ++s) {
    const float* const p = mesh.positions.at(s * (mesh.vertices - 1) / (kSampledVertices - 1));
    if (!keep_separating_planes({{p[0], p[1], p[2]}, {p[0], p[1], p[2]}})) return false;
  }
  FloatBox box;
  return find_bounds(isa)(mesh.positions, mesh.vertices, box) && keep_separating_planes(box);
}

}  // namespace tessera::detail
