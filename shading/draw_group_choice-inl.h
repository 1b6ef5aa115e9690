// Which of the functions that draw a group of points, lines or triangles a draw needs.
#if defined(TESSERA_SHADING_DRAW_GROUP_CHOICE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_GROUP_CHOICE_INL_H_
#undef TESSERA_SHADING_DRAW_GROUP_CHOICE_INL_H_
#else
#define TESSERA_SHADING_DRAW_GROUP_CHOICE_INL_H_
#endif

#include <optional>

#include "framebuffer/check.h"
#include "shading/draw_samples-inl.h"
#include "shading/points_lines-inl.h"
#include "shading/textured_group-inl.h"
#include "shading/tile_renderer.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

using DrawGroup = void (*)(TileRun&, std::uint32_t draw);

template <class Depth, Test kTest>
DrawGroup pick_by_color(Seen seen, bool sampled) {
  if (sampled) {
    switch (seen) {
      case Seen::nothing:
        return &draw_group_samples<Depth, Test::any, Seen::nothing>;  // rare: once for all tests
      case Seen::word: return &draw_group_samples<Depth, kTest, Seen::word>;
      default: return &draw_group_samples<Depth, kTest, Seen::collect>;
    }
  }
  switch (seen) {
    case Seen::nothing: return &draw_group<Depth, kTest, Seen::nothing>;
    case Seen::word: return &draw_group<Depth, kTest, Seen::word>;
    case Seen::interpolate: return &draw_group<Depth, kTest, Seen::interpolate>;
    case Seen::mix: return &draw_group<Depth, Test::any, Seen::mix>;
    default: return &draw_group<Depth, kTest, Seen::collect>;
  }
}

/// What happens to the pixels of a draw without operations.
inline Seen seen_without_operations(const TileDraw& draw) {
  if (draw.source == ColorSource::none) return Seen::nothing;
  if (draw.source == ColorSource::per_pixel || draw.deferred) return Seen::collect;
  return draw.source == ColorSource::interpolated ? Seen::interpolate : Seen::word;
}

/// What happens to those of a draw whose operations draw_group knows: a stencil test, and of colours that it
/// makes a mix by their alpha.
inline std::optional<Seen> seen_with_operations(const TileFrame& frame, const TileDraw& draw) {
  const FragmentOps& ops = *draw.ops;
  if (frame.samples > 1 || ops.alpha_test || draw.number != TileDraw::Number::none ||
      draw.offset_factor != 0 || draw.offset_units != 0 || draw.depth_offsets != nullptr)
    return std::nullopt;
  if (draw.source == ColorSource::none) return Seen::nothing;
  if (draw.deferred) return Seen::collect;
  if (draw.plain_colors) return seen_without_operations(draw);
  const ColorLayout& layout = frame.layout;
  const bool is_rgb8 = layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8 &&
                       layout.alpha_bits == 0 && !layout.luminance && !layout.index;
  if (!is_rgb8 || ops.dither || ops.logic != Logic::copy || draw.texture != nullptr ||
      (draw.source != ColorSource::interpolated && draw.source != ColorSource::constant))
    return std::nullopt;
  const bool is_plain_mix = ops.equation == Equation::add && ops.src_color == Factor::src_alpha &&
                            ops.dst_color == Factor::one_minus_src_alpha;
  return ops.blend && is_plain_mix ? std::optional(Seen::mix) : std::nullopt;
}

/// The code that runs for a draw: none of it holds a step that the draw does not have.
inline HWY_NOINLINE DrawGroup pick_draw_group(const TileFrame& frame, const TileDraw& draw) {
  if (draw.topology == Topology::points) return draw_points;
  if (draw.topology == Topology::lines) return draw_lines;
  if constexpr (kLanes > 1) {  // one lane gains nothing
    if (textures_at_once(frame, draw)) return draw_textured;
  }
  const std::optional<Seen> with_operations =
      draw.ops != nullptr ? seen_with_operations(frame, draw) : std::nullopt;
  if (draw.ops != nullptr && !with_operations)
    return frame.samples > 1 ? &draw_fragments_samples : &draw_fragments;
  const Seen seen = with_operations.value_or(seen_without_operations(draw));
  const bool less = draw.depth_test == CompareOp::less && draw.depth_write && draw.ops == nullptr,
             sampled = frame.samples > 1;
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::per_pixel);
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::interpolated ||
                 (draw.write_mask == 0xffffffffu && !draw.scaled_colors && !frame.layout.index &&
                  !frame.layout.luminance));
  if (!has_depth(frame, draw)) return pick_by_color<NoDepth, Test::any>(seen, sampled);
  switch (frame.depth_kind) {
    case DepthKind::float32:
      return less ? pick_by_color<Float32Depth, Test::less>(seen, sampled)
                  : pick_by_color<Float32Depth, Test::any>(seen, sampled);
    case DepthKind::unorm32: return pick_by_color<Unorm32Depth, Test::any>(seen, sampled);
    default:
      return less ? pick_by_color<UnormDepth, Test::less>(seen, sampled)
                  : pick_by_color<UnormDepth, Test::any>(seen, sampled);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
