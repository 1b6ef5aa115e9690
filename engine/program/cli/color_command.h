// `tessera color`: converts colours between colour spaces, or lists the spaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framebuffer/tessera/color.hpp"

namespace tessera::program::cli {

struct ColorRequest {
  std::vector<std::string> words;                 ///< values as typed
  std::optional<std::vector<ColorValues>> given;  ///< colours of `words`; absent: read the standard input
  NamedColorSpace from;
  std::optional<NamedColorSpace> to;  ///< present unless `list` is set
  bool list = false;
  bool json = false;
};

/// Returns the converted colours, one per line, or the list of spaces; as text or as JSON.
/// @throws Error for a wrong line of the standard input
std::string colors_text(const ColorRequest& request);

}  // namespace tessera::program::cli
