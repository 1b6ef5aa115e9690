#include "engine/record/planar_shadow.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/record/checks.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/worker_pool.h"

namespace tessera {
using namespace detail;
namespace {

std::string list_of(const std::array<double, 4>& v, int count) {
  std::string list;
  for (int i = 0; i < count; ++i)
    list.append(i == 0 ? "" : " ").append(format_number(v[static_cast<std::size_t>(i)]));
  return list;
}

/// For a homogeneous light l and a plane p, M = (p.l) I - l p^T maps a point x to the intersection of the
/// plane with the line from l through x, and w to (p.l) x.w - (p.x) l.w. Between the plane (p.x = 0) and the
/// light (p.x = p.l) that has the sign of p.l. Divided by p.l, w is positive there, as clipping requires, for
/// either direction of the normal, and 1 in the plane.
/// @param owner  named in errors
Matrix shadow_matrix(const char* owner, const std::array<double, 4>& plane, const Light& light) {
  constexpr double kRounding = 0x1p-22;  // relative to the terms of p.l: lights are stored as floats
  require_finite({owner, "'s plane"}, {plane[0], plane[1], plane[2], plane[3]});
  require_finite({owner, "'s light's position"},
                 {light.position[0], light.position[1], light.position[2], light.position[3]});
  const double largest = std::max({std::abs(plane[0]), std::abs(plane[1]), std::abs(plane[2])});
  if (!(largest > 0))
    throw Error(ErrorCode::invalid_argument, std::string(owner) + ": the plane is " + list_of(plane, 4) +
                                                 ", its normal must not be 0 0 0");
  // Scaling by a power of two keeps sums of products within the range of doubles and changes no bit of the
  // result.
  const int exponent = std::ilogb(std::max(largest, std::abs(plane[3])));
  std::array<double, 4> p, l;
  double product = 0;  // p.l
  double terms = 0;    // sum of the absolute values of its terms
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = std::scalbn(plane[i], -exponent);
    l[i] = light.position[i];
    product += p[i] * l[i];
    terms += std::abs(p[i] * l[i]);
  }
  if (!(std::abs(product) > kRounding * terms)) {
    const bool directional = l[3] == 0;
    if (!directional)
      for (std::size_t i = 0; i < 3; ++i) l[i] /= l[3];
    throw Error(ErrorCode::invalid_argument,
                std::string(owner)
                    .append(directional ? ": the light's direction " : ": the light at ")
                    .append(list_of(l, 3))
                    .append(directional ? " is parallel to the plane " : " lies in the plane ")
                    .append(list_of(plane, 4))
                    .append(", it has no shadow there"));
  }
  Matrix m;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      m.m[4 * row + column] -= l[row] * p[column] / product;
      if (!std::isfinite(m.m[4 * row + column]))
        throw Error(ErrorCode::invalid_argument, std::string(owner) + ": the shadow on the plane " +
                                                     list_of(plane, 4) +
                                                     " is too far away to be represented");
    }
  return m;
}

}  // namespace

Matrix planar_shadow(const std::array<double, 4>& plane, const Light& light) {
  const FloatingPointMode mode;
  return shadow_matrix("planar_shadow", plane, light);
}

namespace detail {

void apply_planar_shadow(RecordedDraw& draw) {
  const ShadowOn& shadow = *draw.state.shadow_on;
  const std::vector<Light>& lights = draw.scene_state->lights;
  if (shadow.light >= lights.size())
    throw Error(ErrorCode::invalid_argument,
                "Frame::draw: shadow_on.light is " + std::to_string(shadow.light) + ", the frame has " +
                    std::to_string(lights.size()) + (lights.size() == 1 ? " light" : " lights") +
                    ", counted from 0");
  require_finite({"Frame::draw: shadow_on.color"}, shadow.color);
  draw.state.transform =
      shadow_matrix("Frame::draw: shadow_on", shadow.plane, lights[shadow.light]) * draw.state.transform;
  require_finite({"Frame::draw: shadow_on's matrix times transform"}, draw.state.transform);
  draw.state.lighting = false;
  draw.state.material.diffuse = shadow.color;
  draw.mesh.colors = draw.mesh.color_indices = {};
  draw.mesh.color_bytes = nullptr;
  draw.state.texture = nullptr;
  draw.texture = nullptr;
}

}  // namespace detail

}  // namespace tessera
