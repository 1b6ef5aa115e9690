// Explanations of a recorded frame: the effects of its draws, and what happens to its buffers.
#include <deque>
#include <string>

#include "engine/plan/draw_plan.h"
#include "engine/plan/explain_text.h"
#include "engine/plan/frame_commands.h"
#include "engine/plan/tile_draws.h"
#include "engine/record/recording.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"

namespace tessera {
using namespace detail;
namespace {

void check_draw_index(const char* function, std::size_t index, std::size_t draws) {
  if (index < draws) return;
  throw Error(ErrorCode::invalid_argument, std::string(function) + ": draw " + std::to_string(index) +
                                               " does not exist, the frame has " + std::to_string(draws) +
                                               " draws, counted from 0");
}

bool is_in_format(const FrameBufferFormat& format, Buffer buffer) {
  switch (buffer) {
    case Buffer::color: return true;
    case Buffer::depth: return format.depth != DepthFormat::none;
    case Buffer::stencil: return format.stencil_bits > 0;
    case Buffer::accumulation: return format.accumulation_bits > 0;
  }
  return false;
}

BufferReason reason_of(const AttachmentOps& ops) {
  switch (ops.store) {
    case StoreOp::none: return ops.used() ? BufferReason::unchanged : BufferReason::not_used;
    case StoreOp::store: return BufferReason::kept;
    case StoreOp::fast_clear: return BufferReason::ends_cleared;
    case StoreOp::discard: return ops.used() ? BufferReason::not_kept : BufferReason::not_used;
  }
  return BufferReason::not_used;
}

/// Whether what the draw changes may be read by a later command or after the frame.
bool is_read_later(const FrameRecording& recording, std::size_t draw) {
  LiveCommands live;
  find_live_commands(live, recording, buffers_after_frame(recording));
  return live.draws[draw] != 0;
}

/// Plans a draw for its notes.
void explain_draw(DrawPlan& plan, const FrameRecording& recording, std::size_t draw,
                  std::vector<EffectNote>& list) {
  const EffectNotes notes(&list);
  plan_draw(plan, recording.draws[draw], *recording.target, {}, notes);
  if (plan.is_noop || plan.is_left_out || is_read_later(recording, draw)) return;
  plan.is_left_out = true;
  notes.skipped(Effect::draw, EffectReason::never_read);
}

}  // namespace

std::vector<EffectNote> Frame::effects(std::size_t draw_index) const {
  check_draw_index("Frame::effects", draw_index, recording_->draws.size());
  return translate_bad_alloc("Frame::effects", [&] {
    const FloatingPointMode mode;
    std::vector<EffectNote> notes;
    DrawPlan plan;
    explain_draw(plan, *recording_, draw_index, notes);
    return notes;
  });
}

DrawExplanation Frame::explanation(std::size_t draw_index) const {
  check_draw_index("Frame::explanation", draw_index, recording_->draws.size());
  return translate_bad_alloc("Frame::explanation", [&] {
    const FloatingPointMode mode;
    const RecordedDraw& draw = recording_->draws[draw_index];
    std::vector<EffectNote> notes;
    DrawPlan plan;
    explain_draw(plan, *recording_, draw_index, notes);
    DrawExplanation explanation;
    for (const EffectNote& note : notes)
      explanation.effects.push_back({.note = note, .cause = cause_of(note), .text = text_of(note)});
    for (const PixelPath& path : pixel_paths_of(draw, plan, *recording_->target))
      explanation.code_paths.push_back(describe(path));
    return explanation;
  });
}

std::string Frame::explain(std::size_t draw_index) const {
  check_draw_index("Frame::explain", draw_index, recording_->draws.size());
  return translate_bad_alloc("Frame::explain", [&] {
    const DrawExplanation explanation = this->explanation(draw_index);
    std::string text;
    for (const EffectExplanation& effect : explanation.effects) text += "  " + effect.text + "\n";
    for (const std::string& path : explanation.code_paths) text += "  code path: " + path + "\n";
    return text;
  });
}

std::vector<BufferNote> Frame::buffers(bool presented) const {
  return translate_bad_alloc("Frame::buffers", [&] {
    const FloatingPointMode mode;
    FrameCommands commands;
    std::deque<DrawBuffers> draw_buffers;
    plan_frame(commands, *recording_, presented, {}, draw_buffers, nullptr);
    std::vector<BufferNote> notes;
    for (const Buffer buffer : kBuffers) {
      const AttachmentOps& ops = commands.attachments[buffer];
      BufferNote note{.buffer = buffer,
                      .in_tiles = ops.used(),
                      .loaded = ops.loads(),
                      .stored = ops.stores(),
                      .reason = reason_of(ops)};
      if (!is_in_format(recording_->target->format, buffer)) note.reason = BufferReason::not_in_format;
      notes.push_back(note);
    }
    return notes;
  });
}

}  // namespace tessera
