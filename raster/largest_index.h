// The largest index of a mesh, for bounds checks.
#pragma once

#include <cstdint>
#include <span>

namespace tessera::detail {

/// Largest of `indices`; 0 if there are none.
std::uint32_t largest_index(std::span<const std::uint32_t> indices);
std::uint16_t largest_index(std::span<const std::uint16_t> indices);

}  // namespace tessera::detail
