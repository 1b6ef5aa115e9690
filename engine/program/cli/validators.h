// Checks of option values, with messages "found ..., expected ...".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace tessera::program::cli {

using Names = std::vector<std::string_view>;

CLI::Validator one_of(const Names& names);

/// Rewrites the value as a plain decimal number: CLI11 would read a leading 0 as octal.
CLI::Validator integer_from(int min_value, int max_value);

/// Accepts finite decimal numbers.
CLI::Validator number_from(double min_value, double max_value);

/// A finite number above 0.
CLI::Validator positive_number();

/// Distinguishes an empty value from an option that is not given.
CLI::Validator not_empty(const std::string& expected);

}  // namespace tessera::program::cli
