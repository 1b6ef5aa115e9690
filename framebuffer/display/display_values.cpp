#include "framebuffer/display/display_values.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace tessera::detail {
namespace {

constexpr std::string_view kAutomatic = "auto";

bool is_valid(const NumberRange& range, const Numbers& value) {
  if (range.automatic && value.size() == 1 && value.front() == *range.automatic) return true;
  return !value.empty() && value.size() <= range.max_count &&
         std::all_of(value.begin(), value.end(), [&](double n) { return n >= range.min && n <= range.max; });
}
bool is_valid(std::span<const Word> words, const Numbers& value) {
  return value.size() == 1 &&
         std::any_of(words.begin(), words.end(), [&](Word word) { return word.number == value.front(); });
}

std::string values_text(const NumberRange& range) {
  std::string text = number_text(range.min) + " to " + number_text(range.max);
  if (range.max_count > 1)
    text = "1 to " + std::to_string(range.max_count) + " numbers joined by +, each " + text;
  if (range.automatic) text += " or " + std::string(kAutomatic);
  return text;
}
std::string values_text(std::span<const Word> words) {
  std::string text;
  for (const Word& word : words) text += (text.empty() ? "" : ", ") + std::string(word.text);
  return text;
}

std::string numbers_text(const Numbers& value) {
  if (value.empty()) return "none";
  std::string text;
  for (const double number : value) text += (text.empty() ? "" : "+") + number_text(number);
  return text;
}
std::string value_text(const NumberRange& range, const Numbers& value) {
  const bool is_automatic = range.automatic && value.size() == 1 && value.front() == *range.automatic;
  return is_automatic ? std::string(kAutomatic) : numbers_text(value);
}
std::string value_text(std::span<const Word> words, const Numbers& value) {
  for (const Word& word : words)
    if (value.size() == 1 && word.number == value.front()) return std::string(word.text);
  return numbers_text(value);
}

std::optional<double> parse_number(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(number) : std::nullopt;
}

std::optional<Numbers> parse_value(const NumberRange& range, std::string_view text) {
  if (range.automatic && text == kAutomatic) return Numbers{*range.automatic};
  Numbers value;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    const auto number = parse_number(text.substr(begin, end - begin));
    if (!number || !(*number >= range.min && *number <= range.max)) return std::nullopt;
    value.push_back(*number);
    begin = end + 1;
  }
  return value.size() <= range.max_count ? std::optional(value) : std::nullopt;
}
std::optional<Numbers> parse_value(std::span<const Word> words, std::string_view text) {
  for (const Word& word : words)
    if (word.text == text) return Numbers{word.number};
  return std::nullopt;
}

}  // namespace

std::string number_text(double number) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return error == std::errc() ? std::string(text, end) : std::string();
}

std::string values_text(const Parameter& parameter) {
  return std::visit([](const auto& values) { return values_text(values); }, parameter.values);
}

std::string value_text(const Parameter& parameter, const Numbers& value) {
  return std::visit([&](const auto& values) { return value_text(values, value); }, parameter.values);
}

std::optional<Numbers> parse_value(const Parameter& parameter, std::string_view text) {
  return std::visit([&](const auto& values) { return parse_value(values, text); }, parameter.values);
}

bool is_valid(const Parameter& parameter, const Numbers& value) {
  return std::visit([&](const auto& values) { return is_valid(values, value); }, parameter.values);
}

}  // namespace tessera::detail
