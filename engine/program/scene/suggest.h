// "Did you mean ...": the nearest known name to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tessera::program {

/// The candidate with the fewest changed, missing, added or swapped letters; empty if none is near (a third
/// of the length).
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> candidates);

/// `; did you mean "x"?`, or nothing.
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> candidates);

}  // namespace tessera::program
