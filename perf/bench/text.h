// printf-style formatting into std::string.
#pragma once

#include <cstdio>
#include <string>

namespace tessera::bench {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// A number with three significant digits, or all digits before the point.
inline std::string significant(double value) {
  if (value >= 100) return formatted("%.0f", value);
  return value >= 10 ? formatted("%.1f", value) : formatted("%.3g", value);
}

}  // namespace tessera::bench
