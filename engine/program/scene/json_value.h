// Strict, typed reading of JSON. A Value knows where it stands in which file, so that whatever is wrong with
// it can be told as one Error: file, JSON pointer, what was found, what was expected.
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

using Json = nlohmann::ordered_json;  // keeps the order of the file: meshes are drawn in it

/// Parses JSON with comments. Throws Error, with line and column, for bad syntax; with the pointer for a key
/// that occurs twice in one object; and for nesting beyond 64 levels.
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
  /// Calls take(key, value) for each member of an object whose keys are names that the file chose, in its
  /// order.
  template <class Take>
  void for_each_member(const Take& take) const {
    if (!json_->is_object()) fail("an object");
    for (const auto& [key, json] : json_->items()) take(key, Value(json, pointer_to(key), *file_));
  }

  /// `file: pointer: found ..., expected ...`
  [[noreturn]] void fail(std::string_view expected) const;
  /// `file: pointer: message`
  [[noreturn]] void refuse(std::string_view message) const;
  /// For what the format defines and this version cannot do yet.
  [[noreturn]] void refuse_unsupported(std::string_view what = "") const;

  double number() const;
  double number(double min_value, double max_value) const;
  float real() const;  ///< a number that a float can hold
  float real(double min_value, double max_value) const {
    return static_cast<float>(number(min_value, max_value));
  }
  std::int64_t integer(std::int64_t min_value, std::int64_t max_value) const;
  bool boolean() const;
  const std::string& text() const;
  /// The length of an array.
  std::size_t size() const;

  template <std::size_t N>
  std::array<double, N> numbers() const {
    expect_numbers(N);
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = element(i).number();
    return result;
  }
  Vec3 vec3() const;
  Color color() const;  ///< any four numbers that floats can hold
  Color color(double min_value, double max_value) const;
  Matrix matrix() const;
  Rect rect() const;  ///< four integers, width and height not negative

  /// One of a list of names. Those of `unsupported` exist in the format, but not in this version.
  template <class Enum>
  Enum choice(std::initializer_list<std::pair<std::string_view, Enum>> names,
              std::initializer_list<std::string_view> unsupported = {}) const {
    std::vector<std::string_view> all;
    for (const auto& [name, value] : names) {
      if (json_->is_string() && name == json_->get_ref<const std::string&>()) return value;
      all.push_back(name);
    }
    refuse_choice(all, unsupported);
  }

  /// Calls make() and tells an Error that it throws as one of this value.
  template <class Make>
  auto checked(const Make& make) const {
    try {
      return make();
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

 private:
  std::string pointer_to(const std::string& key) const;  // escaped as RFC 6901 asks
  void expect_numbers(std::size_t count) const;
  [[noreturn]] void refuse_choice(const std::vector<std::string_view>& names,
                                  std::span<const std::string_view> unsupported) const;

  const Json* json_;
  std::string pointer_;
  const std::string* file_;  // of the whole scene; outlives every value
};

/// The members of an object.
class Object {
 public:
  /// Throws Error for a value that is no object, for an unknown key, and for a key of the format that this
  /// version refuses.
  Object(const Value& value, std::initializer_list<std::string_view> keys,
         std::initializer_list<std::string_view> unsupported = {});

  const Value& value() const { return value_; }
  bool has(const std::string& key) const { return value_.json().contains(key); }
  std::optional<Value> find(const std::string& key) const;
  Value require(const std::string& key) const;
  /// A key that may only hold its default in this version. `others` are the remaining values of the format,
  /// if it lists them.
  void only_default(const std::string& key, const Json& standard, const Json& others = Json::array()) const;

 private:
  Value value_;
};

/// "a, b, c" with quotes around each.
std::string quoted_list(std::span<const std::string_view> names);

}  // namespace tessera::program::json
