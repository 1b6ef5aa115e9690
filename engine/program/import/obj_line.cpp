#include "engine/program/import/obj_line.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }

void skip_spaces(std::string_view& text) {
  std::size_t spaces = 0;
  while (spaces < text.size() && is_space(text[spaces])) ++spaces;
  text.remove_prefix(spaces);
}

/// Removes the first word of the text; empty at the end and before a comment.
std::string_view take_word(std::string_view& text) {
  skip_spaces(text);
  std::size_t length = 0;
  if (!text.starts_with('#'))
    while (length < text.size() && !is_space(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

/// A number in the range of floats: coordinates are stored as such.
std::optional<double> finite_number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double x = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  if (!is_number || !(std::abs(x) <= std::numeric_limits<float>::max())) return std::nullopt;
  return x;
}

}  // namespace

ObjLine::ObjLine(std::string_view text, const std::string& file, std::size_t number)
    : rest_(text), keyword_(take_word(rest_)), file_(&file), number_(number) {}

std::string_view ObjLine::word() { return take_word(rest_); }

std::optional<double> ObjLine::find_number() {
  std::string_view after = rest_;
  const std::optional<double> number = finite_number_of(take_word(after));
  if (number) rest_ = after;
  return number;
}

double ObjLine::number() { return number_in(word(), 0, 1); }

std::array<double, 3> ObjLine::three_numbers() {
  std::array<double, 3> numbers{};
  for (int i = 0; i < 3; ++i) numbers[static_cast<std::size_t>(i)] = number_in(word(), i, 3);
  return numbers;
}

double ObjLine::number_in(std::string_view word, int numbers_before, int expected) const {
  if (word.empty())
    fail("\"" + std::string(keyword_) + "\" has " + std::to_string(numbers_before) + " numbers, expected " +
         std::to_string(expected));
  const std::optional<double> number = finite_number_of(word);
  if (!number)
    fail("found \"" + std::string(word.substr(0, 40)) + "\" after \"" + std::string(keyword_) +
         "\", expected a finite number");
  return *number;
}

std::string_view ObjLine::rest() const {
  std::string_view rest = rest_;
  skip_spaces(rest);
  while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
  return rest;
}

void ObjLine::fail(const std::string& message) const {
  throw Error(*file_ + ":" + std::to_string(number_) + ": " + message);
}

ObjLinePart take_line(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
  ObjLinePart line{.text = text.substr(0, end), .is_continued = false};
  text.remove_prefix(std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size()));
  line.is_continued = line.text.ends_with('\\');
  if (line.is_continued) line.text.remove_suffix(1);
  return line;
}

bool is_obj_comment(std::string_view line) {
  skip_spaces(line);
  return line.starts_with('#');
}

}  // namespace tessera::program
