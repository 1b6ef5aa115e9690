// Lists of what scenes must come to: a line for each, its name and the hashes of its colours and depths, 16 hexadecimal digits each.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "engine/scene/fingerprint.h"

namespace tessera {

struct PictureHash {
  std::uint64_t color = 0, depth = 0;
  friend bool operator==(const PictureHash&, const PictureHash&) = default;
};
inline PictureHash picture_hash(const Fingerprint& f) { return {f.color, f.depth}; }

/// "0566482a4e8a7f24 7797787b78f8c182"
std::string to_text(const PictureHash& hash);

using PictureHashes = std::map<std::string, PictureHash, std::less<>>;

/// @param file  the list's name in messages
/// @throws Error for a line of another form and a scene that occurs twice, with file and line.
PictureHashes parse_picture_hashes(std::string_view text, const std::string& file);

}  // namespace tessera
