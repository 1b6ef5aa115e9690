// Options of `tessera render` for several pictures: --frames, --turntable, --delay.
#pragma once

#include <CLI/CLI.hpp>

#include "engine/program/cli/render_command.h"

namespace tessera::program::cli {

void add_animation(CLI::App& command, RenderRequest& request);

/// Refuses names of files that each frame would overwrite, and a delay without an animated PNG.
/// @throws CLI::ValidationError
void check_animation(const RenderRequest& request);

}  // namespace tessera::program::cli
