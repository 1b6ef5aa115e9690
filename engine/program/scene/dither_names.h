// Names of dithers in scene files, options and tables.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "engine/tessera/framebuffer.hpp"

namespace tessera::program {

/// Every dither, in the order of help texts and tables.
inline constexpr std::array<std::pair<std::string_view, Dither>, 8> kDithers{
    {{"none", Dither::none},
     {"bayer2", Dither::bayer2},
     {"bayer4", Dither::bayer4},
     {"bayer8", Dither::bayer8},
     {"blue_noise", Dither::blue_noise},
     {"floyd_steinberg", Dither::floyd_steinberg},
     {"jarvis", Dither::jarvis},
     {"pattern", Dither::pattern}}};

/// @pre the dither is in kDithers
std::string_view dither_name(Dither dither);

/// @throws Error "found ..., expected one of ...", for a mistyped name with a suggestion
Dither named_dither(std::string_view name);

/// Returns all names, separated by `separator`: "none|bayer2|...".
std::string dither_name_list(std::string_view separator);

}  // namespace tessera::program
