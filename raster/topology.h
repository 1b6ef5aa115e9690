// Topology of a draw's primitives in the bins.
#pragma once

#include <cstdint>

namespace tessera::detail {

/// The value is the number of vertices per primitive.
enum class Topology : std::uint8_t { points = 1, lines = 2, triangles = 3 };

constexpr int corners_of(Topology topology) { return static_cast<int>(topology); }

}  // namespace tessera::detail
