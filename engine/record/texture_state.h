// State of a Texture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "shading/texture.h"

namespace tessera::detail {

/// A texture under one filter.
struct FilteredTexture {
  TextureLevels levels;  ///< refers to TextureState::texels
  TextureSampler sampler;
  std::array<float, 4> at_origin{};  ///< magnified sample at s = t = 0, for draws without texcoords
};

struct TextureState {
  std::vector<std::uint32_t> texels;  ///< texels of all levels
  FilteredTexture filtered[3];        ///< per TextureCap
  int channels = 4;
  std::optional<std::array<float, 4>> one_color;  ///< if all texels are equal

  bool is_opaque = true;  ///< alpha is 1 in all texels

  const FilteredTexture& under(TextureCap cap) const { return filtered[static_cast<std::size_t>(cap)]; }
  bool has_alpha() const { return channels == 2 || channels == 4; }
};

}  // namespace tessera::detail
