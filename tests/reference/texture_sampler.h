// A texture with all mipmaps, and its sampling [GL 2.1, 3.8.7 to 3.8.9].
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

struct TexCoord {
  double s = 0, t = 0;
};

inline TexCoord operator+(TexCoord a, TexCoord b) { return {a.s + b.s, a.t + b.t}; }
inline TexCoord operator*(double f, TexCoord a) { return {f * a.s, f * a.t}; }

/// Red, green, blue, alpha (0..1) of an image's pixel, rows counted from the bottom. One and two channels:
/// red = green = blue. Alpha is 1 if absent.
Vec4 pixel_color(const Image& image, std::int64_t column, std::int64_t row);

/// The next smaller mipmap: half the size, rounded down, at least 1. Each texel is the area-weighted mean of
/// the texels it covers in `image`, rounded to a level.
Image next_mipmap(const Image& image);

class TextureSampler {
 public:
  explicit TextureSampler(const Texture& texture);

  int channels() const { return mipmaps_[0].channels; }

  /// Equation 3.14: base 2 logarithm of the larger length of the two derivatives of the texel coordinates,
  /// per pixel; minus infinity if they are null.
  double level_of_detail(TexCoord d_dx, TexCoord d_dy) const;

  /// Red, green, blue, alpha, as pixel_color() returns them.
  Vec4 sample(TexCoord at, double level_of_detail) const;

 private:
  Vec4 nearest(std::size_t level, TexCoord at) const;
  Vec4 linear(std::size_t level, TexCoord at) const;

  std::vector<Image> mipmaps_;
  MagFilter mag_;
  MinFilter min_;
  Wrap wrap_s_;
  Wrap wrap_t_;
};

}  // namespace tessera::reference
