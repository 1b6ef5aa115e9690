// What stands behind a Texture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "shading/texture.h"

namespace tessera::detail {

struct TextureState {
  std::vector<std::uint32_t> texels;
  TextureLevels levels;  ///< points into them
  TextureSampler sampler;
  int channels = 4;
  std::optional<std::array<float, 4>> one_color;  ///< where all texels are the same
  std::array<float, 4>
      at_origin{};  ///< what s = t = 0 shows without slopes: draws that have no texture coordinates

  bool has_alpha() const { return channels == 2 || channels == 4; }
};

}  // namespace tessera::detail
