// Fragment operations of a draw. Operations without effect are left out.
#pragma once

#include "engine/buffers/frame_buffer_state.h"
#include "shading/effect_notes.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

struct FragmentPlan {
  FragmentOps ops;
  bool needed = false;           ///< false: fragments only have a depth test
  bool is_stencil_only = false;  ///< `ops` is a stencil test and nothing else
  bool uses_stencil = false;
};

/// Operations that dither for a buffer, and do nothing else.
FragmentOps dither_ops(const FrameBufferState& target);

/// @param writes_color  a colour plane may change
/// @param only_indices  colour indices are stored, which are not dithered
/// @param notes  receives the operations
FragmentPlan plan_fragments(const DrawState& state, const FrameBufferState& target, bool writes_color,
                            bool only_indices, const EffectNotes& notes);

}  // namespace tessera::detail
