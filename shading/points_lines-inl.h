// Points and lines in a tile. Few of their pixels lie in one block: each is covered, and has its depth, by
// itself. Plain colours are stored as they come; all others go block by block through what fragments of
// triangles go through.
#if defined(TESSERA_SHADING_POINTS_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_POINTS_LINES_INL_H_
#undef TESSERA_SHADING_POINTS_LINES_INL_H_
#else
#define TESSERA_SHADING_POINTS_LINES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/line_steps-inl.h"
#include "raster/point_line_coverage.h"
#include "shading/draw_fragments-inl.h"
#include "shading/point_line_values-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// The centre of a pixel of the tile.
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

/// Of edges and corners of polygons.
HWY_INLINE double depth_offset_of(const TileContext& context, const TileDraw& draw, int i) {
  return draw.depth_offsets != nullptr ? draw.depth_offsets[context.memory.source[i]] : 0.0;
}

/// As shading sees it: weights from exact "edges", as those of a wide triangle whose third vertex has none.
HWY_INLINE void fill_shaded_point_or_line(ShadedTriangle& t, TileContext& context, std::uint32_t draw, int i,
                                          bool back) {
  const TriangleGroup& g = context.memory.group;
  const bool is_line = context.frame.draws[draw].topology == Topology::lines;
  const int second = is_line ? 1 : 0;
  const double dx = g.x[second][i] - g.x[0][i], dy = g.y[second][i] - g.y[0][i],
               squared_length = dx * dx + dy * dy;
  const LinePoint first = center_of(context, 0, 0);
  Edges64 wide{};
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
    t.attributes[k] = context.memory.attributes[vertex][i];
  }
  t.edges = {};
  t.back = back;
  t.draw = draw;
  store_edges64(t, context.memory, wide);
}

/// Blocks with bits of the pixels that are covered, in each sample.
struct BlockCoverage {
  TileContext& context;
  TouchedBlocks& blocks;

  HWY_INLINE void add(int x, int y, std::uint32_t samples) {
    const int block = context.block_index(x, y) / kBlockPixels;
    if (blocks.samples[block] == 0) blocks.list[blocks.count++] = static_cast<std::uint16_t>(block);
    blocks.samples[block] |= samples;
    const std::uint32_t bit = 1u << ((y & 3) * 4 + (x & 3));
    for (std::uint32_t left = samples; left != 0; left &= left - 1)
      blocks.bits[std::countr_zero(left)][block] |= static_cast<std::uint16_t>(bit);
  }

  /// Runs them through `fragments`, and forgets them.
  HWY_INLINE void draw(FragmentTriangle& fragments, const LineValues& values) {
    const int columns = context.tile_size >> 2;
    for (int n = 0; n < blocks.count; ++n) {
      const int block = blocks.list[n], bx = block % columns * 4, by = block / columns * 4;
      BlockFragments covered[kMaxSamples];
      for (int s = 0; s < context.samples; ++s) {
        const std::uint32_t bits = blocks.bits[s][block];
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
          covered[s].covered[chunk] = hn::VecFromMask(kInt, mask_from_bits(chunk_bits(bits, chunk)));
          covered[s].keys[chunk] = hn::Zero(kInt);
        }
        if (fragments.has_depth)
          block_keys(bx, by, context.samples > 1 ? sample_positions(context.samples)[s] : SamplePosition{},
                     values, covered[s].keys);
        blocks.bits[s][block] = 0;
      }
      blocks.samples[block] = 0;
      fragments(bx, by, covered);
    }
    blocks.count = 0;
  }

 private:
  HWY_INLINE void block_keys(int bx, int by, SamplePosition position, const LineValues& values,
                             Int (&keys)[kChunksPerBlock]) const {
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      keys[chunk] = values.depth.keys(values.parameters(hn::Add(splat(bx), block_columns(chunk)),
                                                        hn::Add(splat(by), block_rows(chunk)), position));
  }
};

/// The samples of `shape` in the pixels of a rectangle.
template <class Shape>
HWY_INLINE void cover_samples(BlockCoverage& bits, const Shape& shape, const PixelRect& pixels) {
  const TileContext& context = bits.context;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const LinePoint center = center_of(context, x, y);
      std::uint32_t samples = 0;
      for (int s = 0; s < context.samples; ++s)
        samples |= shape.covers(moved(center, sample_positions(context.samples)[s])) ? 1u << s : 0u;
      if (samples != 0) bits.add(x, y, samples);
    }
}

struct PointShape {
  const TileContext& context;
  LinePoint at;
  float size;

  /// Calls pixel(x, y) for each, of one sample.
  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    const PixelRect square = in_tile(context, point_square(at, rounded_size(size)));
    for (int y = square.y0; y < square.y1; ++y)
      for (int x = square.x0; x < square.x1; ++x) pixel(x, y);
  }
  HWY_INLINE void cover(BlockCoverage& bits) const {
    const PointDisc disc(at, snapped_size(size));
    const std::int32_t reach = disc.reach() + kHalfPixel;
    cover_samples(bits, disc, in_tile(context, pixels_near(at, at, reach)));
  }
};

