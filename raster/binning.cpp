#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/binning.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>

#include "raster/binning.h"
#include "raster/clipped_triangles.h"
#include "raster/lanes-inl.h"
#include "raster/multi_tile_triangle.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

// A group of triangles as arrays, so that the loops over them vectorize.
inline constexpr int kBinningGroupSize = 16;
struct BinningGroup {
  int count = 0;
  std::uint32_t ids[kBinningGroupSize];
  alignas(64) std::int32_t x[3][kBinningGroupSize], y[3][kBinningGroupSize];
  alignas(64) double area[kBinningGroupSize];
  alignas(64) std::int32_t area_sign[kBinningGroupSize];  // -1, 0 or 1
  // Bounds: first and last pixel whose centre may be covered, inclusive.
  alignas(64) std::int32_t px0[kBinningGroupSize], py0[kBinningGroupSize];
  alignas(64) std::int32_t px1[kBinningGroupSize], py1[kBinningGroupSize];
  alignas(64) std::int32_t passes_culling[kBinningGroupSize];      // 1 or 0
  alignas(64) std::int32_t extent[kBinningGroupSize];              // max(width, height), 1/256 pixel
  alignas(64) std::int32_t tile[kBinningGroupSize];                // tile of the first pixel
  alignas(64) std::int32_t second_tile_offset[kBinningGroupSize];  // to the other tile of kInTwoTiles
  alignas(64) std::int32_t triangle_class[kBinningGroupSize];

  HWY_INLINE void add(const BinDraw& draw, std::uint32_t triangle, std::uint32_t i0, std::uint32_t i1,
                      std::uint32_t i2) {
    const WindowVertex &v0 = draw.vertices[i0], &v1 = draw.vertices[i1], &v2 = draw.vertices[i2];
    x[0][count] = v0.x, y[0][count] = v0.y;
    x[1][count] = v1.x, y[1][count] = v1.y;
    x[2][count] = v2.x, y[2][count] = v2.y;
    ids[count++] = triangle;
  }
  /// Fills the group with 16 consecutive triangles. @pre empty
  HWY_INLINE void fill(const BinDraw& draw, std::uint32_t first) {
#if HWY_TARGET == HWY_SCALAR
    for (std::uint32_t t = first; t < first + kBinningGroupSize; ++t)
      add(draw, t, vertex_index<3>(draw, t, 0), vertex_index<3>(draw, t, 1), vertex_index<3>(draw, t, 2));
#else
    for (int t = 0; t < kBinningGroupSize; ++t) ids[t] = first + static_cast<std::uint32_t>(t);
    const std::uint32_t* const indices =
        draw.indices != nullptr ? draw.indices + std::size_t{first} * 3 : nullptr;
    for (std::uint32_t t = 0; t < kBinningGroupSize; t += 4)
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const WindowVertex* v[4];
        for (std::uint32_t k = 0; k < 4; ++k)
          v[k] = draw.vertices +
                 (indices != nullptr ? indices[3 * (t + k) + corner] : 3 * (first + t + k) + corner);
        store_four(v, x[corner] + t, y[corner] + t);
      }
    count = kBinningGroupSize;
#endif
  }

 private:
#if HWY_TARGET != HWY_SCALAR
  // Transposes four vertices: stores their x and their y.
  static HWY_INLINE void store_four(const WindowVertex* const (&v)[4], std::int32_t* x, std::int32_t* y) {
    constexpr hn::CappedTag<std::int32_t, 4> four;
    constexpr hn::Repartition<std::int64_t, decltype(four)> pairs;
    const auto row = [&](int k) HWY_ATTR { return hn::LoadU(four, &v[k]->x); };
    const auto xy01 = hn::BitCast(pairs, hn::InterleaveLower(four, row(0), row(1)));
    const auto xy23 = hn::BitCast(pairs, hn::InterleaveLower(four, row(2), row(3)));  // x x y y
    hn::StoreU(hn::BitCast(four, hn::InterleaveLower(pairs, xy01, xy23)), four, x);
    hn::StoreU(hn::BitCast(four, hn::InterleaveUpper(pairs, xy01, xy23)), four, y);
  }
#endif
};

// Classification of a triangle: the first condition that holds.
enum TriangleClass : std::int32_t {
  kZeroArea = 1,
  kCulled = 2,
  kOutside = 4,
  kInOneTile = 8,
  kInTwoTiles = 16,
  kInSeveralTiles = 32
};

