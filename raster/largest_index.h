// The largest of a mesh's indices, which says whether all its vertices are there.
#pragma once

#include <cstdint>
#include <span>

namespace tessera::detail {

/// 0 of none.
std::uint32_t largest_index(std::span<const std::uint32_t> indices);
std::uint16_t largest_index(std::span<const std::uint16_t> indices);

}  // namespace tessera::detail
