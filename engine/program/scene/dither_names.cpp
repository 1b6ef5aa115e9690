#include "engine/program/scene/dither_names.h"

#include <algorithm>
#include <vector>

#include "engine/program/scene/suggest.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

std::string_view dither_name(Dither dither) {
  return std::find_if(kDithers.begin(), kDithers.end(), [&](const auto& row) { return row.second == dither; })
      ->first;
}

Dither named_dither(std::string_view name) {
  std::vector<std::string_view> names;
  for (const auto& [known, dither] : kDithers) {
    if (known == name) return dither;
    names.push_back(known);
  }
  throw Error("found \"" + std::string(name) + "\", expected one of " + dither_name_list(", ") +
              did_you_mean(name, names));
}

std::string dither_name_list(std::string_view separator) {
  std::string list;
  for (const auto& [name, dither] : kDithers) {
    if (!list.empty()) list += separator;
    list += name;
  }
  return list;
}

}  // namespace tessera::program
