// The parameters of displays as one table, which parsing, checking and listing read.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "framebuffer/tessera/display.hpp"

namespace tessera::detail {

/// The value of a parameter: one number, for lists several. Enumerators are numbers, too.
using Numbers = std::vector<double>;

struct NumberRange {
  double min = 0, max = 1;
  std::optional<double> automatic{};  ///< outside of the range; written "auto"
  std::size_t max_count = 1;          ///< above 1: a list, joined by "+"
};

/// A word and the number that it means.
struct Word {
  std::string_view text;
  double number = 0;
};

/// Reads and writes a member of Display.
struct MemberAccess {
  Numbers (*get)(const Display& display);
  void (*set)(Display& display, const Numbers& value);
};

struct Parameter {
  std::string_view name, unit;
  std::variant<NumberRange, std::span<const Word>> values;
  MemberAccess member;
  std::string_view description, source;
};

/// The parameters of a kind, in the order of lists.
std::vector<Parameter> parameter_table(DisplayKind kind);

}  // namespace tessera::detail
