// What the primitives of a draw are made of when they reach the tiles.
#pragma once

#include <cstdint>

namespace tessera::detail {

/// The number is that of the vertices of each.
enum class Topology : std::uint8_t { points = 1, lines = 2, triangles = 3 };

constexpr int corners_of(Topology topology) { return static_cast<int>(topology); }

}  // namespace tessera::detail
