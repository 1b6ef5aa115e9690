// Numbers that change over time: {"keys": [[t, value], ...]}. Linear between keys, constant before the first
// and after the last.
#pragma once

#include "engine/program/scene/json_value.h"

namespace tessera::program::json {

/// Replaces all keys by their values at `time`.
/// @return whether there were any
/// @throws Error, naming file and pointer, for keys other than a list of [t, value] with rising t
bool animate(Json& json, double time, const std::string& file);

}  // namespace tessera::program::json
