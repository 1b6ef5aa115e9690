// Lists of expected pictures: per line a scene's name and the hashes of colour, depth, stencil and
// accumulation, 16 hexadecimal digits each; 0 for a buffer that the scene does not have.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "engine/program/scene/fingerprint.h"

namespace tessera::program {

struct PictureHash {
  std::uint64_t color = 0;
  std::uint64_t depth = 0;
  std::uint64_t stencil = 0;
  std::uint64_t accumulation = 0;
  friend bool operator==(const PictureHash&, const PictureHash&) = default;
};
inline PictureHash picture_hash(const Fingerprint& f) {
  return {f.color, f.depth, f.stencil, f.accumulation};
}

/// Returns "0566482a4e8a7f24 7797787b78f8c182 3b1f0c8d52e6a974 0000000000000000"
std::string to_text(const PictureHash& hash);

using PictureHashes = std::map<std::string, PictureHash, std::less<>>;

/// @param file  name of the list, for messages
/// @throws Error, with file and line, for a malformed line or a name that occurs twice
PictureHashes parse_picture_hashes(std::string_view text, const std::string& file);

}  // namespace tessera::program
