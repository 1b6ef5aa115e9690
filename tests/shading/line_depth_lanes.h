// Depth keys of lines and points as computed by the kernels.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "raster/triangle_setup.h"

namespace tessera::test {
using namespace detail;

/// Depth keys at each parameter, the fraction of the way from depth z0 to z1.
using LineKeys = std::vector<std::int32_t>(DepthFormat kind, std::uint32_t z0, std::uint32_t z1,
                                           const std::vector<double>& parameters);
LineKeys* line_keys(InstructionSet isa);

/// Key of a point with an offset (see LineDepth), and the key of a zero-length line at its first vertex.
struct KeyPair {
  std::int32_t point, line;
};
using PointKeys = KeyPair(DepthFormat kind, std::uint32_t z, double offset);
PointKeys* point_keys(InstructionSet isa);

}  // namespace tessera::test
