#include "engine/plan/live_commands.h"

#include <algorithm>

#include "engine/plan/draw_plan.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kColor = static_cast<std::size_t>(Buffer::color);
constexpr std::size_t kDepth = static_cast<std::size_t>(Buffer::depth);
constexpr std::size_t kStencil = static_cast<std::size_t>(Buffer::stencil);
constexpr std::size_t kAccumulation = static_cast<std::size_t>(Buffer::accumulation);

bool covers_buffer(const std::optional<Rect>& scissor, const FrameBufferState& target) {
  return !scissor || covers(raster_rect(*scissor, target.format.height), whole_buffer(target));
}

/// The walk, from the last command to the first.
class BackwardWalk {
 public:
  BackwardWalk(const FrameBufferState& target, BufferFlags read_at_end)
      : target_(target), is_read_(read_at_end) {}

  /// Whether the draw's result is read. Draws change pixels here and there, so they replace no buffer.
  bool visit(const DrawState& state) {
    const bool has_depth = state.depth.enabled && target_.depth_format != DepthFormat::none;
    const bool has_stencil = state.stencil && target_.format.stencil_bits > 0;
    const bool changes_color = write_mask(state.color_mask, plane_mask(state, target_), target_.layout) != 0;
    const bool is_live = (changes_color && is_read_[kColor]) ||
                         (has_depth && state.depth.write && is_read_[kDepth]) ||
                         (has_stencil && is_read_[kStencil]);
    if (!is_live) return false;
    // The tests decide which pixels change.
    is_read_[kDepth] |= has_depth;
    is_read_[kStencil] |= has_stencil;
    return true;
  }

  /// The buffers for which the clear is read.
  BufferFlags visit(const Clear& clear) {
    BufferFlags flags{clear.color || clear.index, clear.depth.has_value(), clear.stencil.has_value(),
                      clear.accumulation.has_value()};
    const bool replaces = covers_buffer(clear.scissor, target_);
    for (std::size_t k = 0; k < flags.size(); ++k) {
      flags[k] = flags[k] && is_read_[k];
      if (flags[k] && replaces) is_read_[k] = false;
    }
    return flags;
  }

  bool visit(const Accum& accum) {
    const bool is_return = accum.op == AccumOp::return_color;
    const std::size_t changed = is_return ? kColor : kAccumulation;
    if (!is_read_[changed]) return false;
    const bool changes_all = is_return && write_mask(accum.color_mask, ~0u, target_.layout) == ~0u;
    const bool replaces = changes_all || accum.op == AccumOp::load;
    if (replaces && covers_buffer(accum.scissor, target_)) is_read_[changed] = false;
    if (is_return) is_read_[kAccumulation] = true;
    if (accum.op == AccumOp::accum || accum.op == AccumOp::load) is_read_[kColor] = true;
    return true;
  }

 private:
  const FrameBufferState& target_;
  BufferFlags is_read_;
};

}  // namespace

void find_live_commands(LiveCommands& live, const FrameRecording& recording, BufferFlags read_at_end) {
  live.draws.assign(recording.draws.size(), 0);
  live.clears.assign(recording.clears.size(), {});
  live.accumulations.assign(recording.accumulations.size(), 0);
  BackwardWalk walk(*recording.target, read_at_end);
  std::size_t clears = recording.clears.size(), accumulations = recording.accumulations.size();
  for (std::size_t draw = recording.draws.size() + 1; draw-- > 0;) {
    if (draw < recording.draws.size()) live.draws[draw] = walk.visit(recording.draws[draw].state);
    // The commands between this draw and the one before it, the last one first.
    for (;;) {
      const bool has_clear = clears > 0 && recording.clears[clears - 1].before_draw >= draw;
      const bool has_accumulation =
          accumulations > 0 && recording.accumulations[accumulations - 1].before_draw >= draw;
      if (!has_clear && !has_accumulation) break;
      const bool clear_is_last =
          has_clear &&
          (!has_accumulation || clears > recording.accumulations[accumulations - 1].after_clears);
      if (clear_is_last) {
        --clears;
        live.clears[clears] = walk.visit(recording.clears[clears].clear);
      } else {
        --accumulations;
        live.accumulations[accumulations] = walk.visit(recording.accumulations[accumulations].accum);
      }
    }
  }
}

BufferFlags buffers_after_frame(const FrameRecording& recording) {
  BufferFlags flags;
  flags.fill(true);
  if (!recording.has_keep_list) return flags;
  flags = recording.kept;
  flags[kColor] = true;  // the picture
  return flags;
}

}  // namespace tessera::detail
