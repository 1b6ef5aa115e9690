// Points and lines in a tile. Few of their pixels share a block, so coverage and depth are evaluated per
// pixel. Plain colours are stored immediately; all others go through FragmentTriangle, block by block.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_points_lines.cpp"
#include "framebuffer/lanes.h"

#include <cmath>

#include "shading/color_eval-inl.h"
#include "shading/draw_functions-inl.h"
#include "shading/point_line_shapes-inl.h"
#include "shading/visible_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Depth offset of element i, an edge or a corner of a polygon; 0 for other elements.
HWY_INLINE double depth_offset_of(const TileContext& context, const TileDraw& draw, int i) {
  return draw.depth_offsets != nullptr ? draw.depth_offsets[context.memory.source[i]] : 0.0;
}

/// Fills the record for shading like that of a wide triangle whose third vertex has no weight: edges 0 and 1,
/// which are exact, are the weights of the two ends.
HWY_INLINE void fill_shaded_point_or_line(ShadedTriangle& t, TileContext& context, std::uint32_t draw, int i,
                                          bool back) {
  const TriangleGroup& g = context.memory.group;
  const bool is_line = context.frame.draws[draw].topology == Topology::lines;
  const int second = is_line ? 1 : 0;
  const double dx = g.x[second][i] - g.x[0][i];
  const double dy = g.y[second][i] - g.y[0][i];
  const double squared_length = dx * dx + dy * dy;
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

/// Stores packed colours under the depth test and the write mask.
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
  /// Stores one vector of distinct pixels. Lanes that are not `inside` or fail the depth test are written to
  /// kDiscardPixel: a branch on them would be mispredicted.
  HWY_INLINE void store(Int x, Int y, LaneMask inside, Int keys, Int packed) const {
    const Int index = hn::IfThenElse(inside, context_.pixel_indices(x, y), splat(kDiscardPixel));
    Int passed_lanes = hn::VecFromMask(kInt, inside);
    if (uses_depth_) {
      const Int stored = load_words(reinterpret_cast<const std::uint32_t*>(context_.memory.depth), index);
      passed_lanes =
          hn::And(passed_lanes, hn::VecFromMask(kInt, compare_lanes(keys, draw_.depth_test, stored)));
    }
    const auto passed = hn::MaskFromVec(passed_lanes);
    if (draw_.write_mask != 0xffffffffu) {
      const Int stored = load_words(context_.color, index);
      const Int changed =
          hn::And(hn::Xor(stored, packed), splat(static_cast<std::int32_t>(draw_.write_mask)));
      packed = hn::Xor(stored, changed);
    }
    alignas(64) std::int32_t at[kLanes];
    alignas(64) std::int32_t key[kLanes];
    alignas(64) std::int32_t packed_color[kLanes];
    hn::Store(hn::IfThenElse(passed, index, splat(kDiscardPixel)), kInt, at);
    hn::Store(keys, kInt, key);
    hn::Store(packed, kInt, packed_color);
    if (uses_depth_ && draw_.depth_write)
      for (int l = 0; l < kLanes; ++l) context_.memory.depth[at[l]] = key[l];
    for (int l = 0; l < kLanes; ++l) context_.color[at[l]] = static_cast<std::uint32_t>(packed_color[l]);
    context_.counts.shaded_pixels += hn::CountTrue(kInt, passed);
  }

 private:
  TileContext& context_;
  const TileDraw& draw_;
  bool uses_depth_;
};

/// Stores a point of one packed colour.
HWY_INLINE void write_packed(const PackedPixelWriter& pixels, const TileContext& context,
                             const TileDraw& draw, int i, const PointShape& point, bool back) {
  std::int32_t key = 0;
  if (pixels.uses_depth())
    key = point_key(context.frame.depth_format, context.memory.group.z[0][i],
                    depth_offset_of(context, draw, i));
  const std::uint32_t packed_color = packed_color_of(context, draw, i, back);
  point.for_each([&](int x, int y) HWY_ATTR { pixels.store_one(x, y, key, packed_color); });
}

/// Stores a line of one packed colour, or with colours interpolated along it.
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

/// Draws the fragments of the blocks that element i of the group covers.
inline HWY_NOINLINE void draw_covered_blocks(BlockCoverage& coverage, std::uint32_t draw_number, int i,
                                             const LineValues& values, bool back) {
  TileContext& context = coverage.context;
  if (coverage.blocks.count == 0) return;
  ShadedTriangle shaded;
  fill_shaded_point_or_line(shaded, context, draw_number, i, back);
  draw_fragments_of(context, i, shaded,
                    [&](FragmentTriangle& fragments) HWY_ATTR { coverage.draw(fragments, values); });
}

HWY_INLINE bool is_back_element(const TileContext& context, const TileDraw& draw, int i) {
  return draw.facing != nullptr && draw.facing[context.memory.source[i]] == Facing::back;
}

/// Stores the pixels of a group immediately.
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
    BlockCoverage coverage{context, context.memory.touched};
    if (context.samples == 1) shape.for_each([&](int x, int y) HWY_ATTR { coverage.add(x, y, 1); });
    else shape.cover(coverage);
    draw_covered_blocks(coverage, draw_number, i,
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
  LineSteps steps;  // steps of the group; set up only for frames with one sample

  HWY_INLINE LineShapes(const TileContext& tile_context, const TileDraw& draw)
      : context(tile_context), width(draw.size) {
    if (context.samples == 1) steps.set_up(context.memory.group, rounded_size(width));
  }
  HWY_INLINE LineShape operator()(int i) const { return {context, steps, i, width}; }
};

void draw_points(TileContext& context, std::uint32_t draw_number) {
  store_elements(context, draw_number, PointShapes(context, context.frame.draws[draw_number]));
}
void draw_lines(TileContext& context, std::uint32_t draw_number) {
  store_elements(context, draw_number, LineShapes(context, context.frame.draws[draw_number]));
}
void draw_point_fragments(TileContext& context, std::uint32_t draw_number) {
  draw_element_fragments(context, draw_number, 0, PointShapes(context, context.frame.draws[draw_number]));
}
void draw_line_fragments(TileContext& context, std::uint32_t draw_number) {
  draw_element_fragments(context, draw_number, 1, LineShapes(context, context.frame.draws[draw_number]));
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
