// Options that stand in place of what a scene says.
#pragma once

#include <string>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

// Each is false, and the overrides are not to be used, for a text of another form.

/// "640x480"
bool parse_size(const std::string& text, SceneOverrides& overrides);
/// "EX,EY,EZ,TX,TY,TZ" or with a vertical angle in degrees after it: the eye and what it looks at.
bool parse_camera(const std::string& text, SceneOverrides& overrides);
/// "X,Y,Z" or "X,Y,Z,W": adds a white light.
bool parse_light(const std::string& text, SceneOverrides& overrides);

}  // namespace tessera::program::cli
