// The text of the notes about a draw's effects.
#pragma once

#include <span>
#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// One line per note, each "  effect: what happens, and why\n".
std::string explain_text(std::span<const EffectNote> notes);

}  // namespace tessera::detail
