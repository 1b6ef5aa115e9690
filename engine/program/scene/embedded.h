// Files that are part of the program; CMake turns them into a source (embed.cmake).
#pragma once

#include <string_view>

namespace tessera::program {

extern const std::string_view kTeapotPatches;
extern const std::string_view kBuiltinScene;

}  // namespace tessera::program
