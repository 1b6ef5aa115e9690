// Mipmap levels.
#pragma once

#include <cstdint>

#include "shading/texture.h"

namespace tessera::detail {

/// Half the size, rounded down, at least 1.
constexpr std::int32_t next_level_size(std::int32_t size) { return size > 1 ? size / 2 : 1; }

/// Fills level `to` from the level before it: each texel is the area-weighted mean of the texels that it
/// covers, rounded to the nearest level, halves up. Both levels lie in `words`; padding after rows is neither
/// read nor written.
void fill_next_level(std::uint32_t* words, const TextureLevel& from, const TextureLevel& to);

}  // namespace tessera::detail
