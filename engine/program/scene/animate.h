// Numbers that change over time: {"keys": [[t, value], ...]}, linear in between, the first and last value
// before and after.
#pragma once

#include "engine/program/scene/json_value.h"

namespace tessera::program::json {

/// Puts in place of all keys their values at `time`; true if there were any.
/// @throws Error, naming file and pointer, for keys that are no list of [t, value] with rising t.
bool animate(Json& json, double time, const std::string& file);

}  // namespace tessera::program::json
