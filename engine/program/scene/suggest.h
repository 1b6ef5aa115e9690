// Suggests the known name nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tessera::program {

/// Returns the candidate with the fewest changed, missing, added or swapped letters; empty if these are more
/// than a third of the letters typed, and for single letters.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> candidates);

/// Returns `; did you mean "x"?`, or nothing.
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> candidates);

}  // namespace tessera::program
