// A texture with all its mipmaps, and the colour at a point of it [GL 2.1, 3.8.7 to 3.8.9].
#pragma once

#include <vector>

#include "scene.h"

namespace tessera::reference {

struct TexCoord {
  double s = 0, t = 0;
};

inline TexCoord operator+(TexCoord a, TexCoord b) { return {a.s + b.s, a.t + b.t}; }
inline TexCoord operator*(double f, TexCoord a) { return {f * a.s, f * a.t}; }

/// Red, green, blue, alpha, 0..1, of a pixel of an image, its rows counted from the bottom; of one and two
/// channels red = green = blue; alpha 1 if there is none.
Vec4 pixel_color(const Image& image, std::int64_t column, std::int64_t row);

/// The next smaller mipmap: half the size, rounded down, at least 1; each texel the mean of what it covers of
/// `image`, weighted by area, rounded to a level.
Image next_mipmap(const Image& image);

class TextureSampler {
 public:
  explicit TextureSampler(const Texture& texture);

  int channels() const { return mipmaps_[0].channels; }

  /// Equation 3.14: the base 2 logarithm of the larger length of the two derivatives of the texel
  /// coordinates, for each pixel; minus infinity where they are null.
  double level_of_detail(TexCoord d_dx, TexCoord d_dy) const;

  /// As pixel_color()
  Vec4 sample(TexCoord at, double level_of_detail) const;

 private:
  Vec4 nearest(std::size_t level, TexCoord at) const;
  Vec4 linear(std::size_t level, TexCoord at) const;

  std::vector<Image> mipmaps_;
  MagFilter mag_;
  MinFilter min_;
  Wrap wrap_s_, wrap_t_;
};

}  // namespace tessera::reference