struct LineShape {
  const TileContext& context;
  const LineSteps& steps;  // of the group
  int i;                   // of the line
  float width;

  /// Calls pixels(x, y, inside), of one sample.
  template <class Pixels>
  HWY_INLINE void for_each_vector(const Pixels& pixels) const {
    const PixelRect& r = context.rect;
    steps.for_each(
        i, {r.x0 + context.tile_x, r.y0 + context.tile_y, r.x1 + context.tile_x, r.y1 + context.tile_y},
        [&](Int x, Int y, LaneMask inside) HWY_ATTR {
          pixels(hn::Sub(x, splat(context.tile_x)), hn::Sub(y, splat(context.tile_y)), inside);
        });
  }
  template <class Pixel>
  HWY_INLINE void for_each(const Pixel& pixel) const {
    for_each_vector([&](Int x, Int y, LaneMask inside) HWY_ATTR {
      alignas(64) std::int32_t columns[kLanes], rows[kLanes];
      hn::Store(x, kInt, columns);
      hn::Store(y, kInt, rows);
      for (std::uint32_t left = mask_bits(kInt, inside); left != 0; left &= left - 1)
        pixel(columns[std::countr_zero(left)], rows[std::countr_zero(left)]);
    });
  }
  HWY_INLINE void cover(BlockCoverage& bits) const {
    const LinePoint a = vertex_of(context.memory.group, i, 0), b = vertex_of(context.memory.group, i, 1);
    const LineRectangle rectangle(a, b, snapped_size(width));
    const PixelRect pixels = in_tile(context, pixels_near(a, b, line_reach(width, context.samples)));
    for (int by = pixels.y0 & ~3; by < pixels.y1; by += 4)
      for (int bx = pixels.x0 & ~3; bx < pixels.x1; bx += 4) {
        const LinePoint center{(context.tile_x + bx + 2) * kSubpixelScale,
                               (context.tile_y + by + 2) * kSubpixelScale};
        if (rectangle.may_touch(center, 2 * kSubpixelScale))
          cover_samples(bits, rectangle, intersect(pixels, {bx, by, bx + 4, by + 4}));
      }
  }
};

/// Words that are just stored, where that is all there is to do.
class PackedPixelWriter {
 public:
  HWY_INLINE PackedPixelWriter(TileContext& context, const TileDraw& draw)
      : context_(context), draw_(draw), uses_depth_(draw.path.uses_depth()) {}

  HWY_INLINE bool uses_depth() const { return uses_depth_; }
  HWY_INLINE void store_one(int x, int y, std::int32_t key, std::uint32_t packed_color) const {
    const int index = context_.pixel_index(x, y);
    if (uses_depth_) {
      std::int32_t& stored = context_.memory.depth[index];
      if (!compares(key, draw_.depth_test, stored)) return;
      if (draw_.depth_write) stored = key;
    }
    std::uint32_t& color = context_.color[index];
    color ^= (color ^ packed_color) & draw_.write_mask;
    ++context_.counts.shaded_pixels;
  }
  /// Pixels none of which is there twice; of those that are not `inside` nothing is seen. Neither that nor
  /// whether a depth passes could be foretold: nothing branches on it.
  HWY_INLINE void store(Int x, Int y, LaneMask inside, Int keys, Int packed) const {
    const Int index = hn::IfThenElse(inside, context_.pixel_indices(x, y), splat(kDiscardPixel));
    Int passed = hn::VecFromMask(kInt, inside);
    if (uses_depth_)
      passed = hn::And(
          passed,
          hn::VecFromMask(
              kInt, compare_lanes(
                        keys, draw_.depth_test,
                        load_words(reinterpret_cast<const std::uint32_t*>(context_.memory.depth), index))));
    const auto stays = hn::MaskFromVec(passed);
    if (draw_.write_mask != 0xffffffffu) {
      const Int stored = load_words(context_.color, index);
      packed = hn::Xor(stored,
                       hn::And(hn::Xor(stored, packed), splat(static_cast<std::int32_t>(draw_.write_mask))));
    }
    alignas(64) std::int32_t at[kLanes], key[kLanes], packed_color[kLanes];
    hn::Store(hn::IfThenElse(stays, index, splat(kDiscardPixel)), kInt, at);
    hn::Store(keys, kInt, key);
    hn::Store(packed, kInt, packed_color);
    if (uses_depth_ && draw_.depth_write)
      for (int l = 0; l < kLanes; ++l) context_.memory.depth[at[l]] = key[l];
    for (int l = 0; l < kLanes; ++l) context_.color[at[l]] = static_cast<std::uint32_t>(packed_color[l]);
    context_.counts.shaded_pixels += hn::CountTrue(kInt, stays);
  }

 private:
  TileContext& context_;
  const TileDraw& draw_;
  bool uses_depth_;
};

