// Prices of triangles by size, points, lines and images; and of what depth, colours and samples add to them.
#include <utility>

#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

constexpr double kSmall = 16, kLarge = 4096;  // pixels: for prices per triangle, and per covered pixel
constexpr int kCopies = 4;

/// `copies` of every triangle against one: vertices and buffers are the same.
PricePair copies(PriceItem item, const PriceFrame& frame, int copies = kCopies) {
  PriceFrame repeated = frame;
  repeated.copies = copies;
  return {.item = item, .with = std::move(repeated), .without = frame};
}

/// Small triangles take a small window, so that frames take a few milliseconds.
PriceFrame triangles_of(double pixels) {
  PriceFrame frame;
  frame.triangle_pixels = pixels;
  if (pixels < 64) frame.format.width = 640, frame.format.height = 480;
  if (pixels < 4) frame.format.width = 320, frame.format.height = 240;
  return frame;
}

/// The cost that `change` adds to the triangles of a size.
template <class Change>
PricePair added(PriceItem item, double size, const Change& change, std::vector<PriceItem> known = {}) {
  PricePair pair = copies(item, changed(triangles_of(size), change));
  pair.known = std::move(known);
  pair.has_known_triangles = true;
  return pair;
}

void test_depth(PriceFrame& frame, DepthFormat format) { frame.format.depth = format; }
void interpolate(PriceFrame& frame) {
  frame.has_colors = true;
  frame.state.shading = Shading::gouraud;
}
void sample(PriceFrame& frame, int samples) {
  test_depth(frame, DepthFormat::unorm24);
  frame.format.samples = samples;
}
void blend(PriceFrame& frame) {
  interpolate(frame);
  frame.state.blend = BlendState{};
}

void test_alpha_of_points(PriceFrame& frame) {
  frame.subject = Subject::points;
  frame.state.alpha_test = AlphaTest{};
}
void test_alpha_of_lines(PriceFrame& frame) {
  frame.subject = Subject::lines;
  frame.state.alpha_test = AlphaTest{};
}
/// Triangles of a size whose edges are drawn.
PricePair outlined(PriceItem item, double size, std::vector<PriceItem> known) {
  PricePair pair = copies(
      item, changed(triangles_of(size), [](PriceFrame& f) { f.state.front_mode = PolygonMode::line; }));
  pair.known = std::move(known);
  return pair;
}

}  // namespace

std::vector<PricePair> triangle_price_pairs() {
  const auto depth = [](DepthFormat format) { return [=](PriceFrame& f) { test_depth(f, format); }; };
  const auto samples = [](int count) { return [=](PriceFrame& f) { sample(f, count); }; };
  const std::vector<PriceItem> depth_work{PriceItem::depth_triangle, PriceItem::depth_unorm24_pixel};
  const std::vector<PriceItem> color_work{PriceItem::interpolated_triangle, PriceItem::interpolated_pixel};
  const auto with = [](std::vector<PriceItem> list, PriceItem item) {
    list.push_back(item);
    return list;
  };
  return {
      copies(PriceItem::triangle_outside,
             changed(triangles_of(16), [](PriceFrame& f) { f.placement = Placement::outside; })),
      copies(PriceItem::triangle_culled,
             changed(triangles_of(16), [](PriceFrame& f) { f.state.cull = Cull::front; })),
      copies(PriceItem::triangle_0, triangles_of(0.05)),
      copies(PriceItem::triangle_1, triangles_of(1)),
      copies(PriceItem::triangle_4, triangles_of(4)),
      copies(PriceItem::triangle_16, triangles_of(16)),
      copies(PriceItem::triangle_64, triangles_of(64)),
      copies(PriceItem::triangle_256, triangles_of(256)),
      copies(PriceItem::triangle_1024, triangles_of(1024)),
      copies(PriceItem::triangle_4096, triangles_of(4096), 8),
      added(PriceItem::triangle_clipped, 256, [](PriceFrame& f) { f.placement = Placement::across_near; }),
      copies(PriceItem::point, changed(triangles_of(16), [](PriceFrame& f) { f.subject = Subject::points; })),
      copies(PriceItem::line_16,
             changed(triangles_of(64), [](PriceFrame& f) { f.subject = Subject::lines; })),
      copies(PriceItem::point_fragments, changed(triangles_of(16), test_alpha_of_points)),
      copies(PriceItem::line_16_fragments, changed(triangles_of(64), test_alpha_of_lines)),
      outlined(PriceItem::outlined_pixel, 1024, {}),
      outlined(PriceItem::outlined_triangle, 16, {PriceItem::outlined_pixel}),
      copies(PriceItem::texel_pixel,
             changed(PriceFrame(), [](PriceFrame& f) { f.subject = Subject::image; })),
      added(PriceItem::depth_unorm16_pixel, kLarge, depth(DepthFormat::unorm16)),
      added(PriceItem::depth_unorm24_pixel, kLarge, depth(DepthFormat::unorm24)),
      added(PriceItem::depth_unorm32_pixel, kLarge, depth(DepthFormat::unorm32)),
      added(PriceItem::depth_float32_pixel, kLarge, depth(DepthFormat::float32)),
      added(PriceItem::depth_triangle, kSmall, depth(DepthFormat::unorm24), {PriceItem::depth_unorm24_pixel}),
      added(PriceItem::interpolated_pixel, kLarge, interpolate),
      added(PriceItem::interpolated_triangle, kSmall, interpolate, {PriceItem::interpolated_pixel}),
      added(PriceItem::samples_4_pixel, kLarge, samples(4), depth_work),
      added(PriceItem::samples_4_triangle, kSmall, samples(4), with(depth_work, PriceItem::samples_4_pixel)),
      added(PriceItem::samples_8_pixel, kLarge, samples(8), depth_work),
      added(PriceItem::samples_8_triangle, kSmall, samples(8), with(depth_work, PriceItem::samples_8_pixel)),
      added(PriceItem::source_alpha_blend_pixel, kLarge, blend, color_work),
      added(PriceItem::source_alpha_blend_triangle, kSmall, blend,
            with(color_work, PriceItem::source_alpha_blend_pixel)),
  };
}

}  // namespace tessera::bench
