// Makes text from files safe for the terminal, and quotes it for messages.
#pragma once

#include <string>
#include <string_view>

namespace tessera::program::cli {

/// Replaces control characters by \xHH, so that names and contents of files stay on one line.
inline std::string printable(std::string_view text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) line += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    else line += c;
  }
  return line;
}

inline std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

}  // namespace tessera::program::cli
