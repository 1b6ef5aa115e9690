// Which operations the fragments of a draw need: what changes nothing is left out.
#pragma once

#include "engine/buffers/frame_buffer_state.h"
#include "shading/effect_notes.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

struct FragmentPlan {
  FragmentOps ops;
  bool needed = false;           ///< else fragments go by the short way
  bool is_stencil_only = false;  ///< and nothing else
  bool uses_stencil = false;
};

/// The dither of a buffer, and nothing else.
FragmentOps dither_ops(const FrameBufferState& target);

/// @param writes_color  some colour plane may change
/// @param only_indices  what is written are indices, which nothing dithers
/// @param notes  receives the operations
FragmentPlan plan_fragments(const DrawState& state, const FrameBufferState& target, bool writes_color,
                            bool only_indices, const EffectNotes& notes);

}  // namespace tessera::detail
