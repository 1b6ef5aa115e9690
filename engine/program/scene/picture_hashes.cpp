#include "engine/program/scene/picture_hashes.h"

#include <charconv>
#include <cstdio>

namespace tessera::program {
namespace {

constexpr std::size_t kDigits = 16;

// Removes the hash and the blank before it from the end of `line`. Returns false if there is none.
bool take_hash(std::string_view& line, std::uint64_t& hash) {
  if (line.size() <= kDigits || line[line.size() - kDigits - 1] != ' ') return false;
  const std::string_view digits = line.substr(line.size() - kDigits);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + kDigits, hash, 16);
  line.remove_suffix(kDigits + 1);
  return error == std::errc{} && end == digits.data() + kDigits;
}

}  // namespace

std::string to_text(const PictureHash& hash) {
  std::string text;
  for (const std::uint64_t each : {hash.color, hash.depth, hash.stencil, hash.accumulation}) {
    char digits[kDigits + 1];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(each));
    text += (text.empty() ? "" : " ") + std::string(digits);
  }
  return text;
}

PictureHashes parse_picture_hashes(std::string_view text, const std::string& file) {
  PictureHashes hashes;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view name = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    PictureHash hash;
    const auto fail = [&](const std::string& message) {
      throw Error(file + ":" + std::to_string(number) + ": " + message);
    };
    const bool taken = take_hash(name, hash.accumulation) && take_hash(name, hash.stencil) &&
                       take_hash(name, hash.depth) && take_hash(name, hash.color);
    if (!taken || name.empty() || name.find(' ') != std::string_view::npos)
      fail("expected a scene's name and four hashes of 16 hexadecimal digits, separated by single blanks");
    if (!hashes.emplace(name, hash).second) fail("\"" + std::string(name) + "\" occurs twice");
  }
  return hashes;
}

}  // namespace tessera::program
