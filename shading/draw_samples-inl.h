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
template <class Depth, Test kTest, Seen kSeen>
struct SampledTrianglePixels {
  TileRun& run;
  const TileDraw& draw;
  Depth depth;
  typename Depth::Anchor anchors[kMaxSamples];
  Int moved[kMaxSamples][3];  // edges of a sample minus those that the blocks are found by, which none exceeds
  Int value;                  // the word, or the triangle's number
  Int writable, depth_writable;
  Int seen = hn::Zero(kInt);  // -1 where a pixel passed

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    const int block = run.block_index(bx, by);
    for (int s = 0; s < run.samples; ++s) {
      const TilePixels& pixels = run.sample[s];
      depth.move_to(anchors[s]);
      const auto block_depth = depth.block(bx, by);
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
        const int index = block + chunk * kLanes;
        const Int outside = hn::Or(hn::Or(hn::Add(edges.at(0, chunk), moved[s][0]), hn::Add(edges.at(1, chunk), moved[s][1])), hn::Add(edges.at(2, chunk), moved[s][2]));
        auto mask = hn::Gt(outside, splat(-1));
        if (run.cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
        if constexpr (kHasDepth<Depth>) {
          std::int32_t* stored_at = pixels.depth + index;
          const Int stored = hn::Load(kInt, stored_at), key = depth.keys(block_depth, chunk);
          mask = hn::And(mask, kTest == Test::less ? hn::Lt(key, stored) : comparing(key, draw.depth_test, stored));
          hn::Store(hn::IfThenElse(hn::And(mask, hn::MaskFromVec(depth_writable)), key, stored), kInt, stored_at);
        }
        if constexpr (kSeen != Seen::nothing) seen = hn::Or(seen, hn::VecFromMask(kInt, mask));
        if constexpr (kSeen == Seen::word) store_words(pixels.color + index, value, mask, writable);
        if constexpr (kSeen == Seen::collect_sample) {
          auto* ids = reinterpret_cast<std::int32_t*>(pixels.ids) + index;
          hn::Store(hn::IfThenElse(mask, value, hn::Load(kInt, ids)), kInt, ids);
        }
      }
    }
  }
};

/// Group without wide triangles: one walk through the blocks of a triangle for all samples. @pre set up, with the samples' reach
template <class Depth, Test kTest, Seen kSeen>
HWY_INLINE void draw_narrow_samples(TileRun& run, std::uint32_t draw_number) {
  const TriangleGroup& g = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  SampleGroup& samples = run.memory.samples->narrow;
  set_up_samples(g, samples, run.samples, kHasDepth<Depth> ? run.frame.depth_kind : DepthKind::none, run.tile_x, run.tile_y);
  const SamplePosition* const positions = sample_positions(run.samples);
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    SampledTrianglePixels<Depth, kTest, kSeen> pixels{.run = run, .draw = draw, .depth = {}, .anchors = {}, .moved = {}, .value = {},
                                                      .writable = splat(static_cast<std::int32_t>(draw.write_mask)), .depth_writable = splat(draw.depth_write ? -1 : 0)};
    TileEdges edges = tile_edges(g, i);
    for (int k = 0; k < 3; ++k) {
      std::int32_t highest = samples.e[0][k][i];
      for (int s = 1; s < run.samples; ++s) highest = std::max(highest, samples.e[s][k][i]);
      for (int s = 0; s < run.samples; ++s) pixels.moved[s][k] = splat(samples.e[s][k][i] - highest);
      edges.e[k] = highest;
    }
    if constexpr (kHasDepth<Depth>) {
      pixels.depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
      pixels.depth.prepare_blocks();
    }
    for (int s = 0; s < run.samples; ++s) pixels.anchors[s] = Depth::anchor(g, samples, s, i, positions[s], run.tile_x, run.tile_y);
    const bool back = !is_front(g.signed_area[i], draw.front_is_clockwise);
    if constexpr (kSeen == Seen::word) pixels.value = splat(static_cast<std::int32_t>(triangle_word(run, draw, i, back)));
    if constexpr (kSeen == Seen::collect_sample) pixels.value = splat(static_cast<std::int32_t>(run.memory.triangles.size()) - g.count + i);
    const BlockOffsets offsets(edges);
    for_each_block(edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
    if constexpr (kSeen == Seen::collect_sample) run.any_seen |= !hn::AllTrue(kInt, hn::Eq(pixels.seen, hn::Zero(kInt)));
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
    draw_group<Depth, kTest, kSeen>(run, draw_number);
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
  else
    draw_narrow_samples<Depth, kTest, kSeen>(run, draw_number);
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
