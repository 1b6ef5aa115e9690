// Strict JSON reading: every key must be known, every value of its type and size. Errors name the value by
// its JSON pointer.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene.h"

namespace tessera::reference {

using Json = nlohmann::ordered_json;

[[noreturn]] inline void fail(const std::string& pointer, const std::string& expected) {
  throw std::runtime_error("scene" + pointer + ": expected " + expected);
}

[[noreturn]] inline void fail(const std::string& pointer, const std::string& expected,
                              const std::string& found) {
  throw std::runtime_error("scene" + pointer + ": expected " + expected + ", found " + found);
}

/// A value and its JSON pointer.
struct Value {
  const Json* json = nullptr;
  std::string pointer;

  explicit operator bool() const { return json != nullptr; }
  Value operator[](std::size_t i) const { return {&(*json)[i], pointer + "/" + std::to_string(i)}; }
};

inline double number(const Value& v) {
  if (!v.json->is_number()) fail(v.pointer, "a number");
  return v.json->get<double>();
}

inline double number(const Value& v, double least, double most) {
  const double x = number(v);
  if (!(x >= least && x <= most))
    fail(v.pointer, "a number in " + std::to_string(least) + ".." + std::to_string(most));
  return x;
}

inline std::int64_t integer(const Value& v, std::int64_t least, std::int64_t most) {
  const double x = number(v, static_cast<double>(least), static_cast<double>(most));
  if (x != std::floor(x)) fail(v.pointer, "an integer");
  return static_cast<std::int64_t>(x);
}

inline bool boolean(const Value& v) {
  if (!v.json->is_boolean()) fail(v.pointer, "true or false");
  return v.json->get<bool>();
}

inline std::string text(const Value& v) {
  if (!v.json->is_string()) fail(v.pointer, "a string");
  return v.json->get<std::string>();
}

inline std::size_t array_size(const Value& v) {
  if (!v.json->is_array()) fail(v.pointer, "an array");
  return v.json->size();
}

template <std::size_t N>
std::array<double, N> numbers(const Value& v) {
  if (array_size(v) != N) fail(v.pointer, std::to_string(N) + " numbers");
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = number(v[i]);
  return result;
}

inline Vec3 vec3(const Value& v) {
  const auto n = numbers<3>(v);
  return {n[0], n[1], n[2]};
}

inline Vec4 vec4(const Value& v) {
  const auto n = numbers<4>(v);
  return {n[0], n[1], n[2], n[3]};
}

inline Mat4 mat4(const Value& v) {
  const auto n = numbers<16>(v);
  Mat4 m;
  for (std::size_t i = 0; i < 16; ++i) m.rows[i / 4][i % 4] = n[i];
  return m;
}

inline Rect rect(const Value& v) {
  constexpr std::int64_t kLimit = 1 << 20;
  if (array_size(v) != 4) fail(v.pointer, "x, y, width, height");
  const auto at = [&](std::size_t i, std::int64_t least) {
    return static_cast<int>(integer(v[i], least, kLimit));
  };
  return {at(0, -kLimit), at(1, -kLimit), at(2, 0), at(3, 0)};
}

/// One of a list of names.
template <class Enum>
Enum choice(const Value& v, const std::vector<std::pair<const char*, Enum>>& names) {
  const std::string name = text(v);
  std::string all;
  for (const auto& [candidate, value] : names) {
    if (name == candidate) return value;
    all += std::string(all.empty() ? "" : " | ") + candidate;
  }
  fail(v.pointer, all);
}

/// Reads the members of an object. Call finish() after all known keys were read; it rejects unknown ones.
class ObjectReader {
 public:
  explicit ObjectReader(const Value& v) : value_(v) {
    if (!v.json->is_object()) fail(v.pointer, "an object");
  }

  /// The member, or an empty Value.
  Value find(const std::string& key) {
    known_.insert(key);
    const auto found = value_.json->find(key);
    if (found == value_.json->end()) return {};
    return {&*found, value_.pointer + "/" + key};
  }

  Value require(const std::string& key) {
    const Value v = find(key);
    if (!v) fail(value_.pointer, "a key '" + key + "'");
    return v;
  }

  /// Reads a key that the reference renderers do not support: only its default value is accepted.
  void only_default(const std::string& key, const Json& standard) {
    if (const Value v = find(key); v && *v.json != standard)
      fail(v.pointer, standard.dump() + " (all that the reference covers)");
  }

  void finish() const {
    for (const auto& member : value_.json->items())
      if (!known_.contains(member.key())) fail(value_.pointer + "/" + member.key(), "no such key here");
  }

 private:
  Value value_;
  std::set<std::string> known_;
};

}  // namespace tessera::reference
