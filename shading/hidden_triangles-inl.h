// Leaves out groups of triangles behind everything in their tile, before they are set up: hierarchical z with
// the draw's rectangle in the tile as its only level.
//
// No pixel of a triangle has a smaller depth key than the triangle's nearest vertex: unorm planes are biased
// by their error, and floats are clamped to the range of the vertices (raster/depth-inl.h). So a group fails
// `less` at every pixel if its nearest key is at least the farthest key of the rectangle, and `lequal` if it
// is greater. During such a draw the stored keys only decrease, so the farthest key remains an upper bound.
#if defined(TESSERA_SHADING_HIDDEN_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_HIDDEN_TRIANGLES_INL_H_
#undef TESSERA_SHADING_HIDDEN_TRIANGLES_INL_H_
#else
#define TESSERA_SHADING_HIDDEN_TRIANGLES_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "raster/lanes-inl.h"
#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Lower bound of the keys of all pixels of the group's triangles.
/// @pre unused lanes of the group repeat a triangle
inline std::int32_t nearest_key(const TriangleGroup& g, DepthFormat format) {
  // Unorm words are unsigned. The bits of floats that are not negative compare as the floats do; a negative
  // zero becomes the smallest integer, which is a lower bound as well.
  const std::uint32_t flip = format == DepthFormat::float32 ? 0 : 0x80000000u;
  Int nearest = splat(std::numeric_limits<std::int32_t>::max());
  for (const auto& z : g.z)
    for (int first = 0; first < kGroupSize; first += kLanes) {
      const Int words = hn::Load(kInt, reinterpret_cast<const std::int32_t*>(z) + first);
      nearest = hn::Min(nearest, hn::Xor(words, splat(static_cast<std::int32_t>(flip))));
    }
  const std::int32_t least = hn::GetLane(hn::MinOfLanes(kInt, nearest));
  if (format == DepthFormat::float32 || format == DepthFormat::unorm32) return least;
  return static_cast<std::int32_t>((static_cast<std::uint32_t>(least) ^ flip) >> (32 - depth_bits(format)));
}

/// Decides which groups of the current draw are left out.
class HiddenTriangles {
 public:
  HWY_INLINE void begin_draw(const TileDraw& draw) {
    is_active_ = draw.skips_hidden;
    has_farthest_ = false;
  }
  /// Whether no triangle of the group in the workspace can pass the depth test.
  HWY_INLINE bool hides_group(const TileContext& context, const TileDraw& draw) {
    if (!is_active_ || --groups_until_test_ > 0) return false;
    const bool hides = test_group(context, draw);
    // Where nothing is hidden, tests become rare: they cost less than a thousandth of the groups' set-up.
    interval_ = hides ? 1 : std::min(2 * interval_, kMaxInterval);
    groups_until_test_ = interval_;
    return hides;
  }

 private:
  static constexpr int kFirstInterval = 4, kMaxInterval = 64;  // groups

  HWY_NOINLINE bool test_group(const TileContext& context, const TileDraw& draw) {
    const std::int32_t nearest = nearest_key(context.memory.group, context.frame.depth_format);
    if (nearest == std::numeric_limits<std::int32_t>::min()) return false;
    // Keys up to this one make the test fail.
    const std::int32_t failing = draw.depth_test == Compare::less ? nearest : nearest - 1;
    if (has_farthest_ && farthest_ <= failing) return true;
    has_farthest_ = find_farthest(context, failing);
    return has_farthest_;
  }
  /// Sets farthest_ to the largest key in the blocks that the draw's rectangle touches. Stops at a key
  /// greater than `limit`, and returns false.
  HWY_INLINE bool find_farthest(const TileContext& context, std::int32_t limit) {
    const PixelRect& rect = context.rect;
    Int farthest = splat(std::numeric_limits<std::int32_t>::min());
    const int first_column = rect.x0 / 4, end_column = (rect.x1 + 3) / 4;
    const int keys = (end_column - first_column) * kBlockPixels;
    for (int by = rect.y0 & ~3; by < rect.y1; by += 4) {
      const std::int32_t* const row = context.memory.depth + context.block_index(4 * first_column, by);
      for (int i = 0; i < keys; i += kBlockPixels) {
        for (int chunk = 0; chunk < kBlockPixels; chunk += kLanes)
          farthest = hn::Max(farthest, hn::Load(kInt, row + i + chunk));
        if (!hn::AllFalse(kInt, hn::Gt(farthest, splat(limit)))) return false;
      }
    }
    farthest_ = hn::GetLane(hn::MaxOfLanes(kInt, farthest));
    return true;
  }

  bool is_active_ = false;
  bool has_farthest_ = false;  // farthest_ is an upper bound of the keys in the draw's rectangle
  std::int32_t farthest_ = 0;
  int interval_ = kFirstInterval;
  int groups_until_test_ = kFirstInterval;
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
