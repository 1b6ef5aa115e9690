// Points and lines in a tile. Few of their pixels lie in one block: each is covered, and has its depth, by itself. Plain colours are
// stored pixel by pixel; all others go block by block through what fragments of triangles go through.
#if defined(TESSERA_SHADING_POINTS_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POINTS_LINES_INL_H_
#undef TESSERA_SHADING_POINTS_LINES_INL_H_
#else
#define TESSERA_SHADING_POINTS_LINES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/point_line_coverage.h"
#include "shading/fragments-inl.h"
#include "shading/point_line_depth.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// The centre of a pixel of the tile.
HWY_INLINE LinePoint center_of(const TileRun& run, int x, int y) {
  return {(run.tile_x + x) * kSubpixelScale + kHalfPixel, (run.tile_y + y) * kSubpixelScale + kHalfPixel};
}
HWY_INLINE LinePoint moved(LinePoint p, SamplePosition by) { return {p.x + by.x, p.y + by.y}; }
HWY_INLINE LinePoint vertex_of(const TriangleGroup& g, int i, int k) { return {g.x[k][i], g.y[k][i]}; }
HWY_INLINE PixelRect in_tile(const TileRun& run, const PixelRect& rect) {
  return intersect({rect.x0 - run.tile_x, rect.y0 - run.tile_y, rect.x1 - run.tile_x, rect.y1 - run.tile_y}, run.rect);
}

/// Of edges and corners of polygons.
HWY_INLINE double depth_offset_of(const TileRun& run, const TileDraw& draw, int i) {
  return draw.depth_offsets != nullptr ? draw.depth_offsets[run.memory.source[i]] : 0.0;
}

/// What is linear along a line. What lies aside has the values of where it is projected onto the line, beyond the ends, too [GL 2.1, 3.4.1].
/// Of a point: the same everywhere.
struct LineValues {
  LinePoint a;
  double dx = 0, dy = 0, per_squared_length = 0;
  PointLineDepth depth;

  /// @param second  of the element's vertices: 1 of a line, 0 of a point
  HWY_INLINE LineValues(const TileRun& run, const TileDraw& draw, int i, int second)
      : a(vertex_of(run.memory.group, i, 0)), depth(run.frame.depth_kind, run.memory.group.z[0][i], run.memory.group.z[second][i], depth_offset_of(run, draw, i)) {
    const TriangleGroup& g = run.memory.group;
    dx = g.x[second][i] - g.x[0][i];
    dy = g.y[second][i] - g.y[0][i];
    const double squared_length = dx * dx + dy * dy;
    if (squared_length > 0) per_squared_length = 1 / squared_length;
  }
  /// Equation 3.5
  HWY_INLINE double t(LinePoint p) const { return (dx * (p.x - a.x) + dy * (p.y - a.y)) * per_squared_length; }
  HWY_INLINE std::int32_t key(LinePoint p) const { return depth.key(t(p)); }
};

/// As shading sees it: weights from exact "edges", as those of a wide triangle whose third vertex has none.
HWY_INLINE void fill_shaded_point_or_line(ShadedTriangle& t, TileRun& run, std::uint32_t draw, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  const bool is_line = run.frame.draws[draw].topology == Topology::lines;
  const int second = is_line ? 1 : 0;
  const double dx = g.x[second][i] - g.x[0][i], dy = g.y[second][i] - g.y[0][i], squared_length = dx * dx + dy * dy;
  const LinePoint first = center_of(run, 0, 0);
  WideEdges wide{};
  wide.a[1] = kSubpixelScale * dx;
  wide.b[1] = kSubpixelScale * dy;
  wide.e[1] = dx * (first.x - g.x[0][i]) + dy * (first.y - g.y[0][i]);
  wide.a[0] = -wide.a[1];
  wide.b[0] = -wide.b[1];
  wide.e[0] = squared_length - wide.e[1];
  const float scale = squared_length > 0 ? static_cast<float>(1 / squared_length) : 0.0f;
  t.affine = g.rw[second][i] == g.rw[0][i];
  for (int k = 0; k < 3; ++k) {
    const int vertex = k == 1 ? second : 0;
    t.scale[k] = k == 2 ? 0.0f : t.affine ? scale : g.rw[vertex][i] * scale;
    t.shift[k] = 0;
    t.attributes[k] = run.memory.attributes[vertex][i];
  }
  t.edges = {};
  t.back = back;
  t.draw = draw;
  keep_wide_edges(t, run.memory, wide);
}

/// Blocks with bits of the pixels that are covered, in each sample.
struct BlockBits {
  TileRun& run;
  TouchedBlocks& blocks;

