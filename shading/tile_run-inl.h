// The state of one tile while it is rendered, and the colours that are settled at once.
#if defined(TESSERA_SHADING_TILE_RUN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TILE_RUN_INL_H_
#undef TESSERA_SHADING_TILE_RUN_INL_H_
#else
#define TESSERA_SHADING_TILE_RUN_INL_H_
#endif

#include "raster/lanes-inl.h"
#include "shading/interpolate-inl.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

struct TileRun {
  const TileFrame& frame;
  TileWorkspace::Memory& memory;
  int tile_x, tile_y, tile_size;  // pixels
  PixelRect rect;                 // of the current draw, tile-relative
  bool cut = false;               // the rectangle's edges run through blocks
  TileCounts counts;
  int samples = 1;
  TilePixels sample[kMaxSamples];

  HWY_INLINE int block_index(int bx, int by) const { return ((by >> 2) * (tile_size >> 2) + (bx >> 2)) * kBlockPixels; }
  HWY_INLINE int pixel_index(int x, int y) const { return block_index(x, y) + (y & 3) * 4 + (x & 3); }
  HWY_INLINE Int pixel_indices(Int x, Int y) const {
    const Int block = hn::Add(hn::Mul(hn::ShiftRight<2>(y), splat(tile_size >> 2)), hn::ShiftRight<2>(x)), three = splat(3);
    return hn::Add(hn::ShiftLeft<4>(block), hn::Add(hn::ShiftLeft<2>(hn::And(y, three)), hn::And(x, three)));
  }
};

/// Lanes of a chunk inside the draw's rectangle.
HWY_INLINE auto inside_rect(const PixelRect& rect, int bx, int by, int chunk) {
  const Int x = hn::Add(splat(bx), block_columns(chunk)), y = hn::Add(splat(by), block_rows(chunk));
  return hn::And(hn::And(hn::Gt(x, splat(rect.x0 - 1)), hn::Gt(splat(rect.x1), x)), hn::And(hn::Gt(y, splat(rect.y0 - 1)), hn::Gt(splat(rect.y1), y)));
}

/// Writes the bits of `writable` in the lanes of `mask`.
template <class Mask>
HWY_INLINE void store_words(std::uint32_t* color, Int words, Mask mask, Int writable) {
  auto* target = reinterpret_cast<std::int32_t*>(color);
  const Int stored = hn::Load(kInt, target), changed = hn::And(hn::VecFromMask(kInt, mask), writable);
  hn::Store(hn::Xor(stored, hn::And(hn::Xor(stored, words), changed)), kInt, target);
}

/// Interpolated colours that are scaled to levels: three linear functions and the word's packing.
struct ScaledColor {
  Corners r, g, b;
  int r_shift, g_shift;

  HWY_INLINE void set_up(const ShadedTriangle& t, int attribute, const ColorLayout& layout) {
    r = corners(t, attribute);
    g = corners(t, attribute + 1);
    b = corners(t, attribute + 2);
    r_shift = layout.r_shift();
    g_shift = layout.g_shift();
  }
  HWY_INLINE Int words(const Barycentric& at) const {
    const Int red = truncate(interpolate(at, r)), green = truncate(interpolate(at, g));
    const Int blue = truncate(interpolate(at, b));
    return hn::Or(hn::Or(hn::ShiftLeftSame(red, r_shift), hn::ShiftLeftSame(green, g_shift)), blue);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
