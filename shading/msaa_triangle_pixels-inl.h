// Pixels of one narrow triangle at all samples. A sample sees of a triangle what the pixel's center sees of
// the triangle moved by the opposite of the sample's offset (raster/sample_positions.h).
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

/// Whether hierarchical z culls blocks. Only `less_write` uses it, and keeps the blocks' hiz_max exact.
template <class Depth, DepthTestPath kDepthTest>
inline constexpr bool kUsesHiz = kHasDepth<Depth>&& kDepthTest == DepthTestPath::less_write;

/// Whether no sample of the block is farther than `min_depth_key`.
HWY_INLINE bool hiz_culls(const TileContext& context, std::int32_t min_depth_key, int bx, int by) {
  return min_depth_key >= context.memory.samples->hiz_max[context.block_index(bx, by) / kBlockPixels];
}
/// Whether this holds for all blocks of the bounds.
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
  Edges32 edges;              // dominating edges, never below any sample's: they find the blocks
  Int below[kMaxSamples][3];  // sample's edges - dominating edges: 0 or less
  std::int32_t* stored_depth[kMaxSamples];
  std::int32_t* stored[kMaxSamples];  // colors or visibility buffer of each sample
  Int value;                          // packed color, or number of the triangle
  const MsaaColorEval* color;         // ColorWrite::deferred: null, or packed colors in place of the number
  Int writable, depth_writable;
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
      for (int s = 0; s < context.samples; ++s) below[s][k] = splat(samples.edge_delta[s][k][i]);
    }
    if constexpr (kHasDepth<Depth>) {
      depth.set_up(g, i, context.tile_x, context.tile_y, context.frame.depth_format);
      depth.prepare_blocks();
    }
    for (int s = 0; s < context.samples; ++s) {
      stored_depth[s] = context.sample[s].depth;
      stored[s] = reinterpret_cast<std::int32_t*>(kColorWrite == ColorWrite::constant || color != nullptr
                                                      ? context.sample[s].color
                                                      : context.sample[s].visibility);
    }
    for (int s = 0; s < context.samples; ++s)
      origins[s] = Depth::sample_origin(g, samples, s, i, sample_positions(context.samples)[s],
                                        context.tile_x, context.tile_y);
  }

  // A full block is full for the dominating edges, not for every sample.
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
    const bool needs_scissor =
        context.needs_scissor;  // in a register: members would be reloaded after every store
    const Int writes_depth = depth_writable;
    Int hiz_max = splat(std::numeric_limits<std::int32_t>::min());
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const int index = block + chunk * kLanes;
      const Int e0 = block_edges.at(0, chunk), e1 = block_edges.at(1, chunk), e2 = block_edges.at(2, chunk);
      if (hn::AllTrue(kInt, hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(kInt)))) {  // outside at every sample
        if constexpr (kUsesHiz<Depth, kDepthTest>)
          for (int s = 0; s < kSamples; ++s)
            hiz_max = hn::Max(hiz_max, hn::Load(kInt, stored_depth[s] + index));
        continue;
      }
      const Int new_value =
          kColorWrite == ColorWrite::deferred && color != nullptr ? color->packed(e0, e1, e2) : value;
      Int chunk_visible = hn::Zero(kInt);
      for (int s = 0; s < kSamples; ++s) {
        auto mask = hn::Gt(
            hn::Or(hn::Or(hn::Add(e0, below[s][0]), hn::Add(e1, below[s][1])), hn::Add(e2, below[s][2])),
            splat(-1));
        if (needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
        if constexpr (kHasDepth<Depth>) {
          std::int32_t* const at = stored_depth[s] + index;
          const Int before = hn::Load(kInt, at), key = depth.keys(depth.block(origins[s], step), chunk);
          mask = hn::And(mask, kDepthTest == DepthTestPath::less_write
                                   ? hn::Lt(key, before)
                                   : compare_lanes(key, draw.depth_test, before));
          const Int after = hn::IfThenElse(
              kDepthTest == DepthTestPath::less_write ? mask : hn::And(mask, hn::MaskFromVec(writes_depth)),
              key, before);
          hn::Store(after, kInt, at);
          if constexpr (kUsesHiz<Depth, kDepthTest>) hiz_max = hn::Max(hiz_max, after);
        }
        chunk_visible = hn::Or(chunk_visible, hn::VecFromMask(kInt, mask));
        if constexpr (kColorWrite == ColorWrite::constant)
          store_packed(reinterpret_cast<std::uint32_t*>(stored[s]) + index, new_value, mask, writable);
        if constexpr (kColorWrite == ColorWrite::deferred) {
          std::int32_t* const at = stored[s] + index;
          hn::Store(hn::IfThenElse(mask, new_value, hn::Load(kInt, at)), kInt, at);
        }
      }
      if constexpr (kColorWrite != ColorWrite::none) visible = hn::Add(visible, chunk_visible);
    }
    if constexpr (kUsesHiz<Depth, kDepthTest>)
      context.memory.samples->hiz_max[block / kBlockPixels] = hn::GetLane(hn::MaxOfLanes(kInt, hiz_max));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
