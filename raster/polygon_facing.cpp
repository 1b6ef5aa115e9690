#include "raster/polygon_facing.h"

#include "raster/binning.h"

namespace tessera {
namespace {

std::uint8_t codes_of(const BinDraw& draw, std::uint32_t triangle, bool of_all) {
  const std::uint8_t c[3] = {draw.codes[vertex_index<3>(draw, triangle, 0)],
                             draw.codes[vertex_index<3>(draw, triangle, 1)],
                             draw.codes[vertex_index<3>(draw, triangle, 2)]};
  return of_all ? c[0] & c[1] & c[2] : c[0] | c[1] | c[2];
}

// Doubled area of what of a triangle is inside the view volume.
double visible_area(const BinDraw& draw, std::uint32_t triangle) {
  if (draw.any_code) {
    if (codes_of(draw, triangle, true) != 0) return 0;
    if (const std::uint8_t codes = codes_of(draw, triangle, false); codes != 0)
      return clip_to_window(draw, triangle, codes, 0).area;
  }
  return doubled_area(draw.vertices[vertex_index<3>(draw, triangle, 0)],
                      draw.vertices[vertex_index<3>(draw, triangle, 1)],
                      draw.vertices[vertex_index<3>(draw, triangle, 2)]);
}

Facing facing_of(const BinDraw& draw, std::size_t begin, std::size_t end) {
  double area = 0;
  for (std::size_t t = begin; t < end; ++t) {
    const auto triangle = static_cast<std::uint32_t>(t);
    if (draw.any_code && (codes_of(draw, triangle, false) & kNonFinite) != 0) return Facing::dropped;
    area += visible_area(draw, triangle);
  }
  return area == 0 || is_front(area, draw.front_is_clockwise) ? Facing::front : Facing::back;
}

}  // namespace

void face_polygons(const BinDraw& draw, std::size_t each, std::size_t first, std::size_t last,
                   Facing* facing) {
  for (std::size_t begin = (first + each - 1) / each * each; begin < last; begin += each) {
    const Facing of_polygon = facing_of(draw, begin, begin + each);
    for (std::size_t t = begin; t < begin + each; ++t) facing[t] = of_polygon;
  }
}

}  // namespace tessera
