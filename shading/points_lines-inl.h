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
#include "shading/point_line_values-inl.h"

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
  const RelativeRw rw(g, i, second);
  t.affine = rw.equal();
  for (int k = 0; k < 3; ++k) {
    const int vertex = k == 1 ? second : 0;
    t.scale[k] = k == 2 ? 0.0f : rw.of[k] * scale;
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
        if (fragments.has_depth) block_keys(bx, by, run.samples > 1 ? sample_positions(run.samples)[s] : SamplePosition{}, values, keys);
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

 private:
  HWY_INLINE void block_keys(int bx, int by, SamplePosition position, const LineValues& values, std::int32_t* keys) const {
    LinePixels pixels;
    pixels.count = kBlockPixels;
    alignas(64) double t[kBlockPixels];
    for (int p = 0; p < kBlockPixels; ++p) pixels.x[p] = bx + (p & 3), pixels.y[p] = by + (p >> 2);
    values.parameters(pixels, t, position);
    values.depth.keys(kBlockPixels, t, keys);
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

/// Words that are just stored, where that is all there is to do.
class PlainPixels {
 public:
  HWY_INLINE PlainPixels(TileRun& run, const TileDraw& draw)
      : run_(run), draw_(draw), uses_depth_(has_depth(run.frame, draw)), less_(passes(-1)), equal_(passes(0)), greater_(passes(1)) {}

  HWY_INLINE bool uses_depth() const { return uses_depth_; }
  HWY_INLINE void store_one(int x, int y, std::int32_t key, std::uint32_t word) const {
    const int index = run_.pixel_index(x, y);
    if (uses_depth_) {
      std::int32_t& stored = run_.memory.depth[index];
      if ((key < stored ? less_ : key > stored ? greater_ : equal_) == 0) return;
      if (draw_.depth_write) stored = key;
    }
    std::uint32_t& color = run_.memory.color[index];
    color ^= (color ^ word) & draw_.write_mask;
    ++run_.counts.shaded_pixels;
  }
  /// Pixels of a line, none of them twice. Whether a depth passes could not be foretold: nothing branches on it.
  HWY_INLINE void store(const LinePixels& pixels, const std::int32_t* keys, const std::uint32_t* words) const {
    alignas(64) std::int32_t index[kLinePixels], stored[kLinePixels] = {}, passed[kLinePixels];
    const int columns = run_.tile_size >> 2;
    for_pixels(pixels.count, [&](int l) HWY_ATTR {
      const std::int32_t x = pixels.x[l], y = pixels.y[l];
      index[l] = ((y >> 2) * columns + (x >> 2)) * kBlockPixels + (y & 3) * 4 + (x & 3);
      passed[l] = -1;
    });
    if (uses_depth_) {
      for (int l = 0; l < pixels.count; ++l) stored[l] = run_.memory.depth[index[l]];
      const std::int32_t less = less_, equal = equal_, greater = greater_;
      for_pixels(pixels.count, [&](int l) HWY_ATTR { passed[l] = keys[l] < stored[l] ? less : keys[l] > stored[l] ? greater : equal; });
      if (draw_.depth_write)
        for (int l = 0; l < pixels.count; ++l) run_.memory.depth[index[l]] = (keys[l] & passed[l]) | (stored[l] & ~passed[l]);
    }
    std::int64_t seen = 0;
    for (int l = 0; l < pixels.count; ++l) {
      std::uint32_t& color = run_.memory.color[index[l]];
      color ^= (color ^ words[l]) & draw_.write_mask & static_cast<std::uint32_t>(passed[l]);
      seen -= passed[l];
    }
    run_.counts.shaded_pixels += static_cast<std::uint64_t>(seen);
  }

 private:
  /// As a mask: what the test says of a key that is less, equal or greater.
  HWY_INLINE std::int32_t passes(int order) const { return compares(order, draw_.depth_test, 0) ? -1 : 0; }

  TileRun& run_;
  const TileDraw& draw_;
  bool uses_depth_;
  std::int32_t less_, equal_, greater_;
};

HWY_INLINE void store_plain(const PlainPixels& pixels, const PointShape& point, LinePixels&, const LineValues& values, const LineColors*, std::uint32_t word) {
  const std::int32_t key = pixels.uses_depth() ? values.depth.first_key() : 0;
  point.for_each([&](int x, int y) HWY_ATTR { pixels.store_one(x, y, key, word); });
}

/// The pixels of a line, which wait until there are some.
struct PlainLine {
  const PlainPixels& pixels;
  const LineValues& values;
  const LineColors* colors;  // null: one word
  std::uint32_t word;
  LinePixels& waiting;

  HWY_NOINLINE void store(int count) {
    waiting.count = count;
    alignas(64) double t[kLinePixels];
    alignas(64) std::int32_t keys[kLinePixels];
    alignas(64) std::uint32_t words[kLinePixels];
    if (pixels.uses_depth() || colors != nullptr) values.parameters(waiting, t);
    if (pixels.uses_depth()) values.depth.keys(waiting.count, t, keys);
    if (colors != nullptr)
      colors->words(waiting.count, t, words);
    else
      for_pixels(waiting.count, [&](int l) HWY_ATTR { words[l] = word; });
    pixels.store(waiting, keys, words);
  }
};
HWY_INLINE void store_plain(const PlainPixels& pixels, const LineShape& shape, LinePixels& waiting, const LineValues& values, const LineColors* colors, std::uint32_t word) {
  PlainLine line{pixels, values, colors, word, waiting};
  int count = 0;  // not the member: it stays in a register
  shape.for_each([&](int x, int y) HWY_ATTR {
    waiting.x[count] = x;
    waiting.y[count] = y;
    if (++count < kLinePixels) return;
    line.store(count);
    count = 0;
  });
  if (count > 0) line.store(count);
}

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
  const bool one_word = has_words(draw), interpolated = draw.source == ColorSource::interpolated && !draw.deferred && !draw.index[0] && second != 0;
  const bool plain = draw.ops == nullptr && run.samples == 1 && (interpolated || one_word);
  const PlainPixels pixels(run, draw);
  LinePixels waiting;
  for (int i = 0; i < g.count; ++i) {
    const auto shape = shape_of(i);
    const LineValues values(run, i, second, depth_offset_of(run, draw, i));
    const bool back = draw.facing != nullptr && draw.facing[run.memory.source[i]] == Facing::back;
    if (plain) {
      LineColors colors;
      if (!one_word) colors.set_up(run, draw, i, back);
      store_plain(pixels, shape, waiting, values, one_word ? nullptr : &colors, one_word ? triangle_word(run, draw, i, back) : 0);
      continue;
    }
    BlockBits bits{run, run.memory.touched};
    if (run.samples == 1)
      shape.for_each([&](int x, int y) HWY_ATTR { bits.add(x, y, 1); });
    else
      shape.cover(bits);
    draw_covered_blocks(bits, draw_number, i, values, back);
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
