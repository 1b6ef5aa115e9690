// Values of the parameters of displays as text, and their ranges.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "framebuffer/display/display_parameter_table.h"

namespace tessera::detail {

/// The shortest decimal text that reads back as the same number.
std::string number_text(double number);

/// The values that a parameter takes: "0.05 to 5", "0.02 to 5 or auto", "none, dots, slots, grille".
std::string values_text(const Parameter& parameter);

/// The text of a value: "0.28", "auto", "dots", "1+2+4". Values that no text has are written as numbers.
std::string value_text(const Parameter& parameter, const Numbers& value);

/// The value of a text; absent if it is malformed or out of range.
std::optional<Numbers> parse_value(const Parameter& parameter, std::string_view text);

/// Returns whether a value is in range; NaN is not.
bool is_valid(const Parameter& parameter, const Numbers& value);

}  // namespace tessera::detail