  HWY_INLINE void add(int x, int y, std::uint32_t samples) {
    const int block = run.block_index(x, y) / kBlockPixels;
    if (blocks.samples[block] == 0) blocks.list[blocks.count++] = static_cast<std::uint16_t>(block);
    blocks.samples[block] |= samples;
    const std::uint32_t bit = 1u << ((y & 3) * 4 + (x & 3));
    for (std::uint32_t left = samples; left != 0; left &= left - 1) blocks.bits[std::countr_zero(left)][block] |= static_cast<std::uint16_t>(bit);
  }

  /// Runs them through `fragments`, and forgets them.
  HWY_INLINE void draw(FragmentTriangle& fragments, const LineValues& values) {
    const int columns = run.tile_size >> 2;
    for (int n = 0; n < blocks.count; ++n) {
      const int block = blocks.list[n], bx = block % columns * 4, by = block / columns * 4;
      BlockFragments covered[kMaxSamples];
      for (int s = 0; s < run.samples; ++s) {
        alignas(64) std::int32_t keys[kBlockPixels] = {};
        const std::uint32_t bits = blocks.bits[s][block];
        const SamplePosition position = run.samples > 1 ? sample_positions(run.samples)[s] : SamplePosition{};
        if (fragments.has_depth)
          for (std::uint32_t left = bits; left != 0; left &= left - 1) {
            const int p = std::countr_zero(left);
            keys[p] = values.key(moved(center_of(run, bx + (p & 3), by + (p >> 2)), position));
          }
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
          covered[s].covered[chunk] = hn::VecFromMask(kInt, mask_from_bits(chunk_bits(bits, chunk)));
          covered[s].keys[chunk] = hn::Load(kInt, keys + chunk * kLanes);
        }
        blocks.bits[s][block] = 0;
      }
      blocks.samples[block] = 0;
      fragments(bx, by, covered);
    }
    blocks.count = 0;
  }
};

/// The samples of `shape` in the pixels of a rectangle.
template <class Shape>
HWY_INLINE void cover_samples(BlockBits& bits, const Shape& shape, const PixelRect& pixels) {
  const TileRun& run = bits.run;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const LinePoint center = center_of(run, x, y);
      std::uint32_t samples = 0;
      for (int s = 0; s < run.samples; ++s) samples |= shape.covers(moved(center, sample_positions(run.samples)[s])) ? 1u << s : 0u;
      if (samples != 0) bits.add(x, y, samples);
    }
}

struct PointShape {
  const TileRun& run;
  LinePoint at;
  float size;

  /// Calls pixel(x, y) for each, of one sample.
  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    const PixelRect square = in_tile(run, point_square(at, whole_size(size)));
    for (int y = square.y0; y < square.y1; ++y)
      for (int x = square.x0; x < square.x1; ++x) pixel(x, y);
  }
  HWY_INLINE void cover(BlockBits& bits) const {
    const PointDisc disc(at, snapped_size(size));
    const std::int32_t reach = disc.reach() + kHalfPixel;
    cover_samples(bits, disc, in_tile(run, {first_pixel(at.x - reach), first_pixel(at.y - reach), last_pixel(at.x + reach) + 1, last_pixel(at.y + reach) + 1}));
  }
};

struct LineShape {
  const TileRun& run;
  LinePoint a, b;
  float width;

  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    const PixelRect& r = run.rect;
    const PixelRect window{r.x0 + run.tile_x, r.y0 + run.tile_y, r.x1 + run.tile_x, r.y1 + run.tile_y};
    LineWalk(a, b, whole_size(width)).for_each(window, [&](int x, int y) { pixel(x - run.tile_x, y - run.tile_y); });
  }
  HWY_INLINE void cover(BlockBits& bits) const {
    const LineRectangle rectangle(a, b, snapped_size(width));
    const std::int32_t reach = (snapped_size(width) + 1) / 2 + kHalfPixel;
    const auto [low_x, high_x] = std::minmax({a.x, b.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y});
    const PixelRect pixels = in_tile(run, {first_pixel(low_x - reach), first_pixel(low_y - reach), last_pixel(high_x + reach) + 1, last_pixel(high_y + reach) + 1});
    for (int by = pixels.y0 & ~3; by < pixels.y1; by += 4)
      for (int bx = pixels.x0 & ~3; bx < pixels.x1; bx += 4) {
        const LinePoint center{(run.tile_x + bx + 2) * kSubpixelScale, (run.tile_y + by + 2) * kSubpixelScale};
        if (rectangle.may_touch(center, 2 * kSubpixelScale)) cover_samples(bits, rectangle, intersect(pixels, {bx, by, bx + 4, by + 4}));
      }
  }
};

/// One word for all pixels.
struct OneWord {
  std::uint32_t value;
  HWY_INLINE std::uint32_t word(LinePoint, const LineValues&) const { return value; }
};

/// Colours of an RGB buffer, interpolated along a line.
struct LineColors {
  float first[3], change[3], most[3], rw[2];
  int shift[3];

