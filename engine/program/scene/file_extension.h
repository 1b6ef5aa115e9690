// The extension of a file name, which selects the format.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace tessera::program {

/// Returns ".png" for "Picture.PNG"; empty if there is none.
inline std::string lower_case_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace tessera::program
