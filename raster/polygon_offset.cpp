#include "raster/polygon_offset.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "raster/clipped_triangles.h"

namespace tessera::detail {
namespace {

double depth_of(DepthFormat kind, std::uint32_t z) {
  if (kind != DepthFormat::float32) return z;
  float depth;
  std::memcpy(&depth, &z, sizeof depth);
  return depth;
}

// max(|dz/dx|, |dz/dy|) per pixel.
double slope_of(DepthFormat kind, const WindowVertex& a, const WindowVertex& b, const WindowVertex& c,
                double twice_area) {
  const double z = depth_of(kind, a.z);
  const double to_b = depth_of(kind, b.z) - z, to_c = depth_of(kind, c.z) - z;
  // Gradient times twice the area, per 1/256 pixel.
  const double slope_x = to_b * (c.y - a.y) - to_c * (b.y - a.y);
  const double slope_y = to_c * (b.x - a.x) - to_b * (c.x - a.x);
  return std::max(std::abs(slope_x), std::abs(slope_y)) * kSubpixelScale / twice_area;
}

std::uint8_t outcodes_of(const BinDraw& draw, std::uint32_t triangle) {
  std::uint8_t outcodes = 0;
  for (std::uint32_t k = 0; draw.any_outcode && k < 3; ++k)
    outcodes |= draw.outcodes[vertex_index<3>(draw, triangle, k)];
  return outcodes;
}

WindowPolygon in_window(const BinDraw& draw, std::uint32_t triangle) {
  const std::uint8_t outcodes = outcodes_of(draw, triangle);
  if (outcodes != 0) return clip_to_window(draw, triangle, outcodes, 0);
  return WindowPolygon(draw.vertices[vertex_index<3>(draw, triangle, 0)],
                       draw.vertices[vertex_index<3>(draw, triangle, 1)],
                       draw.vertices[vertex_index<3>(draw, triangle, 2)]);
}

// Slope of a triangle; of its largest part if it is clipped.
double slope_of(DepthFormat kind, const WindowPolygon& triangle) {
  double slope = 0, largest = 0;
  for (const WindowPolygon::Corners& corner : triangle.triangles()) {
    const WindowVertex& a = triangle.window[corner[0]];
    const WindowVertex& b = triangle.window[corner[1]];
    const WindowVertex& c = triangle.window[corner[2]];
    const double area = std::abs(doubled_area(a, b, c));
    if (area <= largest) continue;
    largest = area;
    slope = slope_of(kind, a, b, c, area);
  }
  return slope;
}

// Offset of the polygon of triangles [first, last).
double offset_of(const BinDraw& draw, float factor, float units, std::size_t first, std::size_t last) {
  const DepthFormat kind = draw.transform->depth;
  double slope = 0, largest_area = 0, largest_depth = 0;
  for (std::size_t t = first; t < last; ++t) {
    const WindowPolygon triangle = in_window(draw, static_cast<std::uint32_t>(t));
    for (int i = 0; i < triangle.clipped.count; ++i)
      largest_depth = std::max(largest_depth, depth_of(kind, triangle.window[i].z));
    if (std::abs(triangle.area) <= largest_area) continue;
    largest_area = std::abs(triangle.area);
    slope = slope_of(kind, triangle);
  }
  int exponent = 32 - depth_bits(kind);  // one level, in depth words
  if (kind == DepthFormat::float32)
    exponent = std::max(largest_depth > 0 ? std::ilogb(largest_depth) : -126, -126) - 23;
  return double{factor} * slope + std::ldexp(double{units}, exponent);
}

}  // namespace

void offset_polygons(const BinDraw& draw, std::size_t per_polygon, float factor, float units,
                     std::size_t first, std::size_t last, double* offsets) {
  for (std::size_t begin = (first + per_polygon - 1) / per_polygon * per_polygon; begin < last;
       begin += per_polygon) {
    if (draw.facing == nullptr) {
      const std::uint8_t outcodes = outcodes_of(draw, static_cast<std::uint32_t>(begin));
      const bool is_clipped = outcodes != 0 && (outcodes & kNonFinite) == 0;
      offsets[begin] = is_clipped ? offset_of(draw, factor, units, begin, begin + 1)
                                  : std::numeric_limits<double>::quiet_NaN();
    } else {
      std::fill_n(offsets + begin, per_polygon,
                  draw.facing[begin] != Facing::dropped
                      ? offset_of(draw, factor, units, begin, begin + per_polygon)
                      : 0.0);
    }
  }
}

}  // namespace tessera::detail
