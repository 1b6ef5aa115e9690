// Textures as kernels read them: levels of 32-bit texels, filters, and the texture environment.
//
// Each row of a level is padded by the texel that follows the last one under the wrap mode, and each level by
// one row, so that the four texels of a bilinear filter are always two pairs of neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

inline constexpr int kMaxTextureSide = 16384;
inline constexpr int kMaxTextureLevels = 15;  ///< 16384 .. 1

/// Texels along one side of a level, in fixed point with 16 fraction bits.
struct TexelAxis {
  float scale;        ///< number of texels
  std::int32_t all;   ///< number of texels
  std::int32_t last;  ///< the last texel

  explicit TexelAxis(std::int32_t texels)
      : scale(static_cast<float>(texels) * 65536.0f), all(texels * 65536), last((texels - 1) * 65536) {}
};

struct TextureLevel {
  std::int32_t first = 0;  ///< index of texel (0, 0) in TextureLevels::words
  std::int32_t width = 1, height = 1;
  std::int32_t stride = 0;  ///< texels from row to row; 0 for a single row, which is then its own neighbour
  TexelAxis columns{1}, rows{1};

  TextureLevel() = default;
  TextureLevel(std::int32_t first_word, std::int32_t w, std::int32_t h)
      : first(first_word), width(w), height(h), stride(h > 1 ? w + 1 : 0), columns(w), rows(h) {}
  std::int64_t words() const { return height > 1 ? std::int64_t{stride} * (height + 1) : width + 1; }
};

/// Bit offsets of r, g, b and a in a texel.
inline constexpr int kTexelShift[4] = {16, 8, 0, 24};

/// Filter of a draw's texture. The common ones have their own kernels; `any` handles all others.
enum class TexelFilter : std::uint8_t { nearest, linear, linear_mipmapped, any };

struct TextureLevels {
  const std::uint32_t* words = nullptr;  ///< texels of all levels; rows from the bottom
  TextureLevel level[kMaxTextureLevels];
  int last = 0;                               ///< last level; above 0: mipmaps
  bool mag_linear = true, min_linear = true;  ///< within a level: bilinear; false: the nearest texel
  bool blends_levels = false;                 ///< mipmaps: interpolate two levels; false: the nearest level
  TextureWrap wrap_s = TextureWrap::repeat, wrap_t = TextureWrap::repeat;
  bool gathers_pairs = false;  ///< machine_has_fast_gather()
  /// Largest squared footprint, in texels per pixel, that counts as magnification: 2^(2 c) with the c of
  /// [GL 2.1, 3.8.9], which is 0, or 0.5 if magnification is the sharper filter.
  float magnification_limit = 1;

  /// Whether the filter depends on the texels per pixel.
  bool needs_footprint() const { return last > 0 || mag_linear != min_linear; }
  TexelFilter filter() const {
    if (!needs_footprint()) return mag_linear ? TexelFilter::linear : TexelFilter::nearest;
    return mag_linear && min_linear ? TexelFilter::linear_mipmapped : TexelFilter::any;
  }
};

/// The texture of a draw and its environment.
struct DrawTexture {
  const TextureLevels* levels = nullptr;  ///< null: `texel` everywhere
  std::array<float, 4> texel{1, 1, 1, 1};
  TextureEnv function = TextureEnv::modulate;
  bool has_alpha = false;           ///< false: the texels' alpha is 1
  std::array<float, 3> constant{};  ///< TextureEnv::blend: 0..1
  int attribute = 0;                ///< attribute of s; t is the next

  /// Whether texels may change a fragment's alpha.
  bool changes_alpha() const { return has_alpha && function != TextureEnv::decal; }
};

/// 1.0 in texel components of 16 bits, which are levels times 256. Division by this yields the float nearest
/// to level / 255, as alpha tests against such a reference need it.
inline constexpr float kTexelOne = 65280.0f;

/// Applies the texture environment to a colour 0..1 [GL 1.5, 3.8.13]. Scalar twin of texture_env_lanes().
/// @param f  colour of the fragment, r g b a
/// @param t  texel
inline std::array<float, 4> texture_env_reference(const DrawTexture& texture, const std::array<float, 4>& f,
                                                  const std::array<float, 4>& t) {
  std::array<float, 4> c = f;
  for (std::size_t k = 0; k < 3; ++k) {
    switch (texture.function) {
      case TextureEnv::modulate: c[k] = f[k] * t[k]; break;
      case TextureEnv::replace: c[k] = t[k]; break;
      case TextureEnv::decal: c[k] = std::fma(t[3], t[k] - f[k], f[k]); break;
      case TextureEnv::blend: c[k] = std::fma(t[k], texture.constant[k] - f[k], f[k]); break;
      case TextureEnv::add: c[k] = std::min(f[k] + t[k], 1.0f); break;
    }
  }
  if (texture.changes_alpha()) c[3] = texture.function == TextureEnv::replace ? t[3] : f[3] * t[3];
  return c;
}

}  // namespace tessera::detail
