// Lists of what frames must come to: a line for each, its name and the hashes of its colours, depths, stencil
// and accumulation, 16 hexadecimal digits each. 0 stands for a buffer that there is none of.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "engine/program/scene/fingerprint.h"

namespace tessera::program {

struct PictureHash {
  std::uint64_t color = 0, depth = 0, stencil = 0, accumulation = 0;
  friend bool operator==(const PictureHash&, const PictureHash&) = default;
};
inline PictureHash picture_hash(const Fingerprint& f) {
  return {f.color, f.depth, f.stencil, f.accumulation};
}

/// "0566482a4e8a7f24 7797787b78f8c182 3b1f0c8d52e6a974 0000000000000000"
std::string to_text(const PictureHash& hash);

using PictureHashes = std::map<std::string, PictureHash, std::less<>>;

/// @param file  the list's name in messages
/// @throws Error for a line of another form and a name that occurs twice, with file and line.
PictureHashes parse_picture_hashes(std::string_view text, const std::string& file);

}  // namespace tessera::program
