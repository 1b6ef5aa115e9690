// Options of `tessera render` and `explain` that have no effect on a scene.
#pragma once

#include "engine/program/cli/given_options.h"
#include "engine/program/cli/scene_input.h"

namespace tessera::program::cli {

/// Refuses given options that change nothing in the scene.
/// @param input  with the options applied
/// @throws UsageError
void check_override_effects(const GivenOptions& given, const SceneInput& input);

}  // namespace tessera::program::cli
