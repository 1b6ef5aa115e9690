// Smaller sizes of a texture.
#pragma once

#include <cstdint>

#include "shading/texture.h"

namespace tessera::detail {

/// Half the size, rounded down, at least 1.
constexpr std::int32_t next_level_size(std::int32_t size) { return size > 1 ? size / 2 : 1; }

/// Fills the next level's texels from those of `from`: each the mean of what it covers, weighted by area,
/// rounded to the nearest level, halves up. Both lie in `words`; what stands behind the rows is not looked
/// at, and not written.
void fill_next_level(std::uint32_t* words, const TextureLevel& from, const TextureLevel& to);

}  // namespace tessera::detail
