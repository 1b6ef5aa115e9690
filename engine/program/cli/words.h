// Words of a line of text.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace tessera::program::cli {

/// The words of a text, which white space separates.
inline std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace tessera::program::cli
