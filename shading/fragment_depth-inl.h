// Depth keys of blocks for draws with fragment operations: any format, with or without polygon offset. The
// format is tested at run time, once per block, so that the long code of fragments is compiled only once.
#if defined(TESSERA_SHADING_FRAGMENT_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_FRAGMENT_DEPTH_INL_H_
#undef TESSERA_SHADING_FRAGMENT_DEPTH_INL_H_
#else
#define TESSERA_SHADING_FRAGMENT_DEPTH_INL_H_
#endif

#include <cmath>

#include "raster/depth_offset-inl.h"
#include "shading/tile_renderer.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Depth of one triangle.
class FragmentDepth {
 public:
  /// @pre set_up_depth() has run for the group
  /// @param i       triangle of the group
  /// @param source  its number in the draw
  HWY_NOINLINE void set_up(const TileFrame& frame, const TileDraw& draw, const TriangleGroup& g, int i,
                           std::uint32_t source, int tile_x, int tile_y) {
    if (!draw.path.uses_depth()) return;
    const bool has_offset =
        draw.depth_offsets != nullptr || draw.offset_factor != 0 || draw.offset_units != 0;
    const auto apply_offset = [&](auto& depth) HWY_ATTR {
      if (draw.depth_offsets != nullptr && !std::isnan(draw.depth_offsets[source])) {
        depth.set_polygon_offset_value(draw.depth_offsets[source]);
      } else if (has_offset) {
        depth.set_polygon_offset(g, i, draw.offset_factor, draw.offset_units);
      }
    };
    if (frame.depth_format == DepthFormat::float32) {
      format_ = has_offset ? Format::offset_float32 : Format::float32;
      float32_.set_up(g, i, tile_x, tile_y, frame.depth_format);
      apply_offset(float32_);
    } else {
      const bool is_unorm32 = frame.depth_format == DepthFormat::unorm32;
      format_ = has_offset || is_unorm32 ? Format::offset_unorm : Format::unorm;
      unorm_.set_up(g, i, tile_x, tile_y, frame.depth_format);
      apply_offset(unorm_);
      unorm_.prepare_blocks();
    }
  }

  /// Writes the keys of the block's pixels, one vector per chunk. Without depth it writes nothing.
  HWY_NOINLINE void block_keys(int bx, int by, Int* keys) const {
    switch (format_) {
      case Format::none: return;
      case Format::unorm: return fill(static_cast<const UnormDepth&>(unorm_), bx, by, keys);
      case Format::offset_unorm: return fill(unorm_, bx, by, keys);
      case Format::float32: return fill(static_cast<const Float32Depth&>(float32_), bx, by, keys);
      case Format::offset_float32: return fill(float32_, bx, by, keys);
    }
  }

 private:
  // offset_unorm also serves unorm32 depth without an offset.
  enum class Format : std::uint8_t { none, unorm, offset_unorm, float32, offset_float32 };

  template <class Depth>
  static HWY_INLINE void fill(const Depth& depth, int bx, int by, Int* keys) {
    const auto block = depth.block(bx, by);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) keys[chunk] = depth.keys(block, chunk);
  }

  Format format_ = Format::none;
  OffsetUnormDepth unorm_;
  OffsetFloat32Depth float32_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
