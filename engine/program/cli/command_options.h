// Declares the options of `tessera render`, `explain`, `compare`, `modes`, `color`, `display`,
// `scene`, `gallery` and `selftest`.
#pragma once

#include <CLI/CLI.hpp>

#include "engine/program/cli/color_command.h"
#include "engine/program/cli/compare_command.h"
#include "engine/program/cli/display_command.h"
#include "engine/program/cli/explain_command.h"
#include "engine/program/cli/gallery_command.h"
#include "engine/program/cli/modes_command.h"
#include "engine/program/cli/render_command.h"
#include "engine/program/cli/scene_command.h"
#include "engine/program/cli/selftest_command.h"

namespace tessera::program::cli {

/// Each adds its command to `program`; parsing fills in `request`, which must outlive the program.
CLI::App* add_render(CLI::App& program, RenderRequest& request);
CLI::App* add_explain(CLI::App& program, ExplainRequest& request);
CLI::App* add_compare(CLI::App& program, CompareRequest& request);
CLI::App* add_modes(CLI::App& program, ModesRequest& request);
CLI::App* add_color(CLI::App& program, ColorRequest& request);
CLI::App* add_display(CLI::App& program, DisplayCommandRequest& request);
CLI::App* add_scene(CLI::App& program, SceneRequest& request);
CLI::App* add_gallery(CLI::App& program, GalleryRequest& request);
CLI::App* add_selftest(CLI::App& program, SelftestRequest& request);

/// Adds --import-memory and --import-seconds to a command.
void add_import_limits(CLI::App& command, ImportRequest& request);
/// Refuses these options for the built-in scene.
/// @param input  empty: the built-in scene
/// @throws UsageError
void check_import_options(const GivenOptions& given, const std::string& input);

/// Adds --size to a command.
void add_size(CLI::App& command, SceneOverrides& overrides);
/// Adds --camera and --light to a command.
void add_view(CLI::App& command, SceneOverrides& overrides);
/// Adds --display, --scale, --part, --gain and --frame-ms to a command.
void add_display_view(CLI::App& command, DisplayRequest& request);

}  // namespace tessera::program::cli