/// Computes area, bounds and class of each triangle of the group. Tiles are 2^shift pixels wide.
HWY_INLINE void classify_triangles(BinningGroup& g, const BinDraw& draw, int shift, int columns) {
  for (int k = g.count; k < kBinningGroupSize; ++k)
    for (int corner = 0; corner < 3; ++corner) g.x[corner][k] = g.y[corner][k] = 0;
  for (int k = 0; k < kBinningGroupSize; ++k) {
    const double dx1 = g.x[1][k] - g.x[0][k], dy1 = g.y[1][k] - g.y[0][k];
    const double dx2 = g.x[2][k] - g.x[0][k], dy2 = g.y[2][k] - g.y[0][k];
    const double area = dx1 * dy2 - dx2 * dy1;  // exact, see fixed_point.h
    g.area[k] = area;
    g.area_sign[k] = (area > 0 ? 1 : 0) - (area < 0 ? 1 : 0);
  }
  if (draw.facing != nullptr) {
    for (int k = 0; k < g.count; ++k) {
      const bool is_kept = draw.facing[g.ids[k]] == Facing::front ? draw.keep_front : draw.keep_back;
      g.passes_culling[k] = is_kept ? 1 : 0;
    }
  } else {
    const std::int32_t keeps_negative =
        is_front(-1, draw.front_is_clockwise) ? draw.keep_front : draw.keep_back;
    const std::int32_t keeps_positive =
        is_front(1, draw.front_is_clockwise) ? draw.keep_front : draw.keep_back;
    for (int k = 0; k < kBinningGroupSize; ++k)
      g.passes_culling[k] = g.area_sign[k] < 0 ? keeps_negative : keeps_positive;
  }
  const PixelRect rect = draw.rect;  // local copy: possible aliasing would prevent vectorization
  const std::int32_t reach = draw.sample_reach;
  const std::int32_t extent_of_two_tiles = 2 << (shift + kSubpixelBits);
  for (int k = 0; k < kBinningGroupSize; ++k) {
    const std::int32_t low_x = min_of(g.x[0][k], g.x[1][k], g.x[2][k]);
    const std::int32_t high_x = max_of(g.x[0][k], g.x[1][k], g.x[2][k]);
    const std::int32_t low_y = min_of(g.y[0][k], g.y[1][k], g.y[2][k]);
    const std::int32_t high_y = max_of(g.y[0][k], g.y[1][k], g.y[2][k]);
    g.px0[k] = max_of(first_pixel(low_x - reach), rect.x0);
    g.py0[k] = max_of(first_pixel(low_y - reach), rect.y0);
    g.px1[k] = min_of(last_pixel(high_x + reach), rect.x1 - 1);
    g.py1[k] = min_of(last_pixel(high_y + reach), rect.y1 - 1);
    const std::int32_t first_column = g.px0[k] >> shift, first_row = g.py0[k] >> shift;
    g.tile[k] = first_row * columns + first_column;
    const std::int32_t across = (g.px1[k] >> shift) - first_column;
    const std::int32_t down = (g.py1[k] >> shift) - first_row;
    g.second_tile_offset[k] = down == 0 ? 1 : columns;
    g.extent[k] = max_of(high_x - low_x, high_y - low_y);
    // The rectangle may have cut a much larger triangle to two tiles: hence the limit on the extent.
    const std::int32_t multi_tile_class =
        across + down == 1 && g.extent[k] <= extent_of_two_tiles ? kInTwoTiles : kInSeveralTiles;
    const std::int32_t visible_class = across + down == 0 ? kInOneTile : multi_tile_class;
    const std::int32_t kept_class =
        ((g.px0[k] > g.px1[k]) | (g.py0[k] > g.py1[k])) ? kOutside : visible_class;
    const std::int32_t class_with_area = g.passes_culling[k] == 0 ? kCulled : kept_class;
    g.triangle_class[k] = g.area_sign[k] == 0 ? kZeroArea : class_with_area;
  }
}

