// State of a Texture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "shading/texture.h"

namespace tessera::detail {

struct TextureState {
  std::vector<std::uint32_t> texels;  ///< texels of all levels
  TextureLevels levels;               ///< refers to `texels`
  TextureSampler sampler;
  int channels = 4;
  std::optional<std::array<float, 4>> one_color;  ///< if all texels are equal
  std::array<float, 4> at_origin{};  ///< magnified sample at s = t = 0, for draws without texcoords

  bool is_opaque = true;  ///< alpha is 1 in all texels

  bool has_alpha() const { return channels == 2 || channels == 4; }
};

}  // namespace tessera::detail
