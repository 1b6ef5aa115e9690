// Draws without operations where pixels have several samples: what a sample sees of a triangle is what the
// pixel's centre sees of the triangle moved the other way (raster/sample_positions.h).
#if defined(TESSERA_SHADING_DRAW_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#undef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#endif

#include <limits>

#include "raster/sample_positions.h"
#include "shading/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Blocks in which nothing of a triangle can be seen are passed over. Only `less` does so, and keeps the
/// blocks' farthest depths exact.
template <class Depth, Test kTest>
inline constexpr bool kCulls = kHasDepth<Depth>&& kTest == Test::less;

/// A block holds nothing that is farther than `nearest`.
HWY_INLINE bool is_hidden(const TileRun& run, std::int32_t nearest, int bx, int by) {
  return nearest >= run.memory.samples->farthest[run.block_index(bx, by) / kBlockPixels];
}
/// Nor do all blocks of these bounds.
HWY_INLINE bool is_hidden(const TileRun& run, std::int32_t nearest, int x0, int y0, int x1, int y1) {
  for (int by = y0 & ~3; by <= y1; by += 4)
    for (int bx = x0 & ~3; bx <= x1; bx += 4)
      if (!is_hidden(run, nearest, bx, by)) return false;
  return true;
}

/// Colours of a triangle that are interpolated at once, at the pixels' centres.
struct SampledColor {
  const ShadedTriangle* triangle = nullptr;
  const ColorLayout* layout = nullptr;
  Corners r, g, b;
  Int to_center[3];  // from the edges that the blocks are found by

  HWY_INLINE void set_up(const TileRun& run, const TileDraw& draw, const ShadedTriangle& shaded, int i) {
    triangle = &shaded;
    layout = &run.frame.layout;
    const int attribute = draw.color_attribute[shaded.back ? 1 : 0];
    r = corners(shaded, attribute, true), g = corners(shaded, attribute + 1, true),
    b = corners(shaded, attribute + 2, true);
    for (int k = 0; k < 3; ++k)
      to_center[k] = hn::Sub(splat(shaded.edges.e[k]), splat(run.memory.samples->narrow.highest[k][i]));
  }
  HWY_NOINLINE Int words(Int e0, Int e1, Int e2) const {
    const Barycentric at = barycentric_from_edges(*triangle, hn::Add(e0, to_center[0]),
                                                  hn::Add(e1, to_center[1]), hn::Add(e2, to_center[2]));
    return words_of(
        *layout,
        {{interpolate_within(at, r), interpolate_within(at, g), interpolate_within(at, b), splat(1.0f)}},
        splat(0.5f));
  }
};

/// One narrow triangle's way through the blocks of a tile, at all samples of a pixel.
template <class Depth, Test kTest, Seen kSeen>
struct SampledTrianglePixels {
  TileRun& run;
  const TileDraw& draw;
  Depth depth;
  typename Depth::Anchor anchors[kMaxSamples];
  TileEdges edges;            // those that the blocks are found by: never below any sample's
  Int below[kMaxSamples][3];  // what a sample's edges are more than those
  std::int32_t *stored_depth[kMaxSamples],
      *stored[kMaxSamples];   // of the sample: depth; the words or triangles' numbers that it writes
  Int value;                  // the word, or the triangle's number
  const SampledColor* color;  // collect: words in place of numbers, all of their bits; or null
  Int writable, depth_writable;
  std::int32_t nearest;       // no sample of the triangle has a smaller depth key
  Int seen = hn::Zero(kInt);  // minus the number of pixels that passed at any sample, in each lane