/// Element i of a plain draw of points, each of one packed color.
HWY_INLINE void write_packed(const PackedPixelWriter& pixels, const TileContext& context,
                             const TileDraw& draw, int i, const PointShape& point, bool back) {
  const std::int32_t key = pixels.uses_depth()
                               ? point_key(context.frame.depth_format, context.memory.group.z[0][i],
                                           depth_offset_of(context, draw, i))
                               : 0;
  const std::uint32_t packed_color = packed_color_of(context, draw, i, back);
  point.for_each([&](int x, int y) HWY_ATTR { pixels.store_one(x, y, key, packed_color); });
}

/// And of lines, of one packed color or with colors along them.
HWY_INLINE void write_packed(const PackedPixelWriter& pixels, const TileContext& context,
                             const TileDraw& draw, int i, const LineShape& line, bool back) {
  const LineValues values(context, i, 1, depth_offset_of(context, draw, i));
  const bool is_packed = draw.path.color_write == ColorWrite::constant;
  LineColorEval colors;
  if (!is_packed) colors.set_up(context, draw, i, back);
  const Int packed_color =
      splat(static_cast<std::int32_t>(is_packed ? packed_color_of(context, draw, i, back) : 0));
  line.for_each_vector([&](Int x, Int y, LaneMask inside) HWY_ATTR {
    Doubles t{};
    if (pixels.uses_depth() || !is_packed) t = values.parameters(x, y);
    pixels.store(x, y, inside, pixels.uses_depth() ? values.depth.keys(t) : hn::Zero(kInt),
                 is_packed ? packed_color : colors.packed(t));
  });
}

/// The blocks in which element i of the group covers pixels, as bits, go through what fragments of triangles
/// go through.
inline HWY_NOINLINE void draw_covered_blocks(BlockCoverage& bits, std::uint32_t draw_number, int i,
                                             const LineValues& values, bool back) {
  TileContext& context = bits.context;
  if (bits.blocks.count == 0) return;
  ShadedTriangle shaded;
  fill_shaded_point_or_line(shaded, context, draw_number, i, back);
  draw_fragments_of(context, draw_number, i, shaded,
                    [&](FragmentTriangle& fragments) HWY_ATTR { bits.draw(fragments, values); });
}

HWY_INLINE bool is_back_element(const TileContext& context, const TileDraw& draw, int i) {
  return draw.facing != nullptr && draw.facing[context.memory.source[i]] == Facing::back;
}

/// Stores the pixels of a group, without any other step.
/// @param shape_of  shape_of(i): the shape of element i
template <class ShapeOf>
HWY_INLINE void store_elements(TileContext& context, std::uint32_t draw_number, const ShapeOf& shape_of) {
  const TileDraw& draw = context.frame.draws[draw_number];
  const PackedPixelWriter pixels(context, draw);
  for (int i = 0; i < context.memory.group.count; ++i)
    write_packed(pixels, context, draw, i, shape_of(i), is_back_element(context, draw, i));
}

/// Draws the fragments of a group, block by block.
/// @param second    see LineValues
/// @param shape_of  shape_of(i): the shape of element i
template <class ShapeOf>
HWY_INLINE void draw_element_fragments(TileContext& context, std::uint32_t draw_number, int second,
                                       const ShapeOf& shape_of) {
  const TileDraw& draw = context.frame.draws[draw_number];
  for (int i = 0; i < context.memory.group.count; ++i) {
    const auto shape = shape_of(i);
    BlockCoverage bits{context, context.memory.touched};
    if (context.samples == 1) shape.for_each([&](int x, int y) HWY_ATTR { bits.add(x, y, 1); });
    else shape.cover(bits);
    draw_covered_blocks(bits, draw_number, i,
                        LineValues(context, i, second, depth_offset_of(context, draw, i)),
                        is_back_element(context, draw, i));
  }
}

struct PointShapes {
  const TileContext& context;
  float size;

  HWY_INLINE PointShapes(const TileContext& tile_context, const TileDraw& draw)
      : context(tile_context), size(draw.size) {}
  HWY_INLINE PointShape operator()(int i) const {
    return {context, vertex_of(context.memory.group, i, 0), size};
  }
};
struct LineShapes {
  const TileContext& context;
  float width;
  LineSteps steps;  // of the group; with one sample

  HWY_INLINE LineShapes(const TileContext& tile_context, const TileDraw& draw)
      : context(tile_context), width(draw.size) {
    if (context.samples == 1) steps.set_up(context.memory.group, rounded_size(width));
  }
  HWY_INLINE LineShape operator()(int i) const { return {context, steps, i, width}; }
};

inline void draw_points(TileContext& context, std::uint32_t draw_number) {
  store_elements(context, draw_number, PointShapes(context, context.frame.draws[draw_number]));
}
inline void draw_lines(TileContext& context, std::uint32_t draw_number) {
  store_elements(context, draw_number, LineShapes(context, context.frame.draws[draw_number]));
}
inline void draw_point_fragments(TileContext& context, std::uint32_t draw_number) {
  draw_element_fragments(context, draw_number, 0, PointShapes(context, context.frame.draws[draw_number]));
}
inline void draw_line_fragments(TileContext& context, std::uint32_t draw_number) {
  draw_element_fragments(context, draw_number, 1, LineShapes(context, context.frame.draws[draw_number]));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
