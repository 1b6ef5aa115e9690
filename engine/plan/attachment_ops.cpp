#include "engine/plan/attachment_ops.h"

#include <algorithm>
#include <bit>
#include <string>

#include "engine/plan/frame_commands.h"

namespace tessera::detail {
namespace {

/// Effect of an accumulation on a buffer.
enum class BufferAccess : std::uint8_t {
  none,
  read,
  modify,
  overwrite  ///< replaces the whole buffer without reading it
};

BufferAccess color_access(const TileAccumulation& command, const PixelRect& whole) {
  const AccumOp op = command.arithmetic.op();
  if (op == AccumOp::accum || op == AccumOp::load) return BufferAccess::read;
  if (op != AccumOp::return_color) return BufferAccess::none;
  return command.write_mask == 0xffffffffu && covers(command.rect, whole) ? BufferAccess::overwrite
                                                                          : BufferAccess::modify;
}
BufferAccess accumulation_access(const TileAccumulation& command, const PixelRect& whole) {
  const AccumOp op = command.arithmetic.op();
  if (op == AccumOp::return_color) return BufferAccess::read;
  return op == AccumOp::load && covers(command.rect, whole) ? BufferAccess::overwrite : BufferAccess::modify;
}
BufferAccess no_access(const TileAccumulation&, const PixelRect&) { return BufferAccess::none; }

/// Commands that concern one buffer.
struct BufferCommands {
  bool (*is_cleared_by)(const TileClear&);
  bool (*is_drawn_by)(const DrawPlan&);
  BufferAccess (*access_of)(const TileAccumulation&, const PixelRect& whole);
};

BufferCommands commands_of(Buffer which) {
  switch (which) {
    case Buffer::color:
      return {[](const TileClear& clear) { return clear.color; },
              [](const DrawPlan& plan) { return plan.touches_color; }, color_access};
    case Buffer::depth:
      return {[](const TileClear& clear) { return clear.depth; },
              [](const DrawPlan& plan) { return plan.uses_depth; }, no_access};
    case Buffer::stencil:
      return {[](const TileClear& clear) { return clear.stencil; },
              [](const DrawPlan& plan) { return plan.uses_stencil; }, no_access};
    default:
      return {[](const TileClear& clear) { return clear.accumulation; },
              [](const DrawPlan&) { return false; }, accumulation_access};
  }
}

/// Stored values of a buffer after a clear, per plane stack.
std::array<std::uint32_t, 4> clear_values(Buffer which, const TileClear& clear, DepthFormat depth_format) {
  switch (which) {
    case Buffer::color: return {clear.packed_color};
    case Buffer::depth: return {stored_depth_from_key(depth_format, clear.depth_key)};
    case Buffer::stencil: return {static_cast<std::uint32_t>(clear.stencil_value)};
    default: return std::bit_cast<std::array<std::uint32_t, 4>>(clear.accumulation_levels);
  }
}

/// Calls one of the three functions for each command of a frame, in order.
template <class OnClear, class OnAccumulation, class OnDraw>
void for_each_command(const FrameCommands& commands, const OnClear& on_clear,
                      const OnAccumulation& on_accumulation, const OnDraw& on_draw) {
  std::size_t clear = 0;
  std::size_t accumulation = 0;
  const auto clears_before = [&](std::size_t draw, std::size_t end) {
    for (; clear < end && commands.clears[clear].before_draw <= draw; ++clear)
      on_clear(commands.clears[clear]);
  };
  for (std::size_t draw = 0; draw <= commands.plans.size(); ++draw) {
    for (; accumulation < commands.accumulations.size() &&
           commands.accumulations[accumulation].before_draw <= draw;
         ++accumulation) {
      clears_before(draw, commands.accumulations[accumulation].after_clears);
      on_accumulation(commands.accumulations[accumulation]);
    }
    clears_before(draw, commands.clears.size());
    if (draw < commands.plans.size()) on_draw(*commands.plans[draw]);
  }
}

/// Effect of the commands of a frame on one buffer.
struct BufferHistory {
  bool starts_overwritten = false;  ///< the first command replaces the whole buffer
  bool clears_are_whole = true;
  bool is_used = false;     ///< by draws or accumulations
  bool is_changed = false;  ///< by draws or accumulations
  const TileClear* last_clear = nullptr;

  bool touched() const { return is_changed || last_clear != nullptr; }
};

BufferHistory history_of(Buffer which, const FrameCommands& commands, const PixelRect& whole) {
  const BufferCommands of_buffer = commands_of(which);
  BufferHistory history;
  bool is_first = true;
  const auto note_command = [&](bool overwrites) {
    if (is_first) history.starts_overwritten = overwrites;
    is_first = false;
  };
  for_each_command(
      commands,
      [&](const TileClear& clear) {
        if (!of_buffer.is_cleared_by(clear)) return;
        note_command(covers(clear.rect, whole));
        history.clears_are_whole &= covers(clear.rect, whole);
        history.last_clear = &clear;
      },
      [&](const TileAccumulation& command) {
        const BufferAccess access = of_buffer.access_of(command, whole);
        if (access == BufferAccess::none) return;
        note_command(access == BufferAccess::overwrite);
        history.is_used = true;
        history.is_changed |= access != BufferAccess::read;
      },
      [&](const DrawPlan& plan) {
        if (!of_buffer.is_drawn_by(plan)) return;
        note_command(false);
        history.is_used = history.is_changed = true;
      });
  return history;
}

bool keeps_buffer(const FrameRecording& recording, Buffer buffer, bool touched, bool presented) {
  return recording.has_keep_list ? recording.kept[static_cast<std::size_t>(buffer)] : touched && !presented;
}

AttachmentOps plan_attachment(Buffer which, const FrameCommands& commands, FrameRecording& recording,
                              bool presented) {
  FrameBufferState& target = *recording.target;
  const BufferHistory history = history_of(which, commands, whole_buffer(target));
  const bool is_shown = presented && which == Buffer::color;
  // Error diffusion reads the finished planes.
  const bool is_diffused = is_shown && target.diffusion != nullptr && history.touched();
  const bool keep = keeps_buffer(recording, which, history.touched(), presented) || is_diffused;
  const bool keeps_clear = keep && history.last_clear != nullptr;
  AttachmentOps ops;
  if (history.is_used || is_shown || keeps_clear)
    ops.load = history.starts_overwritten ? LoadOp::dont_care : LoadOp::load;
  if (ops.loads() && target.buffer(which).content == Attachment::Content::undefined)
    throw Error(ErrorCode::invalid_state,
                "Renderer::finish: the frame starts from the " + std::string(name(which)) +
                    " buffer, which the frame before did not keep; clear the whole of it first, or keep it "
                    "with Frame::keep() in the frame before");
  if (!history.touched()) return ops;
  if (!keep) {
    ops.store = StoreOp::discard;
    return ops;
  }
  // Clears alone need no planes.
  const bool dithered =
      which == Buffer::color && history.last_clear != nullptr && history.last_clear->dithered;
  const bool ends_cleared = !history.is_changed && history.clears_are_whole && !dithered;
  ops.store = ends_cleared ? StoreOp::fast_clear : StoreOp::store;
  if (ends_cleared) ops.clear_values = clear_values(which, *history.last_clear, target.depth_format);
  return ops;
}

}  // namespace

FrameAttachments plan_attachments(const FrameCommands& commands, FrameRecording& recording, bool presented) {
  FrameAttachments attachments;
  for (const Buffer which : kBuffers)
    attachments[which] = plan_attachment(which, commands, recording, presented);
  return attachments;
}

}  // namespace tessera::detail
