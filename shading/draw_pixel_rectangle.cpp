// Bitmaps and images, drawn as blocks of fragments that all have the same depth.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_pixel_rectangle.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_functions-inl.h"
#include "shading/fragment_triangle-inl.h"
#include "shading/texel_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void draw_pixel_rectangle(TileContext& context, std::uint32_t draw_number) {
  const TileDraw& draw = context.frame.draws[draw_number];
  const PixelRectangle& texels = *draw.texels;
  const PixelRect& rect = context.rect;
  ShadedTriangle front_face{};  // without attributes
  front_face.draw = draw_number;
  FragmentTriangle fragments(context, front_face);
  // In captures of primitive numbers the rectangle is primitive 0.
  const bool stores_primitive_number =
      draw.id_output == TileDraw::IdOutput::primitive || draw.source == ColorSource::per_triangle_packed;
  fragments.packed_color = stores_primitive_number ? 0 : draw.packed_color;
  alignas(64) float colors[4 * kBlockPixels];
  const bool has_colors =
      texels.channels != 0 && (draw.path.color_write == ColorWrite::evaluated || fragments.ops.alpha_test);
  if (has_colors) fragments.block_colors = colors;
  fragments.begin_colors();

  TexelPlaces places[kMaxSamples];
  const int place_count = texels.channels != 0 ? context.samples : 1;  // bits of a bitmap cover whole pixels
  for (int s = 0; s < place_count; ++s)
    places[s].set_up({texels, context.frame.grid, context.tile_x, context.tile_y, rect}, context.samples, s);
  BlockFragments blocks[kMaxSamples];
  const auto cover = [&](int s, std::uint32_t bits) HWY_ATTR {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      blocks[s].covered[chunk] = hn::VecFromMask(kInt, mask_from_bits(bits >> (chunk * kLanes)));
      blocks[s].keys[chunk] = splat(draw.depth_key);
    }
  };
  for (int by = rect.y0 & ~3; by < rect.y1; by += kBlockSize)
    for (int bx = rect.x0 & ~3; bx < rect.x1; bx += kBlockSize) {
      bool alike = true;
      for (int s = 1; s < place_count; ++s) alike &= places[s].same_in_block(places[0], bx, by);
      // If the samples of a pixel have different texels, each sample is a fragment.
      const int turns = alike ? 1 : context.samples;
      for (int turn = 0; turn < turns; ++turn) {
        const std::uint32_t bits = places[turn].covered(texels, bx, by);
        if (bits == 0) continue;
        for (int s = 0; s < context.samples; ++s) cover(s, alike || s == turn ? bits : 0);
        if (has_colors) places[turn].fetch(texels, bx, by, bits, colors);
        fragments(bx, by, blocks);
      }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
