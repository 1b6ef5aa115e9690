// Depth keys of lines and points as the kernels find them.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "raster/triangle_setup.h"

namespace tessera::test {
using namespace detail;

/// The key of each parameter: how far of the line from depth word z0 to z1 one has come.
using LineKeys = std::vector<std::int32_t>(DepthFormat kind, std::uint32_t z0, std::uint32_t z1,
                                           const std::vector<double>& parameters);
LineKeys* line_keys(InstructionSet isa);

/// The key of a point with an offset (see LineDepth), and what a line from there to there has at its first
/// vertex.
struct KeyPair {
  std::int32_t point, line;
};
using PointKeys = KeyPair(DepthFormat kind, std::uint32_t z, double offset);
PointKeys* point_keys(InstructionSet isa);

}  // namespace tessera::test
