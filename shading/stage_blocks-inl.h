// Inputs and results of a fragment stage, for batches of points.
#if defined(TESSERA_SHADING_STAGE_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_STAGE_BLOCKS_INL_H_
#undef TESSERA_SHADING_STAGE_BLOCKS_INL_H_
#else
#define TESSERA_SHADING_STAGE_BLOCKS_INL_H_
#endif

#include <bit>

#include "shading/batch_surface-inl.h"
#include "shading/fragment_ops-inl.h"
#include "shading/fragment_stage.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

inline constexpr std::uint32_t kWholeBlock = (1u << kBlockPixels) - 1;

/// Centres of the pixels of a chunk in window coordinates.
struct WindowPositions {
  Float x, y;
};
HWY_INLINE WindowPositions window_positions(const TileContext& context, int bx, int by, int chunk) {
  const Int column = hn::Add(splat(context.tile_x + bx), block_columns(chunk));
  const Int row = hn::Sub(splat(context.frame.grid.height_px - 1 - context.tile_y - by), block_rows(chunk));
  return {hn::Add(hn::ConvertTo(kFloat, column), splat(0.5f)),
          hn::Add(hn::ConvertTo(kFloat, row), splat(0.5f))};
}
/// Stores the positions of a block in the points from `first` on.
HWY_INLINE void store_positions(const TileContext& context, int bx, int by, int first) {
  StageArrays& arrays = context.memory.stage;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const WindowPositions at = window_positions(context, bx, by, chunk);
    hn::Store(at.x, kFloat, arrays.field[kStageX] + first + chunk * kLanes);
    hn::Store(at.y, kFloat, arrays.field[kStageY] + first + chunk * kLanes);
  }
}
/// Stores the depths of a block, given as keys, in the points from `first` on.
inline HWY_NOINLINE void store_depths(const TileContext& context, const std::int32_t* keys, int first) {
  const DepthFormat format = context.frame.depth_format;
  for (int i = 0; i < kBlockPixels; ++i)
    context.memory.stage.depth[first + i] = dequantize_depth(format, stored_depth_from_key(format, keys[i]));
}

/// Calls body(field) for each array of the stage's inputs and results that holds floats.
template <class Body>
HWY_INLINE void for_each_stage_field(const TileFragmentStage& stage, ShadingBatch& batch, StageArrays& arrays,
                                     const Body& body) {
  for (int c = 0; c < 3; ++c) body(batch.field[kColorR + c]);
  body(arrays.field[kStageAlpha]);
  if (stage.stage.reads.position)
    for (int c = 0; c < 2; ++c) body(arrays.field[kStageX + c]);
  for (int c = 0; c < 3 && stage.eye >= 0; ++c) body(arrays.field[kStageEye + c]);
  for (int c = 0; c < 3 && stage.normal >= 0; ++c) body(arrays.field[kStageNormal + c]);
  for (int k = 0; k < stage.stage.reads.extras; ++k) body(arrays.field[kStageExtras + k]);
}

/// Replaces the points of a block that are not covered by a covered one, so that the stage sees fragments
/// only.
/// @param first    point of the block's first pixel
/// @param covered  16 bits, not 0
inline HWY_NOINLINE void repeat_covered_point(const TileContext& context, const TileFragmentStage& stage,
                                              int first, std::uint32_t covered) {
  StageArrays& arrays = context.memory.stage;
  const int leader = first + std::countr_zero(covered);
  for_each_stage_field(stage, context.memory.batch, arrays, [&](float* field) HWY_ATTR {
    const Float value = splat(field[leader]);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      float* const at = field + first + chunk * kLanes;
      const auto mask = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(covered, chunk)));
      hn::Store(hn::IfThenElse(mask, hn::Load(kFloat, at), value), kFloat, at);
    }
  });
  if (!stage.stage.reads.depth) return;
  for (int i = 0; i < kBlockPixels; ++i)
    if ((covered >> i & 1) == 0) arrays.depth[first + i] = arrays.depth[leader];
}

/// Calls the stage for the first `count` points of the batch.
HWY_INLINE void run_stage(TileContext& context, const BatchSurface& surface, int count) {
  const TileGrid& grid = context.frame.grid;
  call_fragment_stage(
      *surface.stage,
      {.back_face = surface.back, .frame_width = grid.width_px, .frame_height = grid.height_px}, count,
      context.memory.batch, context.memory.stage, *context.frame.stage_failure);
}

/// Clamps the colours of one vector of points to 0..1; components that are not finite become 0.
/// @return  points with such a component, one bit per lane
HWY_INLINE std::uint32_t clamp_stage_colors(TileContext& context, int point) {
  float* const components[4] = {
      context.memory.batch.field[kColorR] + point, context.memory.batch.field[kColorG] + point,
      context.memory.batch.field[kColorB] + point, context.memory.stage.field[kStageAlpha] + point};
  auto all_finite = hn::Eq(splat(0.0f), splat(0.0f));
  for (float* const component : components) {
    const Float value = hn::Load(kFloat, component);
    const auto is_finite = hn::Eq(hn::Sub(value, value), hn::Zero(kFloat));
    hn::Store(clamped_unit(hn::IfThenElseZero(is_finite, value)), kFloat, component);
    all_finite = hn::And(all_finite, is_finite);
  }
  return mask_bits(kFloat, hn::Not(all_finite));
}
/// clamp_stage_colors() for a block. @return  points with such a component, 16 bits
inline HWY_NOINLINE std::uint32_t clamp_block_colors(TileContext& context, int first) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= clamp_stage_colors(context, first + chunk * kLanes) << (chunk * kLanes);
  return bits;
}

/// Depth keys that the stage wrote for the points of a block.
/// @return  points whose depth is finite, 16 bits
inline HWY_NOINLINE std::uint32_t written_keys(const TileContext& context, std::int32_t* keys) {
  const DepthFormat format = context.frame.depth_format;
  std::uint32_t finite = 0;
  for (int i = 0; i < kBlockPixels; ++i) {
    const double depth = context.memory.stage.depth[i];
    if (depth - depth != 0) continue;
    finite |= 1u << i;
    keys[i] = depth_key_from_stored(format, quantize_depth(format, std::clamp(depth, 0.0, 1.0)));
  }
  return finite;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
