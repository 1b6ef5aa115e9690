#include "raster/polygon_facing.h"

#include "raster/clipped_triangles.h"

namespace tessera::detail {
namespace {

// Outcodes that all vertices of a triangle share, or that any of them has.
enum class Combine { all, any };
std::uint8_t outcodes_of(const BinDraw& draw, std::uint32_t triangle, Combine combine) {
  const std::uint8_t c[3] = {draw.outcodes[vertex_index<3>(draw, triangle, 0)],
                             draw.outcodes[vertex_index<3>(draw, triangle, 1)],
                             draw.outcodes[vertex_index<3>(draw, triangle, 2)]};
  return combine == Combine::all ? c[0] & c[1] & c[2] : c[0] | c[1] | c[2];
}

// Doubled window area of a triangle after clipping.
double visible_area(const BinDraw& draw, std::uint32_t triangle) {
  if (draw.any_outcode) {
    if (outcodes_of(draw, triangle, Combine::all) != 0) return 0;
    if (const std::uint8_t outcodes = outcodes_of(draw, triangle, Combine::any); outcodes != 0)
      return clip_to_window(draw, triangle, outcodes, 0).area;
  }
  return doubled_area(draw.vertices[vertex_index<3>(draw, triangle, 0)],
                      draw.vertices[vertex_index<3>(draw, triangle, 1)],
                      draw.vertices[vertex_index<3>(draw, triangle, 2)]);
}

Facing facing_of(const BinDraw& draw, std::size_t begin, std::size_t end) {
  double area = 0;
  for (std::size_t t = begin; t < end; ++t) {
    const auto triangle = static_cast<std::uint32_t>(t);
    if (draw.any_outcode && (outcodes_of(draw, triangle, Combine::any) & kNonFinite) != 0)
      return Facing::dropped;
    area += visible_area(draw, triangle);
  }
  if (area == 0) return Facing::edge_on;
  return is_front(area, draw.front_is_clockwise) ? Facing::front : Facing::back;
}

}  // namespace

void classify_polygon_facing(const BinDraw& draw, std::size_t per_polygon, std::size_t first,
                             std::size_t last, Facing* facing) {
  for (std::size_t begin = (first + per_polygon - 1) / per_polygon * per_polygon; begin < last;
       begin += per_polygon) {
    const Facing of_polygon = facing_of(draw, begin, begin + per_polygon);
    for (std::size_t t = begin; t < begin + per_polygon; ++t) facing[t] = of_polygon;
  }
}

}  // namespace tessera::detail
