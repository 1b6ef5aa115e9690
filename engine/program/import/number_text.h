// Numbers of model files in text.
#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace tessera::program {

/// Returns the number that a word is, in any notation of C without hexadecimals; also inf and nan. Numbers
/// beyond doubles become infinite or 0.
inline std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) number = std::strtod(std::string(word).c_str(), nullptr);
  return number;
}

/// A word as error messages quote it: at most 40 bytes.
inline std::string quoted(std::string_view word) {
  return word.empty() ? "the end of the file" : "\"" + std::string(word.substr(0, 40)) + "\"";
}

}  // namespace tessera::program
