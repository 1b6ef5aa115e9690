// Prices of vertices: their transform, colours and lighting.
#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

/// About 77,000 vertices, of which two triangles are drawn.
PriceFrame many_vertices() {
  PriceFrame frame;
  frame.subject = Subject::corners;
  frame.triangle_pixels = 8;
  return frame;
}

PriceFrame lit_vertices() {
  PriceFrame frame = many_vertices();
  frame.state.lighting = true;
  frame.state.shading = Shading::gouraud;
  frame.state.normalize = false;
  return frame;
}

void interpolate_colors(PriceFrame& frame) {
  frame.has_colors = true;
  frame.state.shading = Shading::gouraud;
}

}  // namespace

std::vector<PricePair> vertex_price_pairs() {
  const PriceFrame one_light = lit_from_afar(lit_vertices());
  // For normals: every vertex has its triangles.
  const PriceFrame grid = changed(one_light, [](PriceFrame& f) { f.subject = Subject::grid; });
  const PriceFrame flat_grid = changed(grid, [](PriceFrame& f) { f.state.shading = Shading::flat; });
  std::vector<PricePair> pairs{
      {.item = PriceItem::vertex,
       .with = many_vertices(),
       .without = changed(many_vertices(), [](PriceFrame& f) { f.triangle_pixels = 1024; })},
      {.item = PriceItem::vertex_colors,
       .with = changed(many_vertices(), interpolate_colors),
       .without = many_vertices()},
  };
  const std::vector<PricePair> lights =
      light_price_pairs(lit_vertices(), {.directional = PriceItem::vertex_directional_light,
                                         .point = PriceItem::vertex_point_light,
                                         .attenuation = PriceItem::vertex_attenuation,
                                         .spot = PriceItem::vertex_spot,
                                         .highlight = PriceItem::vertex_highlight,
                                         .local_viewer = PriceItem::vertex_local_viewer,
                                         .second_side = PriceItem::vertex_second_side});
  pairs.insert(pairs.end(), lights.begin(), lights.end());
  pairs.push_back({.item = PriceItem::vertex_lighting,
                   .with = one_light,
                   .without = many_vertices(),
                   .known = {PriceItem::vertex_directional_light}});
  pairs.push_back({.item = PriceItem::vertex_normalization,
                   .with = changed(one_light, [](PriceFrame& f) { f.state.normalize = true; }),
                   .without = one_light});
  pairs.push_back({.item = PriceItem::vertex_normals,
                   .with = changed(one_light, [](PriceFrame& f) { f.state.shading = Shading::phong; }),
                   .without = many_vertices()});
  pairs.push_back({.item = PriceItem::face_normal,
                   .with = changed(flat_grid, [](PriceFrame& f) { f.has_normals = false; }),
                   .without = flat_grid});
  pairs.push_back({.item = PriceItem::generated_normal,
                   .with = changed(grid, [](PriceFrame& f) { f.has_normals = false; }),
                   .without = grid});
  return pairs;
}

}  // namespace tessera::bench
