#include "engine/program/scene/animate.h"

#include <cmath>
#include <cstdint>

namespace tessera::program::json {
namespace {

struct Key {
  double time, value;
};

double value_at(const Value& keys, double time) {
  if (keys.size() == 0) keys.fail("a list of [t, value]");
  std::vector<Key> list;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [t, value] = keys.element(i).numbers<2>();
    if (i > 0 && !(t > list.back().time)) keys.element(i).refuse("t must rise from key to key");
    list.push_back({t, value});
  }
  if (time <= list.front().time) return list.front().value;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const Key& a = list[i - 1];
    const Key& b = list[i];
    if (time <= b.time) return a.value + (b.value - a.value) * ((time - a.time) / (b.time - a.time));
  }
  return list.back().value;
}

// Replaces keys at and below `json`, whose JSON pointer is `pointer`. Returns whether there were any.
bool replace_keys(Json& json, double time, const std::string& pointer, const std::string& file) {
  if (json.is_object() && json.size() == 1 && json.contains("keys") && json["keys"].is_array()) {
    const Json keys = json["keys"];
    const double value = value_at(Value(keys, pointer + "/keys", file), time);
    const bool is_whole = value == std::floor(value) && std::abs(value) < 0x1p53;
    json = is_whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
    return true;
  }
  bool any = false;
  if (json.is_object())
    for (auto& [key, member] : json.items()) any |= replace_keys(member, time, pointer + "/" + key, file);
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i)
      if (json[i].is_structured())  // plain numbers skip the cost of a pointer string
        any |= replace_keys(json[i], time, pointer + "/" + std::to_string(i), file);
  return any;
}

}  // namespace

bool animate(Json& json, double time, const std::string& file) { return replace_keys(json, time, "", file); }

}  // namespace tessera::program::json
