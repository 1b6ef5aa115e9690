// Textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <tessera/enums.hpp>

#include "types.hpp"

namespace tessera {

inline constexpr int kMaxTextureSize = 16384;  ///< largest width and height, texels

/// Texels in the caller's memory: 8 bits per component, 255 is 1, no transfer curve.
/// s runs from 0 to 1 along a row; t is 0 at the lower edge of the bottom row.
struct TextureImage {
  const void* pixels = nullptr;     ///< the first row in memory: the top row, unless bottom_row_first
  int width = 0;                    ///< texels, 1 to kMaxTextureSize
  int height = 0;                   ///< texels, 1 to kMaxTextureSize; 1: a 1-D texture, which ignores t
  int channels = 4;                 ///< 1: luminance; 2: luminance, alpha; 3: r g b; 4: r g b a
  std::ptrdiff_t stride_bytes = 0;  ///< from row to row; 0: width * channels
  bool bottom_row_first = false;
};

enum class TextureFilter : std::uint8_t {
  nearest,
  linear,
  nearest_mipmap_nearest,
  linear_mipmap_nearest,
  nearest_mipmap_linear,
  linear_mipmap_linear
};

struct TextureSampler {
  TextureFilter mag = TextureFilter::linear;                ///< magnification: nearest or linear
  TextureFilter min = TextureFilter::linear_mipmap_linear;  ///< minification
  TextureWrap wrap_s = TextureWrap::repeat;
  TextureWrap wrap_t = TextureWrap::repeat;
};

/// A texture: a copy of the texels and, for filters with mipmaps, of all smaller levels.
/// - Each level is half the size of the one before, rounded down. Its texels are rounded means of the texels
///   that they cover there.
/// - Level of detail by GL 2.1, equation 3.14, from exact derivatives.
/// - Memory: 4 bytes per texel, a third more with mipmaps.
/// - Draws borrow it: it must outlive the frame's finish or reset. It may be shared by threads.
/// @code
/// const std::uint8_t texels[] = {255, 0, 255, 0, 255, 0, 255, 0, 255};  // a chessboard of 3 x 3
/// const Texture texture({.pixels = texels, .width = 3, .height = 3, .channels = 1},
///                       {.mag = TextureFilter::nearest, .wrap_s = TextureWrap::clamp_to_edge});
/// frame.draw(mesh, {.texture = &texture});
/// renderer.finish(frame);
/// @endcode
class TESSERA_API Texture {
 public:
  /// @throws Error  for sizes, channels, strides or filters out of range, null pixels, or out of memory
  explicit Texture(const TextureImage& image, const TextureSampler& sampler = {});
  ~Texture();
  Texture(Texture&&) noexcept;
  Texture& operator=(Texture&&) noexcept;

  int width() const noexcept;
  int height() const noexcept;
  int channels() const noexcept;
  const TextureSampler& sampler() const noexcept;

 private:
  friend class Frame;
  std::unique_ptr<detail::TextureState> state_;
};

}  // namespace tessera
