// Pixels of one narrow triangle at all samples. A sample is covered if the pixel's centre is covered by the
// triangle moved by the opposite of the sample's offset (raster/sample_positions.h).
#if defined(TESSERA_SHADING_MSAA_TRIANGLE_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_MSAA_TRIANGLE_PIXELS_INL_H_
#undef TESSERA_SHADING_MSAA_TRIANGLE_PIXELS_INL_H_
#else
#define TESSERA_SHADING_MSAA_TRIANGLE_PIXELS_INL_H_
#endif

#include <limits>

#include "raster/coverage-inl.h"
#include "raster/depth-inl.h"
#include "raster/sample_positions.h"
#include "shading/color_eval-inl.h"
#include "shading/no_depth-inl.h"
#include "shading/pixel_path.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Whether hierarchical z culls blocks. Only `less_write` uses hiz_max, and keeps it exact.
template <class Depth, DepthTestPath kDepthTest>
inline constexpr bool kUsesHiz = (kDepthTest == DepthTestPath::less_write) && kHasDepth<Depth>;

/// Whether all samples of a block are nearer than `min_depth_key`, or as near.
HWY_INLINE bool hiz_culls(const TileContext& context, std::int32_t min_depth_key, int bx, int by) {
  return min_depth_key >= context.memory.samples->hiz_max[context.block_index(bx, by) / kBlockPixels];
}
/// hiz_culls() for all blocks that touch the bounds.
HWY_INLINE bool hiz_culls(const TileContext& context, std::int32_t min_depth_key, int x0, int y0, int x1,
                          int y1) {
  for (int by = y0 & ~3; by <= y1; by += 4)
    for (int bx = x0 & ~3; bx <= x1; bx += 4)
      if (!hiz_culls(context, min_depth_key, bx, by)) return false;
  return true;
}

/// Functor for for_each_block(): one narrow triangle at all samples of each pixel.
template <class Depth, DepthTestPath kDepthTest, ColorWrite kColorWrite>
struct MsaaTrianglePixels {
  TileContext& context;
  const TileDraw& draw;
  Depth depth;
  typename Depth::SampleOrigin origins[kMaxSamples];
  Edges32 edges;                   // dominating edges, nowhere below a sample's: they find the blocks
  Int edge_delta[kMaxSamples][3];  // sample's edges - dominating edges: 0 or less
  std::int32_t* depth_of[kMaxSamples];
  std::int32_t* target_of[kMaxSamples];  // colours, or visibility buffer
  Int value;                             // packed colour, or number of the triangle
  const MsaaColorEval* color;    // ColorWrite::deferred: null, or colours to store instead of the number
  Int writable;                  // bits of packed colours that change
  Int depth_writable;            // -1 or 0
  std::int32_t min_depth_key;    // no sample of the triangle has a smaller depth key
  Int visible = hn::Zero(kInt);  // minus the number of pixels visible at any sample, per lane

  HWY_INLINE MsaaTrianglePixels(TileContext& tile_context, const TileDraw& tile_draw, int i,
                                std::uint32_t new_value, const MsaaColorEval* interpolated,
                                std::int32_t nearest_key)
      : context(tile_context),
        draw(tile_draw),
        edges(tile_edges32(tile_context.memory.group, i)),
        value(splat(static_cast<std::int32_t>(new_value))),
        color(interpolated),
        writable(splat(static_cast<std::int32_t>(tile_draw.write_mask))),
        depth_writable(splat(tile_draw.depth_write ? -1 : 0)),
        min_depth_key(nearest_key) {
    const TriangleGroup& g = context.memory.group;
    const SampleGroup& samples = context.memory.samples->samples32;
    for (int k = 0; k < 3; ++k) {
      edges.e[k] = samples.max_edge[k][i];
      for (int s = 0; s < context.samples; ++s) edge_delta[s][k] = splat(samples.edge_delta[s][k][i]);
    }
    if constexpr (kHasDepth<Depth>) {
      depth.set_up(g, i, context.tile_x, context.tile_y, context.frame.depth_format);
      depth.prepare_blocks();
    }
    const bool stores_color = kColorWrite == ColorWrite::constant || color != nullptr;
    for (int s = 0; s < context.samples; ++s) {
      depth_of[s] = context.sample[s].depth;
      target_of[s] = reinterpret_cast<std::int32_t*>(stores_color ? context.sample[s].color
                                                                  : context.sample[s].visibility);
    }
    for (int s = 0; s < context.samples; ++s)
      origins[s] = Depth::sample_origin(g, samples, s, i, sample_positions(context.samples)[s],
                                        context.tile_x, context.tile_y);
  }

