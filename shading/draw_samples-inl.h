// Draws without operations where pixels have several samples: what a sample sees of a triangle is what the pixel's centre sees of
// the triangle moved the other way (raster/sample_positions.h).
#if defined(TESSERA_SHADING_DRAW_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#undef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#endif

#include "raster/sample_positions.h"
#include "shading/deferred_samples-inl.h"
#include "shading/draw_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

HWY_INLINE void move_group(TriangleGroup& g, std::int32_t x, std::int32_t y) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < kGroupSize; ++i) {
      g.x[k][i] += x;
      g.y[k][i] += y;
    }
}

/// Triangle i of a group that stands where its vertices are: what its pixels' centres see, inside of it or not.
inline HWY_NOINLINE void fill_centered_triangle(ShadedTriangle& triangle, TileRun& run, std::uint32_t draw_number, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  fill_shaded_triangle(triangle, run, draw_number, i, back);
  if (g.wide[i] == 0) return;
  TileEdges edges;
  WideEdges wide;
  tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide);
  keep_wide_edges(triangle, run.memory, wide);
}

/// One narrow triangle's way through the blocks of a tile, at all samples of a pixel.
template <int kSamples, class Depth, Test kTest, Seen kSeen>
struct SampledTrianglePixels {
  TileRun& run;
  const TileDraw& draw;
  Depth depth;
  typename Depth::Anchor anchors[kSamples];
  TileEdges edges;               // those that the blocks are found by: of a sample, or of none, but never below any sample's
  Int moved[kSamples][3];        // what a sample's edges are less than those
  std::int32_t to_lowest[3];     // from those at a block's first pixel to the lowest of any sample in it
  std::int32_t *stored_depth[kSamples], *stored[kSamples];  // of the sample: depth; the words or triangles' numbers that it writes
  Int value;                     // the word, or the triangle's number
  Int writable, depth_writable;
  Int seen = hn::Zero(kInt);     // collect_sample: -1 where a pixel passed; word: minus the number of those that passed at the first sample

  HWY_INLINE SampledTrianglePixels(TileRun& tile_run, const TileDraw& tile_draw, int i, std::uint32_t new_value)
      : run(tile_run), draw(tile_draw), edges(tile_edges(tile_run.memory.group, i)), value(splat(static_cast<std::int32_t>(new_value))),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))), depth_writable(splat(tile_draw.depth_write ? -1 : 0)) {
    const TriangleGroup& g = run.memory.group;
    const SampleGroup& samples = run.memory.samples->narrow;
    for (int k = 0; k < 3; ++k) {
      std::int32_t highest = samples.e[0][k][i], lowest = highest;
      for (int s = 1; s < kSamples; ++s) {
        highest = std::max(highest, samples.e[s][k][i]);
        lowest = std::min(lowest, samples.e[s][k][i]);
      }
      for (int s = 0; s < kSamples; ++s) moved[s][k] = splat(samples.e[s][k][i] - highest);
      edges.e[k] = highest;
      to_lowest[k] = lowest - highest + 3 * (std::min(edges.a[k], 0) + std::min(edges.b[k], 0));
    }
    if constexpr (kHasDepth<Depth>) {
      depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
      depth.prepare_blocks();
    }
    for (int s = 0; s < kSamples; ++s) {
      stored_depth[s] = run.sample[s].depth;
      stored[s] = reinterpret_cast<std::int32_t*>(kSeen == Seen::word ? run.sample[s].color : run.sample[s].ids);
    }
    for (int s = 0; s < kSamples; ++s) anchors[s] = Depth::anchor(g, samples, s, i, sample_positions(kSamples)[s], run.tile_x, run.tile_y);
  }

  /// All pixels of the block are inside at all samples.
  HWY_INLINE bool holds_block(int bx, int by) const {
    const auto lowest = [&](int k) { return edges.e[k] + edges.a[k] * bx + edges.b[k] * by + to_lowest[k]; };
    return (lowest(0) | lowest(1) | lowest(2)) >= 0;
  }

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& block_edges) {
    if (kFull && !run.cut && holds_block(bx, by))
      draw_block<true>(bx, by, block_edges);
    else
      draw_block<false>(bx, by, block_edges);
  }

  template <bool kInside>
  HWY_INLINE void draw_block(int bx, int by, const BlockEdges& block_edges) {
    const int block = run.block_index(bx, by);
    for (int s = 0; s < kSamples; ++s) {
      depth.move_to(anchors[s]);
      const auto block_depth = depth.block(bx, by);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        const int index = block + chunk * kLanes;
        auto mask = hn::Eq(hn::Zero(kInt), hn::Zero(kInt));
        if constexpr (!kInside) {
          const auto edge = [&](int k) HWY_ATTR { return hn::Add(block_edges.at(k, chunk), moved[s][k]); };
          mask = hn::Gt(hn::Or(hn::Or(edge(0), edge(1)), edge(2)), splat(-1));
          if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
        }
        if constexpr (kHasDepth<Depth>) {
          std::int32_t* const at = stored_depth[s] + index;
          const Int before = hn::Load(kInt, at), key = depth.keys(block_depth, chunk);
          mask = hn::And(mask, kTest == Test::less ? hn::Lt(key, before) : comparing(key, draw.depth_test, before));
          hn::Store(hn::IfThenElse(hn::And(mask, hn::MaskFromVec(depth_writable)), key, before), kInt, at);
        }
        if constexpr (kSeen == Seen::collect_sample) seen = hn::Or(seen, hn::VecFromMask(kInt, mask));
        if (kSeen == Seen::word && s == 0) seen = hn::Add(seen, hn::VecFromMask(kInt, mask));
        if constexpr (kSeen == Seen::word) store_words(reinterpret_cast<std::uint32_t*>(stored[s]) + index, value, mask, writable);
        if constexpr (kSeen == Seen::collect_sample) {
          std::int32_t* const at = stored[s] + index;
          hn::Store(hn::IfThenElse(mask, value, hn::Load(kInt, at)), kInt, at);
        }
      }
    }
  }
};