/// Culls triangles between pixel centres, which are frequent among triangles of a pixel's size. Tests
/// triangles with at most 2x2 centres in their bounds.
HWY_INLINE void cull_between_samples(BinningGroup& g) {
  for (int first = 0; first < kBinningGroupSize; first += kLanes) {
    const auto load = [first](const std::int32_t* array) HWY_ATTR { return hn::Load(kInt, array + first); };
    const Int zero = hn::Zero(kInt);
    const Int px0 = load(g.px0), py0 = load(g.py0);
    const Int triangle_class = load(g.triangle_class);
    const Int max_pixel_extent = hn::Max(hn::Sub(load(g.px1), px0), hn::Sub(load(g.py1), py0));
    // The rectangle may have cut a larger triangle to 2x2 pixels: hence the limit on the extent.
    const auto is_small =
        hn::And(hn::Lt(max_pixel_extent, splat(2)), hn::Lt(load(g.extent), splat(3 * kSubpixelScale)));
    const auto is_candidate = hn::And(is_small, hn::Gt(triangle_class, splat(std::int32_t{kOutside})));
    if (hn::AllFalse(kInt, is_candidate)) continue;
    const auto from_center = [&](const std::int32_t* at, Int pixel) HWY_ATTR {
      return hn::Sub(load(at), hn::Add(hn::ShiftLeft<kSubpixelBits>(pixel), splat(kHalfPixel)));
    };
    const Int x0 = from_center(g.x[0], px0), x1 = from_center(g.x[1], px0), x2 = from_center(g.x[2], px0);
    const Int y0 = from_center(g.y[0], py0), y1 = from_center(g.y[1], py0), y2 = from_center(g.y[2], py0);
    const auto turns_left = hn::Lt(load(g.area_sign), zero);
    const Int x[4] = {x0, hn::IfThenElse(turns_left, x2, x1), hn::IfThenElse(turns_left, x1, x2), x0};
    const Int y[4] = {y0, hn::IfThenElse(turns_left, y2, y1), hn::IfThenElse(turns_left, y1, y2), y0};
    Int outside[4] = {zero, zero, zero, zero};  // per centre: negative if it is outside an edge
    for (int k = 0; k < 3; ++k) {
      const Int a = hn::Sub(y[k], y[k + 1]), b = hn::Sub(x[k + 1], x[k]);
      // Fill rule as in triangle_setup-inl.h: a centre on a left edge (a > 0) or top edge (a = 0, b > 0) is
      // inside; on any other edge the biased value is negative.
      const auto top_left = hn::Gt(hn::Add(hn::ShiftLeft<16>(a), b), zero);
      const Int edge =
          hn::Sub(hn::Not(hn::Add(hn::Mul(a, x[k]), hn::Mul(b, y[k]))), hn::VecFromMask(kInt, top_left));
      const Int right = hn::Add(edge, hn::ShiftLeft<kSubpixelBits>(a));
      const Int down = hn::ShiftLeft<kSubpixelBits>(b);
      outside[0] = hn::Or(outside[0], edge);
      outside[1] = hn::Or(outside[1], right);
      outside[2] = hn::Or(outside[2], hn::Add(edge, down));
      outside[3] = hn::Or(outside[3], hn::Add(right, down));
    }
    const auto is_missed =
        hn::Lt(hn::And(hn::And(outside[0], outside[1]), hn::And(outside[2], outside[3])), zero);
    hn::Store(hn::IfThenElse(hn::And(is_candidate, is_missed), splat(std::int32_t{kOutside}), triangle_class),
              kInt, g.triangle_class + first);
  }
}

HWY_INLINE std::uint32_t class_mask(const BinningGroup& g, TriangleClass triangle_class) {
  std::uint32_t bits = 0;
  for (int k = 0; k < kBinningGroupSize; k += kLanes)
    bits |= mask_bits(kInt,
                      hn::TestBit(hn::Load(kInt, g.triangle_class + k), splat(std::int32_t{triangle_class})))
            << k;
  return bits & low_bits_mask(g.count);
}

/// Write-combining cache of bin entries for the two most recent tiles: consecutive triangles mostly fall into
/// the same tile, or along a border into the same two.
struct BinWriteCache {
  Bins& bins;
  const std::uint32_t draw;
  int tile[2] = {-1, -1};
  std::uint32_t count[2] = {0, 0};
  int last = 0;
  std::uint32_t ids[2][kBinningGroupSize];

  HWY_INLINE BinWriteCache(Bins& target, std::uint32_t draw_number) : bins(target), draw(draw_number) {}
  HWY_INLINE void add(int to_tile, std::uint32_t id) {
    if (tile[last] != to_tile) {
      last ^= 1;
      if (tile[last] != to_tile) {
        flush(last);
        tile[last] = to_tile;
      }
    }
    ids[last][count[last]++] = id;
  }
  HWY_INLINE void flush() {
    flush(0);
    flush(1);
  }

 private:
  HWY_INLINE void flush(int slot) {
    if (count[slot] != 0) bins.push(tile[slot], draw, std::span(ids[slot], count[slot]));
    count[slot] = 0;
  }
};