  // The template argument is unused: blocks that are full for the dominating edges may not be for a sample.
  template <bool>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& block_edges) {
    if (kUsesHiz<Depth, kDepthTest> && hiz_culls(context, min_depth_key, bx, by)) return;
    if (context.samples == 4) draw_block<4>(bx, by, block_edges);
    else draw_block<kMaxSamples>(bx, by, block_edges);
  }

  // Not inlined: it is long.
  template <int kSamples>
  HWY_NOINLINE void draw_block(int bx, int by, const BlockEdges& block_edges) {
    const int block = context.block_index(bx, by);
    const auto step = depth.step_to(bx, by);
    // Copies stay in registers; the compiler would reload members after every store.
    const bool needs_scissor = context.needs_scissor;
    const Int writes_depth = depth_writable;
    Int hiz_max = splat(std::numeric_limits<std::int32_t>::min());
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      const Int e0 = block_edges.at(0, chunk);
      const Int e1 = block_edges.at(1, chunk);
      const Int e2 = block_edges.at(2, chunk);
      if (hn::AllTrue(kInt, hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(kInt)))) {
        // Outside at every sample.
        if constexpr (kUsesHiz<Depth, kDepthTest>)
          for (int s = 0; s < kSamples; ++s) hiz_max = hn::Max(hiz_max, hn::Load(kInt, depth_of[s] + index));
        continue;
      }
      const Int new_value =
          kColorWrite == ColorWrite::deferred && color != nullptr ? color->packed(e0, e1, e2) : value;
      Int chunk_visible = hn::Zero(kInt);
      for (int s = 0; s < kSamples; ++s) {
        const Int sample_edges = hn::Or(hn::Or(hn::Add(e0, edge_delta[s][0]), hn::Add(e1, edge_delta[s][1])),
                                        hn::Add(e2, edge_delta[s][2]));
        LaneMask mask = hn::Gt(sample_edges, splat(-1));
        if (needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
        if constexpr (kHasDepth<Depth>) {
          const Int key = depth.keys(depth.block(origins[s], step), chunk);
          const Int stored = test_depth(depth_of[s] + index, key, writes_depth, mask);
          if constexpr (kUsesHiz<Depth, kDepthTest>) hiz_max = hn::Max(hiz_max, stored);
        }
        chunk_visible = hn::Or(chunk_visible, hn::VecFromMask(kInt, mask));
        if constexpr (kColorWrite == ColorWrite::constant)
          store_packed(reinterpret_cast<std::uint32_t*>(target_of[s]) + index, new_value, mask, writable);
        if constexpr (kColorWrite == ColorWrite::deferred) {
          std::int32_t* const target = target_of[s] + index;
          hn::Store(hn::IfThenElse(mask, new_value, hn::Load(kInt, target)), kInt, target);
        }
      }
      if constexpr (kColorWrite != ColorWrite::none) visible = hn::Add(visible, chunk_visible);
    }
    if constexpr (kUsesHiz<Depth, kDepthTest>)
      context.memory.samples->hiz_max[block / kBlockPixels] = hn::GetLane(hn::MaxOfLanes(kInt, hiz_max));
  }

 private:
  /// Removes the lanes that fail the depth test from `mask`. If the draw writes depth, stores the keys of the
  /// lanes left in `mask`. Returns the keys in the depth buffer afterwards, of all lanes.
  HWY_INLINE Int test_depth(std::int32_t* depth_at, Int key, [[maybe_unused]] Int writes_depth,
                            LaneMask& mask) const {
    const Int before = hn::Load(kInt, depth_at);
    LaneMask stores = mask;
    if constexpr (kDepthTest == DepthTestPath::less_write) {
      mask = hn::And(mask, hn::Lt(key, before));
      stores = mask;
    } else {
      mask = hn::And(mask, compare_lanes(key, draw.depth_test, before));
      stores = hn::And(mask, hn::MaskFromVec(writes_depth));
    }
    const Int after = hn::IfThenElse(stores, key, before);
    hn::Store(after, kInt, depth_at);
    return after;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
