// Strict, typed reading of JSON. A Value carries its file and JSON pointer, so that each error names the
// file, the pointer, what was found and what was expected.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::json {

using Json = nlohmann::ordered_json;  // keeps the order of the file, in which meshes are drawn

/// Parses JSON with comments.
/// @throws Error with line and column for a syntax error; with the pointer for a key that occurs twice in one
///   object and for nesting beyond 64 levels
Json parse(std::string_view text, const std::string& file);

class Value {
 public:
  Value(const Json& json, std::string pointer, const std::string& file)
      : json_(&json), pointer_(std::move(pointer)), file_(&file) {}

  const Json& json() const { return *json_; }
  const std::string& pointer() const { return pointer_; }
  const std::string& file() const { return *file_; }
  Value element(std::size_t i) const { return {(*json_)[i], pointer_ + "/" + std::to_string(i), *file_}; }
  /// The member must exist.
  Value member(const std::string& key) const { return {json_->at(key), pointer_to(key), *file_}; }
  /// Calls take(key, value) for each member of an object with arbitrary keys, in the order of the file.
  template <class Take>
  void for_each_member(const Take& take) const {
    if (!json_->is_object()) fail("an object");
    for (const auto& [key, json] : json_->items()) take(key, Value(json, pointer_to(key), *file_));
  }

  /// @throws Error "file: pointer: found ..., expected ..."
  [[noreturn]] void fail(std::string_view expected) const;
  /// @throws Error "file: pointer: message"
  [[noreturn]] void refuse(std::string_view message, ErrorCode code = ErrorCode::invalid_argument) const;

  double number() const;
  double number(double min_value, double max_value) const;
  float real() const;  ///< a number within the range of float
  float real(double min_value, double max_value) const {
    return static_cast<float>(number(min_value, max_value));
  }
  std::int64_t integer(std::int64_t min_value, std::int64_t max_value) const;
  bool boolean() const;
  const std::string& text() const;
  /// Returns the length of an array.
  std::size_t size() const;

  template <std::size_t N>
  std::array<double, N> numbers() const {
    expect_numbers(N);
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = element(i).number();
    return result;
  }
  Vec3 vec3() const;
  Color color() const;  ///< any four numbers within the range of float
  Color color(double min_value, double max_value) const;
  Matrix matrix() const;
  Rect rect() const;  ///< four integers; width and height at least 0

  /// Returns the value of one of `names`.
  template <class Enum>
  Enum choice(std::initializer_list<std::pair<std::string_view, Enum>> names) const {
    std::vector<std::string_view> all;
    for (const auto& [name, value] : names) {
      if (json_->is_string() && name == json_->get_ref<const std::string&>()) return value;
      all.push_back(name);
    }
    refuse_choice(all);
  }

  template <class Enum, std::size_t count>
  Enum choice(const std::array<std::pair<std::string_view, Enum>, count>& names) const {
    std::vector<std::string_view> all;
    for (const auto& [name, value] : names) {
      if (json_->is_string() && name == json_->get_ref<const std::string&>()) return value;
      all.push_back(name);
    }
    refuse_choice(all);
  }

  /// Returns make(); an Error that it throws is rethrown with file and pointer of this value.
  template <class Make>
  auto checked(const Make& make) const {
    try {
      return make();
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      refuse(error.what(), error.code());
    }
  }

 private:
  std::string pointer_to(const std::string& key) const;  // escaped by RFC 6901
  void expect_numbers(std::size_t count) const;
  [[noreturn]] void refuse_choice(const std::vector<std::string_view>& names) const;

  const Json* json_;
  std::string pointer_;
  const std::string* file_;  // outlives all values
};

/// The members of an object.
class Object {
 public:
  /// @throws Error for a value other than an object, and for an unknown key
  Object(const Value& value, std::initializer_list<std::string_view> keys);

  const Value& value() const { return value_; }
  bool has(const std::string& key) const { return value_.json().contains(key); }
  std::optional<Value> find(const std::string& key) const;
  Value require(const std::string& key) const;

 private:
  Value value_;
};

/// Returns the names in quotes, separated by commas.
std::string quoted_list(std::span<const std::string_view> names);

}  // namespace tessera::program::json
