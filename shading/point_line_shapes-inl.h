// Pixels and samples that points and lines cover.
#if defined(TESSERA_SHADING_POINT_LINE_SHAPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POINT_LINE_SHAPES_INL_H_
#undef TESSERA_SHADING_POINT_LINE_SHAPES_INL_H_
#else
#define TESSERA_SHADING_POINT_LINE_SHAPES_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "raster/line_steps-inl.h"
#include "raster/point_line_coverage.h"
#include "shading/fragment_triangle-inl.h"
#include "shading/point_line_values-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Center of a pixel of the tile, raster space.
HWY_INLINE LinePoint center_of(const TileContext& context, int x, int y) {
  return {(context.tile_x + x) * kSubpixelScale + kHalfPixel,
          (context.tile_y + y) * kSubpixelScale + kHalfPixel};
}
HWY_INLINE LinePoint moved(LinePoint p, SamplePosition by) { return {p.x + by.x, p.y + by.y}; }
HWY_INLINE LinePoint vertex_of(const TriangleGroup& g, int i, int k) { return {g.x[k][i], g.y[k][i]}; }
HWY_INLINE PixelRect in_tile(const TileContext& context, const PixelRect& rect) {
  return intersect({rect.x0 - context.tile_x, rect.y0 - context.tile_y, rect.x1 - context.tile_x,
                    rect.y1 - context.tile_y},
                   context.rect);
}

/// Covered pixels of the touched blocks, for each sample.
struct BlockCoverage {
  TileContext& context;
  TouchedBlocks& blocks;

  /// @param samples  covered samples of the pixel, one bit each
  HWY_INLINE void add(int x, int y, std::uint32_t samples) {
    const int block = context.block_index(x, y) / kBlockPixels;
    if (blocks.samples[block] == 0) blocks.list[blocks.count++] = static_cast<std::uint16_t>(block);
    blocks.samples[block] |= samples;
    const std::uint32_t bit = 1u << ((y & 3) * 4 + (x & 3));
    for (std::uint32_t left = samples; left != 0; left &= left - 1)
      blocks.bits[std::countr_zero(left)][block] |= static_cast<std::uint16_t>(bit);
  }

  /// Draws the fragments of all touched blocks, and clears the blocks.
  HWY_INLINE void draw(FragmentTriangle& fragments, const LineValues& values) {
    const int columns = context.tile_size >> 2;
    for (int n = 0; n < blocks.count; ++n) {
      const int block = blocks.list[n];
      const int bx = block % columns * 4, by = block / columns * 4;
      BlockFragments samples[kMaxSamples];
      for (int s = 0; s < context.samples; ++s) {
        const std::uint32_t bits = blocks.bits[s][block];
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
          samples[s].covered[chunk] = hn::VecFromMask(kInt, mask_from_bits(chunk_bits(bits, chunk)));
          samples[s].keys[chunk] = hn::Zero(kInt);
        }
        if (fragments.has_depth) {
          const SamplePosition position =
              context.samples > 1 ? sample_positions(context.samples)[s] : SamplePosition{};
          block_keys(bx, by, position, values, samples[s].keys);
        }
        blocks.bits[s][block] = 0;
      }
      blocks.samples[block] = 0;
      fragments(bx, by, samples);
    }
    blocks.count = 0;
  }

 private:
  HWY_INLINE void block_keys(int bx, int by, SamplePosition position, const LineValues& values,
                             Int (&keys)[kChunksPerBlock]) const {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const Int x = hn::Add(splat(bx), block_columns(chunk));
      const Int y = hn::Add(splat(by), block_rows(chunk));
      keys[chunk] = values.depth.keys(values.parameters(x, y, position));
    }
  }
};

/// Adds the samples that `shape` covers in a rectangle of pixels.
template <class Shape>
HWY_INLINE void cover_samples(BlockCoverage& coverage, const Shape& shape, const PixelRect& pixels) {
  const TileContext& context = coverage.context;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const LinePoint center = center_of(context, x, y);
      std::uint32_t samples = 0;
      for (int s = 0; s < context.samples; ++s)
        samples |= shape.covers(moved(center, sample_positions(context.samples)[s])) ? 1u << s : 0u;
      if (samples != 0) coverage.add(x, y, samples);
    }
}

struct PointShape {
  const TileContext& context;
  LinePoint at;
  float size;

  /// Calls pixel(x, y) for each covered pixel. @pre one sample
  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    const PixelRect square = in_tile(context, point_square(at, rounded_size(size)));
    for (int y = square.y0; y < square.y1; ++y)
      for (int x = square.x0; x < square.x1; ++x) pixel(x, y);
  }
  /// Adds the covered samples.
  HWY_INLINE void cover(BlockCoverage& coverage) const {
    const PointDisc disc(at, snapped_size(size));
    const std::int32_t reach = disc.reach() + kHalfPixel;
    cover_samples(coverage, disc, in_tile(context, pixels_near(at, at, reach)));
  }
};

struct LineShape {
  const TileContext& context;
  const LineSteps& steps;  // steps of the group
  int i;                   // number of the line
  float width;

  /// Calls pixels(x, y, inside) for vectors of covered pixels. @pre one sample
  template <class Pixels>
  HWY_INLINE void for_each_vector(const Pixels& pixels) const {
    const PixelRect& r = context.rect;
    steps.for_each(
        i, {r.x0 + context.tile_x, r.y0 + context.tile_y, r.x1 + context.tile_x, r.y1 + context.tile_y},
        [&](Int x, Int y, LaneMask inside) HWY_ATTR {
          pixels(hn::Sub(x, splat(context.tile_x)), hn::Sub(y, splat(context.tile_y)), inside);
        });
  }
  /// Calls pixel(x, y) for each covered pixel. @pre one sample
  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    for_each_vector([&](Int x, Int y, LaneMask inside) HWY_ATTR {
      alignas(64) std::int32_t columns[kLanes];
      alignas(64) std::int32_t rows[kLanes];
      hn::Store(x, kInt, columns);
      hn::Store(y, kInt, rows);
      for (std::uint32_t left = mask_bits(kInt, inside); left != 0; left &= left - 1)
        pixel(columns[std::countr_zero(left)], rows[std::countr_zero(left)]);
    });
  }
  /// Adds the covered samples.
  HWY_INLINE void cover(BlockCoverage& coverage) const {
    const LinePoint a = vertex_of(context.memory.group, i, 0);
    const LinePoint b = vertex_of(context.memory.group, i, 1);
    const LineRectangle rectangle(a, b, snapped_size(width));
    const PixelRect pixels = in_tile(context, pixels_near(a, b, line_reach(width, context.samples)));
    for (int by = pixels.y0 & ~3; by < pixels.y1; by += 4)
      for (int bx = pixels.x0 & ~3; bx < pixels.x1; bx += 4) {
        const LinePoint center{(context.tile_x + bx + 2) * kSubpixelScale,
                               (context.tile_y + by + 2) * kSubpixelScale};
        if (rectangle.may_touch(center, 2 * kSubpixelScale))
          cover_samples(coverage, rectangle, intersect(pixels, {bx, by, bx + 4, by + 4}));
      }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
