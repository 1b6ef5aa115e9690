// Prices of frames, draws and the pixels of the frame buffer.
#include <utility>

#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

PriceFrame cleared(int width, int height) {
  PriceFrame frame;
  frame.format.width = width;
  frame.format.height = height;
  frame.subject = Subject::nothing;
  return frame;
}

/// Points in all tiles, about one for every 512 pixels.
PriceFrame points_in_tiles() {
  PriceFrame frame;
  frame.subject = Subject::points;
  frame.triangle_pixels = 256;
  return frame;
}
PriceFrame points_with_depth() {
  PriceFrame frame = points_in_tiles();
  frame.format.depth = DepthFormat::unorm24;
  return frame;
}

PricePair tile_pixels(PriceItem item, PriceFrame frame) {
  PriceFrame in_one_tile = frame;
  in_one_tile.subject = Subject::one_point;
  return {.item = item,
          .with = std::move(frame),
          .without = std::move(in_one_tile),
          .instead = {PriceItem::shown_pixel}};
}

PricePair stored(PriceItem item, Buffer buffer, PriceFrame frame) {
  PriceFrame kept = frame;
  kept.kept = buffer;
  return {.item = item, .with = std::move(kept), .without = std::move(frame)};
}
PricePair stored_colors(PriceItem item, int bits) {
  PriceFrame frame = points_in_tiles();
  frame.format.color_bits = bits;
  return stored(item, Buffer::color, std::move(frame));
}
PricePair stored_depths(PriceItem item, DepthFormat format) {
  PriceFrame frame = points_in_tiles();
  frame.format.depth = format;
  return stored(item, Buffer::depth, std::move(frame));
}
PricePair stored_stencil() {
  PriceFrame frame = points_in_tiles();
  frame.format.stencil_bits = 8;
  frame.state.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
  return stored(PriceItem::stored_stencil_8, Buffer::stencil, std::move(frame));
}

/// Frames keep the planes, because the next one loads them.
PricePair loaded_colors() {
  const PriceFrame kept = changed(points_in_tiles(), [](PriceFrame& f) { f.kept = Buffer::color; });
  return {.item = PriceItem::loaded_24,
          .with = changed(kept, [](PriceFrame& f) { f.loads = true; }),
          .without = kept};
}

PricePair resolved(PriceItem item, int samples) {
  return {.item = item,
          .with = changed(points_with_depth(), [&](PriceFrame& f) { f.format.samples = samples; }),
          .without = points_with_depth()};
}

/// Frames with an accumulation buffer and this number of operations.
PriceFrame accumulating(int accumulations, int returns) {
  PriceFrame frame = points_in_tiles();
  frame.format.accumulation_bits = 16;
  frame.accumulations = accumulations;
  frame.returns = returns;
  return frame;
}

/// Frames that are shown, with Floyd-Steinberg dither or without.
PriceFrame diffused(ColorMode mode, Dither dither) {
  return changed(points_in_tiles(), [&](PriceFrame& f) {
    f.format.color_mode = mode;
    f.format.color_bits = mode == ColorMode::index ? 8 : 16;
    f.format.dither = dither;
  });
}

PricePair draws() {
  // 1,200 triangles of 16 pixels: one draw each, or all in one.
  PriceFrame frame;
  frame.format.width = 240;
  frame.format.height = 160;
  frame.triangle_pixels = 16;
  frame.subject = Subject::triangles;
  PriceFrame separate = frame;
  separate.subject = Subject::small_draws;
  return {.item = PriceItem::draw, .with = std::move(separate), .without = std::move(frame)};
}

}  // namespace

std::vector<PricePair> frame_price_pairs() {
  return {
      {.item = PriceItem::frame, .with = cleared(64, 64)},
      {.item = PriceItem::shown_pixel, .with = cleared(1280, 960), .without = cleared(640, 480)},
      tile_pixels(PriceItem::shown_tile_pixel, points_in_tiles()),
      {.item = PriceItem::shown_index_pixel,
       .with = changed(points_in_tiles(),
                       [](PriceFrame& f) {
                         f.format.color_mode = ColorMode::index;
                         f.format.color_bits = 8;
                       }),
       .without = changed(points_in_tiles(), [](PriceFrame& f) { f.format.color_bits = 8; })},
      {.item = PriceItem::depth_tile_pixel, .with = points_with_depth(), .without = points_in_tiles()},
      stored_colors(PriceItem::stored_1, 1),
      stored_colors(PriceItem::stored_2, 2),
      stored_colors(PriceItem::stored_4, 4),
      stored_colors(PriceItem::stored_8, 8),
      stored_colors(PriceItem::stored_16, 16),
      stored_colors(PriceItem::stored_24, 24),
      stored_depths(PriceItem::stored_depth_16, DepthFormat::unorm16),
      stored_depths(PriceItem::stored_depth_24, DepthFormat::unorm24),
      stored_depths(PriceItem::stored_depth_32, DepthFormat::float32),
      stored_stencil(),
      loaded_colors(),
      {.item = PriceItem::dithered_clear,
       .with = changed(cleared(1280, 960), [](PriceFrame& f) { f.format.dither = Dither::bayer8; }),
       .without = cleared(1280, 960)},
      {.item = PriceItem::diffused_pixel,
       .with = diffused(ColorMode::rgb, Dither::floyd_steinberg),
       .without = diffused(ColorMode::rgb, Dither::none)},
      {.item = PriceItem::diffused_index_pixel,
       .with = diffused(ColorMode::index, Dither::floyd_steinberg),
       .without = diffused(ColorMode::rgb, Dither::floyd_steinberg)},
      {.item = PriceItem::accumulated, .with = accumulating(4, 1), .without = accumulating(2, 1)},
      {.item = PriceItem::returned, .with = accumulating(2, 3), .without = accumulating(2, 1)},
      resolved(PriceItem::resolved_4, 4),
      resolved(PriceItem::resolved_8, 8),
      draws(),
  };
}

}  // namespace tessera::bench
