// The scenes that the self-test renders and what they must come to: scenes of tests/scenes, named in
// selftest_scenes.txt, and their lines of tests/picture_hashes.txt. CMake turns them into a source
// (embed_selftest.cmake).
#pragma once

#include <span>
#include <string_view>

namespace tessera::program::cli {

struct SelftestScene {
  std::string_view name;
  std::string_view about;  ///< what of the renderer it meets
  std::string_view json;
};

extern const std::span<const SelftestScene> kSelftestScenes;
extern const std::string_view kSelftestHashes;  ///< see picture_hashes.h

}  // namespace tessera::program::cli
