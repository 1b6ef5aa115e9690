// Depth keys of points and lines: linear along a line, in double, the same for every instruction set.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "framebuffer/format.h"

namespace tessera {

class PointLineDepth {
 public:
  /// @param z0, z1  depth words of the vertices (raster/fixed_point.h)
  /// @param offset  in units of depth words (unorm) or of depth
  PointLineDepth(DepthKind kind, std::uint32_t z0, std::uint32_t z1, double offset)
      : kind_(kind), first_(value(z0) + (kind == DepthKind::float32 ? offset : std::floor(std::clamp(offset, -0x1p32, 0x1p32) + 0.5))), change_(value(z1) - value(z0)) {}

  /// The key where the line has come as far as `t` of its length; beyond its ends no depth leaves 0..1.
  std::int32_t key(double t = 0) const {
    const double z = first_ + t * change_;
    if (kind_ == DepthKind::float32) return std::bit_cast<std::int32_t>(static_cast<float>(std::clamp(z, 0.0, 1.0)) + 0.0f);
    // Words of 16 and 24 bits carry the half that rounds the level.
    const double rounded = kind_ == DepthKind::unorm32 ? std::floor(z + 0.5) : z;
    const auto word = static_cast<std::uint32_t>(std::clamp(rounded, 0.0, 4294967295.0));
    return depth_key_from_word(kind_, word >> (32 - depth_bits(kind_)));
  }

 private:
  double value(std::uint32_t z) const { return kind_ == DepthKind::float32 ? static_cast<double>(std::bit_cast<float>(z)) : static_cast<double>(z); }

  DepthKind kind_;
  double first_, change_;
};

}  // namespace tessera