  HWY_INLINE SampledTrianglePixels(TileRun& tile_run, const TileDraw& tile_draw, int i,
                                   std::uint32_t new_value, const SampledColor* interpolated,
                                   std::int32_t nearest_key)
      : run(tile_run),
        draw(tile_draw),
        edges(tile_edges(tile_run.memory.group, i)),
        value(splat(static_cast<std::int32_t>(new_value))),
        color(interpolated),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))),
        depth_writable(splat(tile_draw.depth_write ? -1 : 0)),
        nearest(nearest_key) {
    const TriangleGroup& g = run.memory.group;
    const SampleGroup& samples = run.memory.samples->narrow;
    for (int k = 0; k < 3; ++k) {
      edges.e[k] = samples.highest[k][i];
      for (int s = 0; s < run.samples; ++s) below[s][k] = splat(samples.below[s][k][i]);
    }
    if constexpr (kHasDepth<Depth>) {
      depth.set_up(g, i, run.tile_x, run.tile_y, run.frame.depth_kind);
      depth.prepare_blocks();
    }
    for (int s = 0; s < run.samples; ++s) {
      stored_depth[s] = run.sample[s].depth;
      stored[s] = reinterpret_cast<std::int32_t*>(
          kSeen == Seen::word || color != nullptr ? run.sample[s].color : run.sample[s].ids);
    }
    for (int s = 0; s < run.samples; ++s)
      anchors[s] = Depth::anchor(g, samples, s, i, sample_positions(run.samples)[s], run.tile_x, run.tile_y);
  }

  // Whether the block is full is known of the edges that dominate, not of each sample's.
  template <bool>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& block_edges) {
    if (kCulls<Depth, kTest> && is_hidden(run, nearest, bx, by)) return;
    if (run.samples == 4) draw_block<4>(bx, by, block_edges);
    else draw_block<kMaxSamples>(bx, by, block_edges);
  }

  // Once for all: it is long.
  template <int kSamples>
  HWY_NOINLINE void draw_block(int bx, int by, const BlockEdges& block_edges) {
    const int block = run.block_index(bx, by);
    const auto step = depth.step_to(bx, by);
    const bool cut = run.cut;  // in registers: stores to the tile might change members
    const Int writes_depth = depth_writable;
    Int farthest = splat(std::numeric_limits<std::int32_t>::min());
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      const Int e0 = block_edges.at(0, chunk), e1 = block_edges.at(1, chunk), e2 = block_edges.at(2, chunk);
      if (hn::AllTrue(kInt, hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(kInt)))) {  // outside at every sample
        if constexpr (kCulls<Depth, kTest>)
          for (int s = 0; s < kSamples; ++s)
            farthest = hn::Max(farthest, hn::Load(kInt, stored_depth[s] + index));
        continue;
      }
      const Int new_value = kSeen == Seen::collect && color != nullptr ? color->words(e0, e1, e2) : value;
      Int chunk_seen = hn::Zero(kInt);
      for (int s = 0; s < kSamples; ++s) {
        auto mask = hn::Gt(
            hn::Or(hn::Or(hn::Add(e0, below[s][0]), hn::Add(e1, below[s][1])), hn::Add(e2, below[s][2])),
            splat(-1));
        if (cut) mask = hn::And(mask, inside_rect(run.rect, bx, by, chunk));
        if constexpr (kHasDepth<Depth>) {
          std::int32_t* const at = stored_depth[s] + index;
          const Int before = hn::Load(kInt, at), key = depth.keys(depth.block(anchors[s], step), chunk);
          mask = hn::And(mask,
                         kTest == Test::less ? hn::Lt(key, before) : comparing(key, draw.depth_test, before));
          const Int after = hn::IfThenElse(
              kTest == Test::less ? mask : hn::And(mask, hn::MaskFromVec(writes_depth)), key, before);
          hn::Store(after, kInt, at);
          if constexpr (kCulls<Depth, kTest>) farthest = hn::Max(farthest, after);
        }
        chunk_seen = hn::Or(chunk_seen, hn::VecFromMask(kInt, mask));
        if constexpr (kSeen == Seen::word)
          store_words(reinterpret_cast<std::uint32_t*>(stored[s]) + index, new_value, mask, writable);
        if constexpr (kSeen == Seen::collect) {
          std::int32_t* const at = stored[s] + index;
          hn::Store(hn::IfThenElse(mask, new_value, hn::Load(kInt, at)), kInt, at);
        }
      }
      if constexpr (kSeen != Seen::nothing) seen = hn::Add(seen, chunk_seen);
    }
    if constexpr (kCulls<Depth, kTest>)
      run.memory.samples->farthest[block / kBlockPixels] = hn::GetLane(hn::MaxOfLanes(kInt, farthest));
  }
};

/// A group without wide triangles: one walk through the blocks of a triangle for all samples. True if one of
/// them waits for its colour, by numbers from `id` on.
/// @pre set up, with the samples' reach
template <class Depth, Test kTest, Seen kSeen>
HWY_INLINE bool draw_narrow_samples(TileRun& run, std::uint32_t draw_number, std::uint32_t id) {
  const TriangleGroup& g = run.memory.group;
  const TileDraw& draw = run.frame.draws[draw_number];
  set_up_samples(g, run.memory.samples->narrow, run.samples,
                 kHasDepth<Depth> ? run.frame.depth_kind : DepthKind::none, run.tile_x, run.tile_y);
  bool any_seen = false;
  for (std::uint32_t left = g.mask; left != 0; left &= left - 1, ++id) {
    const int i = std::countr_zero(left);
    std::int32_t nearest = 0;
    if constexpr (kCulls<Depth, kTest>) {
      nearest = Depth::nearest_key(g, i, run.frame.depth_kind);
      if (is_hidden(run, nearest, g.x0[i], g.y0[i], g.x1[i], g.y1[i])) continue;
    }
    const std::uint32_t value = kSeen == Seen::word ? triangle_word(run, draw, i, is_back(run, draw, i)) : id;
    const bool at_once = kSeen == Seen::collect && !draw.deferred && draw.source == ColorSource::interpolated;
    SampledColor color;
    if (at_once) color.set_up(run, draw, run.memory.triangles[id], i);
    SampledTrianglePixels<Depth, kTest, kSeen> pixels(run, draw, i, value, at_once ? &color : nullptr,
                                                      nearest);
    const BlockOffsets offsets(pixels.edges);
    for_each_block(pixels.edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], pixels);
    if (kSeen == Seen::word || at_once) run.counts.shaded_pixels += count_of(pixels.seen);
    else if constexpr (kSeen == Seen::collect)
      any_seen |= !hn::AllTrue(kInt, hn::Eq(pixels.seen, hn::Zero(kInt)));
  }
  return any_seen;
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
  if (any_wide) return draw_fragments_samples(run, draw_number);
  const std::size_t first_id = memory.triangles.size();
  if constexpr (kSeen == Seen::collect) {
    set_up_weights(g);
    for (std::uint32_t left = g.mask; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      fill_shaded_triangle(memory.triangles.emplace_back(), run, draw_number, i,
                           is_back(run, run.frame.draws[draw_number], i));
    }
  }
  const bool any_seen =
      draw_narrow_samples<Depth, kTest, kSeen>(run, draw_number, static_cast<std::uint32_t>(first_id));
  if constexpr (kSeen == Seen::collect) {
    if (!any_seen) {
      memory.triangles.resize(first_id);
    } else if (run.frame.shade_at_once) {
      shade_whole_tile(run);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
