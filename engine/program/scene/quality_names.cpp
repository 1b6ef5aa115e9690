#include "engine/program/scene/quality_names.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <vector>

#include "engine/program/scene/suggest.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

using QualityNames = std::vector<std::string_view>;

[[noreturn]] void refuse_name(const std::string& kind, const std::string& typed, const QualityNames& names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  throw Error("found " + kind + " \"" + typed + "\", expected one of " + list + did_you_mean(typed, names));
}

template <class Value, std::size_t count>
Value value_named(const std::string& key, const std::string& typed,
                  const std::array<std::pair<std::string_view, Value>, count>& choices) {
  QualityNames names;
  for (const auto& [name, value] : choices) {
    if (name == typed) return value;
    names.push_back(name);
  }
  refuse_name(key, typed, names);
}

float parse_threshold(const std::string& typed) {
  float number = 0;
  const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), number);
  const bool is_number = error == std::errc() && end == typed.data() + typed.size();
  if (!is_number || !(number >= 0 && number <= 1))
    throw Error("found light_threshold \"" + typed + "\", expected a number from 0 to 1");
  return number;
}

void set_field(Quality& quality, const std::string& key, const std::string& typed) {
  if (key == "shading") quality.shading = value_named(key, typed, kShadingCaps);
  else if (key == "renormalize") quality.renormalize = value_named(key, typed, kRenormalize);
  else if (key == "viewer") quality.viewer = value_named(key, typed, kViewerCaps);
  else if (key == "interpolation") quality.interpolation = value_named(key, typed, kInterpolationCaps);
  else if (key == "texture") quality.texture = value_named(key, typed, kTextureCaps);
  else if (key == "light_threshold") quality.light_threshold = parse_threshold(typed);
  else
    refuse_name("key", key,
                {"shading", "renormalize", "viewer", "interpolation", "texture", "light_threshold"});
}

}  // namespace

Quality parse_quality(const std::string& text) {
  Quality quality;
  std::vector<std::string> seen;
  std::istringstream parts(text.empty() || text.ends_with(',') ? text + "," : text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) throw Error("found \"" + part + "\", expected KEY=VALUE");
    const std::string key = part.substr(0, equals);
    set_field(quality, key, part.substr(equals + 1));
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      throw Error("found key \"" + key + "\" twice, expected it once");
    seen.push_back(key);
  }
  return quality;
}

}  // namespace tessera::program
