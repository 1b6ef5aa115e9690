// The scenes that the self-test renders, with their expected hashes. embed_selftest.cmake generates the
// source from selftest_scenes.txt, tests/scenes and tests/picture_hashes.txt.
#pragma once

#include <span>
#include <string_view>

namespace tessera::program::cli {

struct SelftestScene {
  std::string_view name;
  std::string_view description;
  std::string_view json;
};

extern const std::span<const SelftestScene> kSelftestScenes;
extern const std::string_view kSelftestHashes;  ///< see picture_hashes.h

}  // namespace tessera::program::cli
