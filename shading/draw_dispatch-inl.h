// Which of the functions that draw a group of points, lines or triangles a draw needs.
#if defined(TESSERA_SHADING_DRAW_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#undef TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#else
#define TESSERA_SHADING_DRAW_DISPATCH_INL_H_
#endif

#include <optional>

#include "framebuffer/check.h"
#include "shading/draw_group_msaa-inl.h"
#include "shading/draw_textured-inl.h"
#include "shading/points_lines-inl.h"
#include "shading/tile_renderer.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

using DrawGroupFunction = void (*)(TileContext&, std::uint32_t draw);

template <class Depth, DepthTestPath kDepthTest>
DrawGroupFunction select_by_color_write(ColorWrite color_write, bool sampled) {
  if (sampled) {
    switch (color_write) {
      case ColorWrite::none:
        return &draw_group_msaa<Depth, DepthTestPath::generic, ColorWrite::none>;  // rare: once for all tests
      case ColorWrite::constant: return &draw_group_msaa<Depth, kDepthTest, ColorWrite::constant>;
      default: return &draw_group_msaa<Depth, kDepthTest, ColorWrite::deferred>;
    }
  }
  switch (color_write) {
    case ColorWrite::none: return &draw_group<Depth, kDepthTest, ColorWrite::none>;
    case ColorWrite::constant: return &draw_group<Depth, kDepthTest, ColorWrite::constant>;
    case ColorWrite::interpolated: return &draw_group<Depth, kDepthTest, ColorWrite::interpolated>;
    case ColorWrite::blended: return &draw_group<Depth, DepthTestPath::generic, ColorWrite::blended>;
    default: return &draw_group<Depth, kDepthTest, ColorWrite::deferred>;
  }
}

/// What happens to the pixels of a draw without operations.
inline ColorWrite color_write_without_operations(const TileDraw& draw) {
  if (draw.source == ColorSource::none) return ColorWrite::none;
  if (draw.source == ColorSource::per_pixel || draw.deferred) return ColorWrite::deferred;
  return draw.source == ColorSource::interpolated ? ColorWrite::interpolated : ColorWrite::constant;
}

/// What happens to those of a draw whose operations draw_group knows: a stencil test, and of colours that it
/// makes a mix by their alpha.
inline std::optional<ColorWrite> color_write_with_operations(const TileFrame& frame, const TileDraw& draw) {
  const FragmentOps& ops = *draw.ops;
  if (frame.samples > 1 || ops.alpha_test || draw.id_output != TileDraw::IdOutput::none ||
      draw.offset_factor != 0 || draw.offset_units != 0 || draw.depth_offsets != nullptr)
    return std::nullopt;
  if (draw.source == ColorSource::none) return ColorWrite::none;
  if (draw.deferred) return ColorWrite::deferred;
  if (draw.plain_colors) return color_write_without_operations(draw);
  const ColorLayout& layout = frame.layout;
  const bool is_rgb8 = layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8 &&
                       layout.alpha_bits == 0 && !layout.luminance && !layout.index;
  if (!is_rgb8 || ops.dither || ops.logic != LogicOp::copy || draw.texture != nullptr ||
      (draw.source != ColorSource::interpolated && draw.source != ColorSource::constant))
    return std::nullopt;
  const bool is_plain_mix = ops.equation == BlendEquation::add && ops.src_color == BlendFactor::src_alpha &&
                            ops.dst_color == BlendFactor::one_minus_src_alpha;
  return ops.blend && is_plain_mix ? std::optional(ColorWrite::blended) : std::nullopt;
}

/// The code that runs for a draw: none of it holds a step that the draw does not have.
inline HWY_NOINLINE DrawGroupFunction select_draw_group(const TileFrame& frame, const TileDraw& draw) {
  if (draw.topology == Topology::points) return draw_points;
  if (draw.topology == Topology::lines) return draw_lines;
  if constexpr (kLanes > 1) {  // one lane gains nothing
    if (can_texture_immediately(frame, draw)) return draw_textured;
  }
  const std::optional<ColorWrite> with_operations =
      draw.ops != nullptr ? color_write_with_operations(frame, draw) : std::nullopt;
  if (draw.ops != nullptr && !with_operations)
    return frame.samples > 1 ? &draw_fragments_msaa : &draw_fragments;
  const ColorWrite color_write = with_operations.value_or(color_write_without_operations(draw));
  const bool less = draw.depth_test == Compare::less && draw.depth_write && draw.ops == nullptr,
             sampled = frame.samples > 1;
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::per_pixel);
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::interpolated ||
                 (draw.write_mask == 0xffffffffu && !draw.scaled_colors && !frame.layout.index &&
                  !frame.layout.luminance));
  if (!has_depth(frame, draw))
    return select_by_color_write<NoDepth, DepthTestPath::generic>(color_write, sampled);
  switch (frame.depth_format) {
    case DepthFormat::float32:
      return less ? select_by_color_write<Float32Depth, DepthTestPath::less_write>(color_write, sampled)
                  : select_by_color_write<Float32Depth, DepthTestPath::generic>(color_write, sampled);
    case DepthFormat::unorm32:
      return select_by_color_write<Unorm32Depth, DepthTestPath::generic>(color_write, sampled);
    default:
      return less ? select_by_color_write<UnormDepth, DepthTestPath::less_write>(color_write, sampled)
                  : select_by_color_write<UnormDepth, DepthTestPath::generic>(color_write, sampled);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