  HWY_INLINE LineColors(const TileRun& run, const TileDraw& draw, int i, bool back) {
    const ColorLayout& layout = run.frame.layout;
    const int bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits}, shifts[3] = {layout.r_shift(), layout.g_shift(), 0};
    for (int c = 0; c < 3; ++c) {
      const int attribute = draw.color_attribute[back ? 1 : 0] + c;
      first[c] = run.memory.attributes[0][i][attribute];
      change[c] = run.memory.attributes[1][i][attribute] - first[c];
      most[c] = static_cast<float>((1 << bits[c]) - 1);
      shift[c] = shifts[c];
    }
    for (int k = 0; k < 2; ++k) rw[k] = run.memory.group.rw[k][i];
  }
  /// Equation 3.6
  HWY_INLINE std::uint32_t word(LinePoint p, const LineValues& values) const {
    float t = static_cast<float>(values.t(p));
    const float sum = (1 - t) * rw[0] + t * rw[1];
    if (rw[0] != rw[1] && sum != 0) t = t * rw[1] / sum;
    std::uint32_t word = 0;
    for (int c = 0; c < 3; ++c) {
      const float x = std::fma(t, change[c], first[c]), above = x > 0 ? x : 0.0f;  // a NaN is 0
      word |= static_cast<std::uint32_t>(std::fma(above < 1 ? above : 1.0f, most[c], 0.5f)) << shift[c];
    }
    return word;
  }
};

/// Colours that are just stored, pixel by pixel, where that is all there is to do.
template <class Colors>
struct PlainPixels {
  TileRun& run;
  const TileDraw& draw;
  bool has_depth;
  Colors colors;

  HWY_INLINE void store(int x, int y, const LineValues& values) const {
    const int index = run.pixel_index(x, y);
    const LinePoint center = center_of(run, x, y);
    if (has_depth) {
      const std::int32_t key = values.key(center), stored = run.memory.depth[index];
      if (!compares(key, draw.depth_test, stored)) return;
      if (draw.depth_write) run.memory.depth[index] = key;
    }
    ++run.counts.shaded_pixels;
    run.memory.color[index] = (colors.word(center, values) & draw.write_mask) | (run.memory.color[index] & ~draw.write_mask);
  }
};

/// The blocks in which element i of the group covers pixels, as bits, go through what fragments of triangles go through.
inline HWY_NOINLINE void draw_covered_blocks(BlockBits& bits, std::uint32_t draw_number, int i, const LineValues& values, bool back) {
  TileRun& run = bits.run;
  if (bits.blocks.count == 0) return;
  ShadedTriangle shaded;
  fill_shaded_point_or_line(shaded, run, draw_number, i, back);
  draw_fragments_of(run, draw_number, i, shaded, [&](FragmentTriangle& fragments) HWY_ATTR { bits.draw(fragments, values); });
}

/// All of a group, which needs no set-up.
/// @param second  see LineValues
template <class Shape>
HWY_INLINE void draw_points_or_lines(TileRun& run, std::uint32_t draw_number, int second, const Shape& shape_of) {
  const TriangleGroup& g = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  const bool uses_depth = has_depth(run.frame, draw), plain = draw.ops == nullptr && run.samples == 1, has_word = plain && has_words(draw);
  const bool interpolated = plain && second != 0 && draw.source == ColorSource::interpolated && !draw.deferred && !draw.index[0];
  for (int i = 0; i < g.count; ++i) {
    const auto shape = shape_of(i);
    const LineValues values(run, draw, i, second);
    const bool back = draw.facing != nullptr && draw.facing[run.memory.source[i]] == Facing::back;
    if (has_word) {
      const PlainPixels<OneWord> pixels{run, draw, uses_depth, {triangle_word(run, draw, i, back)}};
      shape.for_each([&](int x, int y) HWY_ATTR { pixels.store(x, y, values); });
    } else if (interpolated) {
      const PlainPixels<LineColors> pixels{run, draw, uses_depth, LineColors(run, draw, i, back)};
      shape.for_each([&](int x, int y) HWY_ATTR { pixels.store(x, y, values); });
    } else {
      BlockBits bits{run, run.memory.touched};
      if (run.samples == 1)
        shape.for_each([&](int x, int y) HWY_ATTR { bits.add(x, y, 1); });
      else
        shape.cover(bits);
      draw_covered_blocks(bits, draw_number, i, values, back);
    }
  }
}

inline void draw_points(TileRun& run, std::uint32_t draw_number) {
  const float size = run.frame.draws[draw_number].size;
  draw_points_or_lines(run, draw_number, 0, [&](int i) { return PointShape{run, vertex_of(run.memory.group, i, 0), size}; });
}
inline void draw_lines(TileRun& run, std::uint32_t draw_number) {
  const float width = run.frame.draws[draw_number].size;
  draw_points_or_lines(run, draw_number, 1, [&](int i) { return LineShape{run, vertex_of(run.memory.group, i, 0), vertex_of(run.memory.group, i, 1), width}; });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
