#include "raster/clipped_triangles.h"

#include <algorithm>
#include <cstddef>

#include "raster/multi_tile_triangle.h"

namespace tessera::detail {

ClipVertex clip_vertex(const BinDraw& draw, std::uint32_t vertex, int attribute_count) {
  ClipVertex v;
  if (draw.clip_positions != nullptr) {
    v.position = draw.clip_positions[vertex];
  } else {
    const float* p = draw.positions.at(vertex);
    v.object = {p[0], p[1], p[2], draw.components == 4 ? p[3] : 1.0f};
    const TransformedVertex transformed = transform_vertex(*draw.transform, *v.object);
    v.position = transformed.position;
    v.needs_exact = transformed.needs_exact;
  }
  const float* a = draw.attributes + std::size_t{vertex} * static_cast<std::size_t>(draw.attribute_stride);
  for (int j = 0; j < attribute_count; ++j) v.attributes[j] = a[j];
  return v;
}

WindowPolygon clip_to_window(const BinDraw& draw, std::uint32_t triangle, std::uint8_t outcodes,
                             int attribute_count) {
  const ClipVertex corners[3] = {clip_vertex(draw, vertex_index<3>(draw, triangle, 0), attribute_count),
                                 clip_vertex(draw, vertex_index<3>(draw, triangle, 1), attribute_count),
                                 clip_vertex(draw, vertex_index<3>(draw, triangle, 2), attribute_count)};
  return WindowPolygon(*draw.transform, clip_triangle(*draw.transform, corners, outcodes, attribute_count));
}

void bin_clipped_triangle(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t triangle,
                          std::uint8_t outcodes) {
  const WindowPolygon polygon = clip_to_window(draw, triangle, outcodes, draw.attribute_count);
  if (polygon.clipped.count == 0) {
    ++bins.counts.outside;
    return;
  }
  if (polygon.triangles().empty()) {
    ++bins.counts.zero_area;
    return;
  }
  if (!passes_face_culling(draw, triangle, polygon.area)) {  // the whole clipped polygon decides
    ++bins.counts.culled;
    return;
  }
  for (const WindowPolygon::Corners& corner : polygon.triangles()) {
    const WindowVertex& a = polygon.window[corner[0]];
    const WindowVertex& b = polygon.window[corner[1]];
    const WindowVertex& c = polygon.window[corner[2]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const int px0 = std::max(first_pixel(low_x - draw.sample_reach), draw.rect.x0);
    const int px1 = std::min(last_pixel(high_x + draw.sample_reach), draw.rect.x1 - 1);
    const int py0 = std::max(first_pixel(low_y - draw.sample_reach), draw.rect.y0);
    const int py1 = std::min(last_pixel(high_y + draw.sample_reach), draw.rect.y1 - 1);
    if (px0 > px1 || py0 > py1) continue;
    DerivedPrimitive& derived = bins.add_derived(triangle, 3, draw.attribute_count);
    for (int k = 0; k < 3; ++k) {
      derived.vertices[k] = polygon.window[corner[k]];
      std::copy_n(polygon.clipped.vertices[corner[k]].attributes, draw.attribute_count,
                  bins.attributes(derived) + k * draw.attribute_count);
    }
    ++bins.counts.binned;
    const WindowVertex* const v[3] = {&derived.vertices[0], &derived.vertices[1], &derived.vertices[2]};
    bin_multi_tile_triangle(bins, grid, v, doubled_area(a, b, c), draw, bins.last_derived_id(),
                            px0 / grid.tile_size, py0 / grid.tile_size, px1 / grid.tile_size,
                            py1 / grid.tile_size);
  }
}

}  // namespace tessera::detail
