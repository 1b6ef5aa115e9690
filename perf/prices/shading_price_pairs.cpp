// Prices of what is evaluated once per visible pixel: textures, lighting, colours from the visibility buffer.
#include <utility>

#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

PriceFrame with_depth_test() {
  PriceFrame frame;
  frame.format.depth = DepthFormat::unorm24;
  return frame;
}

PriceFrame phong() {
  PriceFrame frame = with_depth_test();
  frame.state.lighting = true;
  frame.state.shading = Shading::phong;
  return frame;
}

PriceFrame textured(PriceFrame frame, TextureFilter filter) {
  const bool has_mipmaps = filter != TextureFilter::nearest && filter != TextureFilter::linear;
  frame.texture = TextureSampler{.mag = has_mipmaps ? TextureFilter::linear : filter, .min = filter};
  return frame;
}
/// A texture on lit pixels.
PricePair texture_pair(PriceItem item, TextureFilter filter) {
  const PriceFrame lit = lit_from_afar(phong());
  return {.item = item, .with = textured(lit, filter), .without = lit};
}

/// A nearest texture on one colour, which needs the visibility buffer, against the colour alone.
PricePair deferred(PriceItem item, double size, std::vector<PriceItem> known) {
  PriceFrame frame = with_depth_test();
  frame.triangle_pixels = size;
  known.push_back(PriceItem::texture_nearest);
  return {.item = item,
          .with = textured(frame, TextureFilter::nearest),
          .without = frame,
          .known = std::move(known)};
}

/// Lit pixels in a colour-index buffer with 2^bits palette entries.
PricePair palette_search(PriceItem item, int bits) {
  const PriceFrame lit = lit_from_afar(phong());
  PriceFrame indexed = lit;
  indexed.format.color_mode = ColorMode::index;
  indexed.format.color_bits = bits;
  return {.item = item, .with = std::move(indexed), .without = lit, .known = {PriceItem::shown_index_pixel}};
}
void interpolate_colors_of_pixels(PriceFrame& frame) {
  frame.has_colors = true;
  frame.state.shading = Shading::gouraud;
}

}  // namespace

std::vector<PricePair> shading_price_pairs() {
  const PriceFrame lit = lit_from_afar(phong());
  const PriceFrame one_color = textured(with_depth_test(), TextureFilter::nearest);
  std::vector<PricePair> pairs{
      texture_pair(PriceItem::texture_nearest, TextureFilter::nearest),
      texture_pair(PriceItem::texture_linear, TextureFilter::linear),
      texture_pair(PriceItem::texture_nearest_mipmap_nearest, TextureFilter::nearest_mipmap_nearest),
      texture_pair(PriceItem::texture_linear_mipmap_nearest, TextureFilter::linear_mipmap_nearest),
      texture_pair(PriceItem::texture_nearest_mipmap_linear, TextureFilter::nearest_mipmap_linear),
      texture_pair(PriceItem::texture_linear_mipmap_linear, TextureFilter::linear_mipmap_linear),
      deferred(PriceItem::deferred_pixel, 4096, {}),
      deferred(PriceItem::deferred_triangle, 16, {PriceItem::deferred_pixel}),
      {.item = PriceItem::interpolated_deferred_pixel,
       .with = changed(one_color, interpolate_colors_of_pixels),
       .without = one_color},
  };
  const std::vector<PricePair> lights =
      light_price_pairs(phong(), {.directional = PriceItem::pixel_directional_light,
                                  .point = PriceItem::pixel_point_light,
                                  .attenuation = PriceItem::pixel_attenuation,
                                  .spot = PriceItem::pixel_spot,
                                  .highlight = PriceItem::pixel_highlight,
                                  .local_viewer = PriceItem::pixel_local_viewer,
                                  .second_side = PriceItem::pixel_second_side});
  pairs.insert(pairs.end(), lights.begin(), lights.end());
  pairs.push_back({.item = PriceItem::shaded_pixel,
                   .with = lit,
                   .without = with_depth_test(),
                   .known = {PriceItem::deferred_pixel, PriceItem::pixel_directional_light}});
  pairs.push_back(palette_search(PriceItem::palette_search_16, 4));
  pairs.push_back(palette_search(PriceItem::palette_search_256, 8));
  return pairs;
}

}  // namespace tessera::bench
