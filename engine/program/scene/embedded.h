// Files compiled into the program; embed.cmake generates the source.
#pragma once

#include <string_view>

namespace tessera::program {

extern const std::string_view kTeapotPatches;
extern const std::string_view kBuiltinScene;

}  // namespace tessera::program
