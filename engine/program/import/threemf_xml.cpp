#include "engine/program/import/threemf_xml.h"

#include <cmath>
#include <sstream>
#include <vector>

#include "engine/program/import/number_text.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::threemf {
namespace {

[[noreturn]] void fail(const pugi::xml_node& element, std::string_view name, const std::string& found,
                       const std::string& expected) {
  throw Error("<" + std::string(element.name()) + "> has the " + std::string(name) + " \"" +
              found.substr(0, 40) + "\", expected " + expected);
}

}  // namespace

std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

std::optional<std::string> find_attribute(const pugi::xml_node& element, std::string_view name) {
  for (const pugi::xml_attribute& attribute : element.attributes())
    if (local_name(attribute.name()) == name) return attribute.value();
  return std::nullopt;
}

std::string required_attribute(const pugi::xml_node& element, std::string_view name) {
  if (auto value = find_attribute(element, name)) return *value;
  throw Error("<" + std::string(element.name()) + "> lacks the attribute \"" + std::string(name) + "\"");
}

double number_attribute(const pugi::xml_node& element, std::string_view name) {
  const std::string text = required_attribute(element, name);
  const std::optional<double> value = number_of(text);
  if (!value || !std::isfinite(*value)) fail(element, name, text, "a finite number");
  return *value;
}

std::size_t index_attribute(const pugi::xml_node& element, std::string_view name) {
  const std::string text = required_attribute(element, name);
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(element, name, text, "an integer of 0 or more");
  return value;
}

pugi::xml_node child(const pugi::xml_node& element, std::string_view name) {
  for (const pugi::xml_node& node : element.children())
    if (local_name(node.name()) == name) return node;
  return {};
}

std::array<double, 3> Affine::operator()(const std::array<double, 3>& p) const {
  std::array<double, 3> to;
  for (std::size_t k = 0; k < 3; ++k) to[k] = p[0] * m[k] + p[1] * m[3 + k] + p[2] * m[6 + k] + m[9 + k];
  return to;
}

bool Affine::mirrors() const {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
             m[2] * (m[3] * m[7] - m[4] * m[6]) <
         0;
}

Affine concatenated(const Affine& first, const Affine& second) {
  Affine product;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = row == 3 ? second.m[9 + k] : 0;
      for (std::size_t j = 0; j < 3; ++j) sum += first.m[3 * row + j] * second.m[3 * j + k];
      product.m[3 * row + k] = sum;
    }
  return product;
}

Affine transform(const pugi::xml_node& element) {
  const std::optional<std::string> text = find_attribute(element, "transform");
  if (!text) return {};
  std::istringstream words(*text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(number_of(word).value_or(NAN));
  Affine affine;
  bool is_valid = numbers.size() == affine.m.size();
  for (std::size_t i = 0; is_valid && i < affine.m.size(); ++i) {
    affine.m[i] = numbers[i];
    is_valid = std::isfinite(numbers[i]);
  }
  if (!is_valid) fail(element, "transform", *text, "12 finite numbers");
  return affine;
}

}  // namespace tessera::program::threemf
