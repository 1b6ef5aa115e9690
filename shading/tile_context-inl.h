// The state of one tile while it is rendered.
#if defined(TESSERA_SHADING_TILE_CONTEXT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TILE_CONTEXT_INL_H_
#undef TESSERA_SHADING_TILE_CONTEXT_INL_H_
#else
#define TESSERA_SHADING_TILE_CONTEXT_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "raster/binning.h"
#include "raster/lanes-inl.h"
#include "shading/fragment_scalar.h"
#include "shading/interpolate-inl.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

struct TileContext {
  const TileFrame& frame;
  TileWorkspace::Memory& memory;
  std::uint32_t* const color;     // memory.color as a constant, so that stores cannot change it
  int tile_x, tile_y, tile_size;  // pixels, raster space
  PixelRect rect;                 // where the current draw may change pixels, tile-relative
  bool needs_scissor = false;     // the edges of `rect` cut through blocks
  TileCounts counts;
  int samples = 1;
  TileAttachments sample[kMaxSamples];  // with one sample: the attachments of the tile
  DrawMeter* meter = nullptr;           // null: draws are not measured

  HWY_INLINE int block_index(int bx, int by) const {
    return ((by >> 2) * (tile_size >> 2) + (bx >> 2)) * kBlockPixels;
  }
  HWY_INLINE int pixel_index(int x, int y) const { return block_index(x, y) + (y & 3) * 4 + (x & 3); }
  HWY_INLINE Int pixel_indices(Int x, Int y) const {
    const Int block = hn::Add(hn::Mul(hn::ShiftRight<2>(y), splat(tile_size >> 2)), hn::ShiftRight<2>(x));
    const Int three = splat(3);
    return hn::Add(hn::ShiftLeft<4>(block), hn::Add(hn::ShiftLeft<2>(hn::And(y, three)), hn::And(x, three)));
  }
};

/// The time and pixels that follow belong to `tile_draw`, if draws are measured.
HWY_INLINE void measure_as(const TileContext& context, std::uint32_t tile_draw) {
  if (context.meter == nullptr) return;
  context.meter->switch_to(context.frame.draws[tile_draw].recorded_draw, context.counts.shaded_pixels);
}
/// The time and pixels that follow belong to no draw, if draws are measured.
HWY_INLINE void measure_as_no_draw(const TileContext& context) {
  if (context.meter != nullptr) context.meter->switch_to(DrawMeter::kNoDraw, context.counts.shaded_pixels);
}

/// Minus the sum of the lanes.
HWY_INLINE std::uint64_t count_of(Int negative) {
  alignas(64) std::int32_t lanes[kLanes];
  hn::Store(negative, kInt, lanes);
  std::int64_t sum = 0;
  for (const std::int32_t lane : lanes) sum -= lane;
  return static_cast<std::uint64_t>(sum);
}

inline constexpr std::int32_t kMaxDepthKey = std::numeric_limits<std::int32_t>::max();

/// Sets hierarchical z of all blocks. @pre several samples
HWY_INLINE void reset_hiz(TileContext& context, std::int32_t key) {
  std::fill_n(context.memory.samples->hiz_max, context.tile_size * context.tile_size / kBlockPixels, key);
}

/// Lanes of a chunk inside the rectangle.
HWY_INLINE auto scissor_mask(const PixelRect& rect, int bx, int by, int chunk) {
  const Int x = hn::Add(splat(bx), block_columns(chunk));
  const Int y = hn::Add(splat(by), block_rows(chunk));
  return hn::And(hn::And(hn::Gt(x, splat(rect.x0 - 1)), hn::Gt(splat(rect.x1), x)),
                 hn::And(hn::Gt(y, splat(rect.y0 - 1)), hn::Gt(splat(rect.y1), y)));
}

/// Stores packed colours: the bits of `writable` in the lanes of `mask`.
template <class Mask>
HWY_INLINE void store_packed(std::uint32_t* color, Int packed, Mask mask, Int writable) {
  auto* target = reinterpret_cast<std::int32_t*>(color);
  const Int stored = hn::Load(kInt, target);
  const Int changed = hn::And(hn::VecFromMask(kInt, mask), writable);
  hn::Store(hn::Xor(stored, hn::And(hn::Xor(stored, packed), changed)), kInt, target);
}

/// Stores the lanes of `mask`; other elements are unchanged.
template <class Tag, class Mask>
HWY_INLINE void store_where(Mask mask, hn::Vec<Tag> value, Tag tag, hn::TFromD<Tag>* to) {
#if HWY_TARGET == HWY_AVX3
  hn::BlendedStore(value, mask, tag, to);
#else  // masked stores are slow on some processors
  hn::Store(hn::IfThenElse(mask, value, hn::Load(tag, to)), tag, to);
#endif
}
/// store_packed() with all bits writable.
template <class Mask>
HWY_INLINE void store_packed_all_bits(std::uint32_t* color, Int packed, Mask mask) {
  store_where(mask, packed, kInt, reinterpret_cast<std::int32_t*>(color));
}

/// Whether triangle i of the group is back-facing: by its polygon, or by its area.
HWY_INLINE bool is_back(const TileContext& context, const TileDraw& draw, int i) {
  if (draw.facing != nullptr) return draw.facing[context.memory.source[i]] == Facing::back;
  return !is_front(context.memory.group.signed_area[i], draw.front_is_clockwise);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
