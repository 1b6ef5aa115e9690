// Plan of a draw's fragment operations. Operations without effect are left out.
#pragma once

#include <optional>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/plan/alpha_facts.h"
#include "shading/effect_notes.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

struct FragmentPlan {
  FragmentOps ops;
  bool needed = false;           ///< false: fragments go through the depth test alone
  bool is_stencil_only = false;  ///< `ops` is a stencil test and nothing else
  bool uses_stencil = false;     ///< tests or writes the stencil buffer
  bool only_dithers = false;     ///< `ops` has a dither, and nothing else
  bool is_elided = false;        ///< an operation is left out because of the fragments' alpha
};

/// Plans the operations that have an effect.
/// @param writes_color  a colour plane may change
/// @param only_indices  colour indices are stored, which are not dithered
/// @param alpha         alpha of all fragments, if it is known
/// @param notes         receives the operations, and reasons why others are skipped
FragmentPlan plan_fragments(const DrawState& state, const FrameBufferState& target, bool writes_color,
                            bool only_indices, const std::optional<EqualAlpha>& alpha,
                            const EffectNotes& notes);

/// Whether blending leaves every stored colour as it is, for fragments of this alpha.
/// Requires that a stored colour survives the conversion to floats and back: RGB of at most 8 bits per
/// component, without dither or logic operation.
bool keeps_stored_colors(const DrawState& state, const FrameBufferState& target, float alpha);

}  // namespace tessera::detail
