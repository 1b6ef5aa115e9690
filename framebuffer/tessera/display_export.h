// Visibility of symbols of the library tessera::display: TESSERA_DISPLAY_API is exported, everything else is
// hidden.
#pragma once

#define TESSERA_DISPLAY_API __attribute__((visibility("default")))