/// A group without wide triangles: one walk through the blocks of a triangle for all samples. @pre set up, with the samples' reach
template <int kSamples, class Depth, Test kTest, Seen kSeen>
HWY_INLINE void draw_narrow_samples(TileRun& run, std::uint32_t draw_number) {
  const TriangleGroup& g = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_samples(g, run.memory.samples->narrow, kSamples, kHasDepth<Depth> ? run.frame.depth_kind : DepthKind::none, run.tile_x, run.tile_y);
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    std::uint32_t value = 0;
    if constexpr (kSeen == Seen::word) value = triangle_word(run, draw, i, !is_front(g.signed_area[i], draw.front_is_clockwise));
    if constexpr (kSeen == Seen::collect_sample) value = static_cast<std::uint32_t>(run.memory.triangles.size()) - static_cast<std::uint32_t>(g.count - i);
    SampledTrianglePixels<kSamples, Depth, kTest, kSeen> pixels(run, draw, i, value);
    const BlockOffsets offsets(pixels.edges);
    for_each_block(pixels.edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
    if constexpr (kSeen == Seen::collect_sample) run.any_seen |= !hn::AllTrue(kInt, hn::Eq(pixels.seen, hn::Zero(kInt)));
    if constexpr (kSeen == Seen::word) run.counts.shaded_pixels += count_of(pixels.seen);
  }
}

/// Any group: each sample goes the way of a tile with one, over the group moved the other way.
template <class Depth, Test kTest, Seen kSeen>
HWY_INLINE void draw_moved_samples(TileRun& run, std::uint32_t draw_number) {
  const SamplePosition* const positions = sample_positions(run.samples);
  SamplePosition moved{0, 0};
  for (int s = 0; s < run.samples; ++s) {
    move_group(run.memory.group, moved.x - positions[s].x, moved.y - positions[s].y);
    moved = positions[s];
    run.pixels = run.sample[s];
    const std::uint64_t shaded = run.counts.shaded_pixels;
    draw_group<Depth, kTest, kSeen>(run, draw_number);
    if (s > 0) run.counts.shaded_pixels = shaded;  // one colour for all samples
  }
}

template <class Depth, Test kTest, Seen kSeen>
void draw_group_samples(TileRun& run, std::uint32_t draw_number) {
  TileWorkspace::Memory& memory = run.memory;
  TriangleGroup& g = memory.group;
  set_up_edges(g, run.tile_x, run.tile_y, run.rect, sample_reach(run.samples));
  if (g.mask == 0) return;
  if constexpr (kHasDepth<Depth>) set_up_depth(g, run.frame.depth_kind, run.tile_x, run.tile_y);
  bool any_wide = false;
  for (int i = 0; i < g.count; ++i) any_wide |= g.wide[i] != 0;
  const std::size_t triangles = memory.triangles.size(), wide = memory.wide.size();
  if constexpr (kSeen == Seen::collect_sample) {
    set_up_weights(g);
    memory.triangles.resize(triangles + static_cast<std::size_t>(g.count));
    for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      fill_centered_triangle(memory.triangles[triangles + static_cast<std::size_t>(i)], run, draw_number, i, !is_front(g.signed_area[i], run.frame.draws[draw_number].front_is_clockwise));
    }
  }
  run.any_seen = false;
  if (any_wide)
    draw_moved_samples<Depth, kTest, kSeen>(run, draw_number);
  else if (run.samples == 4)
    draw_narrow_samples<4, Depth, kTest, kSeen>(run, draw_number);
  else
    draw_narrow_samples<8, Depth, kTest, kSeen>(run, draw_number);
  if constexpr (kSeen == Seen::collect_sample) {
    if (!run.any_seen) {
      memory.triangles.resize(triangles);
      memory.wide.resize(wide);
    } else if (run.frame.shade_at_once) {
      shade_whole_tile(run);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
