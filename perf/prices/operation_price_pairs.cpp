// Prices of fragment operations on covered pixels.
#include <utility>

#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

/// Large triangles in one colour, with a logic operation or an alpha test, whose code path takes all fragment
/// operations.
PriceFrame large_triangles() {
  PriceFrame frame;
  frame.copies = 4;
  frame.format.stencil_bits = 8;
  frame.format.depth = DepthFormat::unorm24;
  return frame;
}
void test_alpha(PriceFrame& frame) { frame.state.alpha_test = AlphaTest{Compare::greater, 0.5f}; }
PriceFrame alpha_tested() { return changed(large_triangles(), test_alpha); }
PriceFrame with_logic_op() {
  return changed(large_triangles(), [](PriceFrame& f) { f.state.logic_op = LogicOp::bit_xor; });
}

/// The operation together with an alpha test, against the alpha test alone.
template <class Change>
PricePair operation(PriceItem item, const Change& change) {
  return {.item = item, .with = changed(alpha_tested(), change), .without = alpha_tested()};
}

/// Fragments that fail a stencil test, of triangles of a size: four copies against one.
PricePair failing_fragments(PriceItem item, double size, std::vector<PriceItem> known) {
  PriceFrame frame = alpha_tested();
  frame.state.stencil = StencilState{.front = {.func = Compare::equal, .ref = 1}};
  frame.triangle_pixels = size;
  PriceFrame once = frame;
  once.copies = 1;
  known.insert(known.end(), {PriceItem::alpha_test, PriceItem::stencil_test});
  return {.item = item,
          .with = std::move(frame),
          .without = std::move(once),
          .known = std::move(known),
          .has_known_triangles = true};
}

/// Alpha-tested triangles of a size with several samples: four copies against one.
PricePair fragment_samples(PriceItem item, int samples, double size, std::vector<PriceItem> known) {
  PriceFrame frame = alpha_tested();
  frame.format.samples = samples;
  frame.triangle_pixels = size;
  PriceFrame once = frame;
  once.copies = 1;
  known.insert(known.end(), {PriceItem::alpha_test, PriceItem::fragment_operations_triangle,
                             PriceItem::fragment_operations_pixel, PriceItem::fragment_passed,
                             PriceItem::depth_triangle, PriceItem::depth_unorm24_pixel});
  return {.item = item,
          .with = std::move(frame),
          .without = std::move(once),
          .known = std::move(known),
          .has_known_triangles = true};
}

/// The same fragments if they pass.
PricePair passing_fragments() {
  PriceFrame fails = alpha_tested();
  fails.state.stencil = StencilState{.front = {.func = Compare::equal, .ref = 1}};
  PriceFrame passes = alpha_tested();
  passes.state.stencil = StencilState{.front = {.func = Compare::lequal, .ref = 0}};
  return {.item = PriceItem::fragment_passed, .with = std::move(passes), .without = std::move(fails)};
}

}  // namespace

std::vector<PricePair> operation_price_pairs() {
  return {
      {.item = PriceItem::alpha_test,
       .with = changed(with_logic_op(), test_alpha),
       .without = with_logic_op()},
      operation(PriceItem::stencil_test,
                [](PriceFrame& f) {
                  f.state.stencil =
                      StencilState{.front = {.func = Compare::gequal, .ref = 255, .zpass = StencilOp::incr}};
                }),
      failing_fragments(PriceItem::fragment_operations_pixel, 4096, {}),
      failing_fragments(PriceItem::fragment_operations_triangle, 16, {PriceItem::fragment_operations_pixel}),
      passing_fragments(),
      fragment_samples(PriceItem::fragment_samples_4_pixel, 4, 4096, {}),
      fragment_samples(PriceItem::fragment_samples_4_triangle, 4, 16, {PriceItem::fragment_samples_4_pixel}),
      fragment_samples(PriceItem::fragment_samples_8_pixel, 8, 4096, {}),
      fragment_samples(PriceItem::fragment_samples_8_triangle, 8, 16, {PriceItem::fragment_samples_8_pixel}),
      operation(PriceItem::blending,
                [](PriceFrame& f) {
                  f.state.blend =
                      BlendState{.src = BlendFactor::dst_color, .dst = BlendFactor::one_minus_src_alpha};
                }),
      operation(PriceItem::logic_op, [](PriceFrame& f) { f.state.logic_op = LogicOp::bit_xor; }),
      operation(PriceItem::dither, [](PriceFrame& f) { f.format.dither = Dither::bayer8; }),
      operation(PriceItem::write_masks,
                [](PriceFrame& f) {
                  f.state.color_mask = {true, false, true, true};
                }),
      operation(PriceItem::polygon_offset,
                [](PriceFrame& f) {
                  f.state.polygon_offset = {1, 1};
                }),
  };
}

}  // namespace tessera::bench
