// The alpha of a draw's fragments, where the state and the data of the draw determine it.
#pragma once

#include <optional>
#include <string_view>

#include "engine/record/recording.h"
#include "shading/fragment_ops.h"

namespace tessera::detail {

/// The alpha of all fragments of a draw.
struct EqualAlpha {
  float value = 1;         ///< 0 to 1
  std::string_view cause;  ///< the field that it comes from
};

/// Null if alpha differs or is unknown. Exact: interpolation keeps a constant, and products with an opaque
/// texel change nothing. RGB buffers only. If alpha is that of the vertices, all of their colours are finite.
std::optional<EqualAlpha> equal_fragment_alpha(const RecordedDraw& draw);

/// Replaces factors that depend on source alpha alone by `zero` or `one`, if alpha is 0 or 1.
/// Exact: s * 1 + d * 0 is s, and s * 0 + d * 1 is d.
void fold_alpha(FragmentOps& ops, float alpha);

}  // namespace tessera::detail
