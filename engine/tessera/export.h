// Visibility of symbols: TESSERA_API is exported, everything else is hidden.
#pragma once

#if defined(TESSERA_STATIC)
#define TESSERA_API
#else
#define TESSERA_API __attribute__((visibility("default")))
#endif