HWY_NOINLINE void bin_group(Bins& bins, const TileGrid& grid, const BinDraw& draw, BinningGroup& g) {
  if (g.count == 0) return;
  const int shift = std::countr_zero(static_cast<unsigned>(grid.tile_size));
  const int columns = grid.columns();
  classify_triangles(g, draw, shift, columns);
  if (draw.sample_reach == 0) cull_between_samples(g);
  const std::uint32_t in_one = class_mask(g, kInOneTile);
  const std::uint32_t in_two = class_mask(g, kInTwoTiles);
  const std::uint32_t in_few = in_one | in_two;
  const std::uint32_t binned = in_few | class_mask(g, kInSeveralTiles);
  BinCounts& counts = bins.counts;
  const auto count_of = [](std::uint32_t bits) { return static_cast<std::uint32_t>(std::popcount(bits)); };
  counts.zero_area += count_of(class_mask(g, kZeroArea));
  counts.culled += count_of(class_mask(g, kCulled));
  counts.outside += count_of(class_mask(g, kOutside));
  counts.binned += count_of(binned);
  BinWriteCache cache(bins, draw.draw);
  for (std::uint32_t left = binned; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    if ((in_few >> k & 1) != 0) {
      cache.add(g.tile[k], g.ids[k]);
      if ((in_two >> k & 1) != 0) cache.add(g.tile[k] + g.second_tile_offset[k], g.ids[k]);
      continue;
    }
    cache.flush();
    const WindowVertex* const v[3] = {&draw.vertices[vertex_index<3>(draw, g.ids[k], 0)],
                                      &draw.vertices[vertex_index<3>(draw, g.ids[k], 1)],
                                      &draw.vertices[vertex_index<3>(draw, g.ids[k], 2)]};
    bin_multi_tile_triangle(bins, grid, v, g.area[k], draw, g.ids[k], g.px0[k] >> shift, g.py0[k] >> shift,
                            g.px1[k] >> shift, g.py1[k] >> shift);
  }
  cache.flush();
  g.count = 0;
}

/// Treatment of a triangle with outcodes or of a dropped polygon.
enum class ClipDecision { unusable, outside, clipped };
HWY_INLINE ClipDecision clip_decision(const BinDraw& draw, std::uint32_t triangle, std::uint8_t c0,
                                      std::uint8_t c1, std::uint8_t c2) {
  if (((c0 | c1 | c2) & kNonFinite) != 0 ||
      (draw.facing != nullptr && draw.facing[triangle] == Facing::dropped))
    return ClipDecision::unusable;
  return (c0 & c1 & c2) != 0 ? ClipDecision::outside : ClipDecision::clipped;
}

void bin_triangles_lanes(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                         std::uint32_t last) {
  BinCounts& counts = bins.counts;
  counts.triangles_in += last - first;
  BinningGroup group;
  std::uint32_t triangle = first;
  if (!draw.any_outcode)
    for (; triangle + kBinningGroupSize <= last; triangle += kBinningGroupSize) {
      group.fill(draw, triangle);
      bin_group(bins, grid, draw, group);
    }
  for (; triangle < last; ++triangle) {
    const std::uint32_t i0 = vertex_index<3>(draw, triangle, 0);
    const std::uint32_t i1 = vertex_index<3>(draw, triangle, 1);
    const std::uint32_t i2 = vertex_index<3>(draw, triangle, 2);
    if (draw.any_outcode) {
      const std::uint8_t c0 = draw.outcodes[i0], c1 = draw.outcodes[i1], c2 = draw.outcodes[i2];
      const bool is_dropped = draw.facing != nullptr && draw.facing[triangle] == Facing::dropped;
      if ((c0 | c1 | c2) != 0 || is_dropped) {
        switch (clip_decision(draw, triangle, c0, c1, c2)) {
          case ClipDecision::unusable: ++counts.non_finite; break;
          case ClipDecision::outside: ++counts.outside; break;
          case ClipDecision::clipped:
            bin_group(bins, grid, draw, group);  // keep submission order within a tile
            ++counts.clipped;
            bin_clipped_triangle(bins, grid, draw, triangle, c0 | c1 | c2);
            break;
        }
        continue;
      }
    }
    group.add(draw, triangle, i0, i1, i2);
    if (group.count == kBinningGroupSize) bin_group(bins, grid, draw, group);
  }
  bin_group(bins, grid, draw, group);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

void bin_triangles(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                   std::uint32_t last, InstructionSet isa) {
  TESSERA_KERNEL(isa, bin_triangles_lanes)(bins, grid, draw, first, last);
}

void bin_pixels(Bins& bins, const TileGrid& grid, std::uint32_t draw, const PixelRect& rect) {
  for (int ty = rect.y0 / grid.tile_size; ty <= (rect.y1 - 1) / grid.tile_size; ++ty)
    for (int tx = rect.x0 / grid.tile_size; tx <= (rect.x1 - 1) / grid.tile_size; ++tx)
      bins.push_draw(ty * grid.columns() + tx, draw);
}

}  // namespace tessera::detail
#endif
