// Text from numbers.
#pragma once

#include <cstdio>
#include <string>

namespace tessera::program::cli {

/// Formats like printf. Texts of more than 159 characters are cut off.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace tessera::program::cli
