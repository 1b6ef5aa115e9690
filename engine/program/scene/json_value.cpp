#include "engine/program/scene/json_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/program/scene/suggest.h"

namespace tessera::program::json {
namespace {

constexpr std::string_view kUnsupported = "part of the format but not supported by this version of Tessera";

// Describes a value in one line: scalars verbatim, objects and arrays by kind and size.
std::string description(const Json& json) {
  constexpr std::size_t kMaxShownLength = 60;
  if (json.is_object()) return json.contains("keys") ? "an object with \"keys\"" : "an object";
  if (json.is_array()) return json.empty() ? "an empty array" : "an array of " + std::to_string(json.size());
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kMaxShownLength) text = text.substr(0, kMaxShownLength) + "...";
  return text;
}

std::string short_number(double x) {
  return Json(x == std::floor(x) && std::abs(x) < 1e15 ? Json(static_cast<std::int64_t>(x)) : Json(x)).dump();
}

}  // namespace

std::string quoted_list(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return list;
}

std::string Value::pointer_to(const std::string& key) const {
  std::string pointer = pointer_ + "/";
  for (const char c : key) {
    if (c == '~') pointer += "~0";
    else if (c == '/') pointer += "~1";
    else pointer += c;
  }
  return pointer;
}

void Value::fail(std::string_view expected) const {
  refuse("found " + description(*json_) + ", expected " + std::string(expected));
}

void Value::refuse(std::string_view message, ErrorCode code) const {
  throw Error(code,
              *file_ + ": " + (pointer_.empty() ? "(top level)" : pointer_) + ": " + std::string(message));
}

double Value::number() const {
  if (!json_->is_number()) fail("a number");
  const double x = json_->get<double>();
  if (!std::isfinite(x)) fail("a finite number");
  return x;
}

double Value::number(double min_value, double max_value) const {
  const double x = number();
  if (!(x >= min_value && x <= max_value))
    fail("a number from " + short_number(min_value) + " to " + short_number(max_value));
  return x;
}

float Value::real() const {
  constexpr double kMaxFloat = std::numeric_limits<float>::max();
  const double x = number();
  if (std::abs(x) > kMaxFloat) fail("a number that a 32-bit float can hold");
  return static_cast<float>(x);
}

std::int64_t Value::integer(std::int64_t min_value, std::int64_t max_value) const {
  const double x = number();
  if (x != std::floor(x) || x < static_cast<double>(min_value) || x > static_cast<double>(max_value))
    fail("an integer from " + std::to_string(min_value) + " to " + std::to_string(max_value));
  return static_cast<std::int64_t>(x);
}

bool Value::boolean() const {
  if (!json_->is_boolean()) fail("true or false");
  return json_->get<bool>();
}

const std::string& Value::text() const {
  if (!json_->is_string()) fail("a string");
  return json_->get_ref<const std::string&>();
}

std::size_t Value::size() const {
  if (!json_->is_array()) fail("an array");
  return json_->size();
}

void Value::expect_numbers(std::size_t count) const {
  if (!json_->is_array() || json_->size() != count) fail("an array of " + std::to_string(count) + " numbers");
}

Vec3 Value::vec3() const {
  const auto n = numbers<3>();
  return {n[0], n[1], n[2]};
}

Color Value::color() const {
  expect_numbers(4);
  return {element(0).real(), element(1).real(), element(2).real(), element(3).real()};
}

Color Value::color(double min_value, double max_value) const {
  expect_numbers(4);
  return {element(0).real(min_value, max_value), element(1).real(min_value, max_value),
          element(2).real(min_value, max_value), element(3).real(min_value, max_value)};
}

Matrix Value::matrix() const { return {numbers<16>()}; }

Rect Value::rect() const {
  constexpr std::int64_t kMaxCoordinate = 1 << 20;  // beyond any buffer; corner + size cannot overflow
  if (!json_->is_array() || json_->size() != 4) fail("[x, y, width, height]");
  const auto at = [&](std::size_t i, std::int64_t min_value) {
    return static_cast<int>(element(i).integer(min_value, kMaxCoordinate));
  };
  return {at(0, -kMaxCoordinate), at(1, -kMaxCoordinate), at(2, 0), at(3, 0)};
}

void Value::refuse_choice(const std::vector<std::string_view>& names) const {
  const std::string expected = (names.size() == 1 ? "" : "one of ") + quoted_list(names);
  if (!json_->is_string()) fail(expected);
  fail(expected + did_you_mean(text(), names));
}

Object::Object(const Value& value, std::initializer_list<std::string_view> keys) : value_(value) {
  if (!value.json().is_object()) value.fail("an object");
  const std::vector<std::string_view> all(keys);
  for (const auto& [key, unused] : value.json().items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const Value member = value.member(key);
    const std::string suggestion = did_you_mean(key, all);
    const std::string known = (keys.size() == 1 ? ", expected " : ", expected one of ") + quoted_list(keys);
    member.refuse("unknown key \"" + key + "\"" + (suggestion.empty() ? known : suggestion));
  }
}

std::optional<Value> Object::find(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  return value_.member(key);
}

Value Object::require(const std::string& key) const {
  if (!has(key)) value_.refuse("key \"" + key + "\" is missing");
  return value_.member(key);
}

}  // namespace tessera::program::json
