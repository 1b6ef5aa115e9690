// The displays that `tessera display --list` prints.
#pragma once

#include <string>

namespace tessera::program::cli {

/// All kinds of displays with their parameters, and all presets. ntsc and pal list the parameters that crt
/// does not have, or for which it has other defaults.
std::string display_list_text();
/// The same, with all parameters of each kind.
std::string display_list_json();

}  // namespace tessera::program::cli
