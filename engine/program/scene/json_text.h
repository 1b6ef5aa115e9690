// JSON as text that people read and edit.
#pragma once

#include <string>

#include "engine/program/scene/json_value.h"

namespace tessera::program::json {

/// Returns the float as the number with the fewest digits that is read back as the same float.
/// @pre x is finite
Json number(float x);

/// Returns JSON text of at most about 100 columns.
/// - What fits is on one line; longer lists of numbers are wrapped; other lists and objects have one line per
///   element.
/// - Invalid UTF-8 becomes U+FFFD.
std::string readable_text(const Json& json);

}  // namespace tessera::program::json
