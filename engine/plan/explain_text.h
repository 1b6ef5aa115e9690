// Notes about a draw's effects as text.
#pragma once

#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// "effect: what happens, and why", without the end of the line.
std::string text_of(const EffectNote& note);

/// EffectNote::cause, or the field that decides about the effect: "lights[2].spot_cutoff", "mesh.normals".
std::string cause_of(const EffectNote& note);

}  // namespace tessera::detail
