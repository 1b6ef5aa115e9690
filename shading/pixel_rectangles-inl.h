// Bitmaps and images in a tile: coverage and colours of its blocks, one depth for all. What happens to the fragments is what happens
// to those of triangles.
#if defined(TESSERA_SHADING_PIXEL_RECTANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_PIXEL_RECTANGLES_INL_H_
#undef TESSERA_SHADING_PIXEL_RECTANGLES_INL_H_
#else
#define TESSERA_SHADING_PIXEL_RECTANGLES_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "raster/pixel_rectangle.h"
#include "shading/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Which texels a tile's pixels see at one of their samples; kNoTexel outside of the draw's rectangle.
struct TexelPlaces {
  std::int32_t column[kMaxTileSize], row[kMaxTileSize];

  void set_up(const TileRun& run, const PixelRectangle& texels, int sample) {
    const PixelRect& rect = run.rect;
    const int height = run.frame.grid.height_px, samples = run.samples;
    // The blocks that the rectangle's edges run through are whole.
    std::fill(column + (rect.x0 & ~3), column + ((rect.x1 + 3) & ~3), kNoTexel);
    std::fill(row + (rect.y0 & ~3), row + ((rect.y1 + 3) & ~3), kNoTexel);
    texel_columns(texels, run.tile_x + rect.x0, run.tile_x + rect.x1, samples, sample, column + rect.x0);
    texel_rows(texels, run.tile_y + rect.y0, run.tile_y + rect.y1, height, samples, sample, row + rect.y0);
  }
  bool same_in_block(const TexelPlaces& other, int bx, int by) const {
    return std::equal(column + bx, column + bx + kBlockSize, other.column + bx) && std::equal(row + by, row + by + kBlockSize, other.row + by);
  }
};

/// The pixels of a block that see a texel, or a bit that is set; 16 bits.
HWY_INLINE std::uint32_t covered_bits(const PixelRectangle& texels, const TexelPlaces& at, int bx, int by) {
  std::uint32_t columns = 0, bits = 0;
  for (int i = 0; i < kBlockSize; ++i) columns |= at.column[bx + i] != kNoTexel ? 1u << i : 0;
  for (int i = 0; i < kBlockSize; ++i) bits |= at.row[by + i] != kNoTexel ? columns << (i * kBlockSize) : 0;
  if (texels.channels != 0) return bits;
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int p = std::countr_zero(left);
    if (!texels.bit(at.column[bx + p % kBlockSize], at.row[by + p / kBlockSize])) bits &= ~(1u << p);
  }
  return bits;
}

/// r g b a of a texel, red lowest.
HWY_INLINE std::uint32_t texel_levels(const PixelRectangle& texels, int column, int row) {
  const std::uint8_t* const at = texels.row(row) + std::ptrdiff_t{column} * texels.channels;
  const std::uint32_t rgb = texels.channels < 3 ? at[0] * 0x010101u : at[0] | at[1] * 0x100u | at[2] * 0x10000u;
  const std::uint32_t alpha = texels.channels % 2 == 0 ? at[texels.channels - 1] : 0xffu;
  return rgb | alpha << 24;
}

/// The colours of a block's pixels, 0..1: r of all of them, then g, b and a.
HWY_INLINE void fetch_colors(const PixelRectangle& texels, const TexelPlaces& at, int bx, int by, std::uint32_t bits, float* HWY_RESTRICT colors) {
  alignas(64) std::uint32_t levels[kBlockPixels] = {};
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int p = std::countr_zero(left);
    levels[p] = texel_levels(texels, at.column[bx + p % kBlockSize], at.row[by + p / kBlockSize]);
  }
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const Uint packed = hn::Load(kUint, levels + chunk * kLanes);
    for (int c = 0; c < 4; ++c) {
      const Int level = hn::And(hn::BitCast(kInt, hn::ShiftRightSame(packed, 8 * c)), splat(255));
      // Divided, so that a level is the float nearest to it: tests compare with such.
      hn::Store(hn::Div(hn::ConvertTo(kFloat, level), splat(255.0f)), kFloat, colors + c * kBlockPixels + chunk * kLanes);
    }
  }
}

/// A draw that is a bitmap or an image, in one tile.
inline HWY_NOINLINE void draw_pixel_rectangle(TileRun& run, std::uint32_t draw_number) {
  const TileDraw& draw = run.frame.draws[draw_number];
  const PixelRectangle& texels = *draw.texels;
  const PixelRect& rect = run.rect;
  ShadedTriangle face{};  // its front; nothing else is looked at
  FragmentTriangle fragments{.run = run,
                             .draw = draw,
                             .ops = draw.ops != nullptr ? *draw.ops : kNoOperations,
                             .triangle = face,
                             .has_depth = draw.uses_depth && run.frame.depth_kind != DepthKind::none,
                             .pixels = {}};
  fragments.has_word = draw.number != TileDraw::Number::none || (draw.ops == nullptr && has_words(draw));
  const bool is_first_primitive = draw.number == TileDraw::Number::primitive || draw.source == ColorSource::triangle_word;
  fragments.word = is_first_primitive ? 0 : draw.word;
  alignas(64) float colors[4 * kBlockPixels];
  const bool has_colors = texels.channels != 0 && ((!fragments.has_word && draw.source == ColorSource::texels) || fragments.ops.alpha_test);
  if (has_colors) fragments.colors_given = colors;

  TexelPlaces places[kMaxSamples];
  const int apart = texels.channels != 0 ? run.samples : 1;  // bits cover whole pixels
  for (int s = 0; s < apart; ++s) places[s].set_up(run, texels, s);
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
      for (int s = 1; s < apart; ++s) alike &= places[s].same_in_block(places[0], bx, by);
      // Where samples of a pixel see different texels, each is a fragment of its own.
      for (int turn = 0; turn < (alike ? 1 : run.samples); ++turn) {
        const std::uint32_t bits = covered_bits(texels, places[turn], bx, by);
        if (bits == 0) continue;
        for (int s = 0; s < run.samples; ++s) cover(s, alike || s == turn ? bits : 0);
        if (has_colors) fetch_colors(texels, places[turn], bx, by, bits, colors);
        fragments(bx, by, blocks);
      }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
