#include "texture_sampler.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {
namespace {

/// Length of the overlap of two intervals, in units in which the texels of both mipmaps are integral.
std::int64_t overlap(std::int64_t a0, std::int64_t a1, std::int64_t b0, std::int64_t b1) {
  return std::max(std::int64_t{0}, std::min(a1, b1) - std::max(a0, b0));
}

std::size_t level_at(const Image& image, std::int64_t i, std::int64_t j, std::int64_t channel) {
  return static_cast<std::size_t>((j * image.width + i) * image.channels + channel);
}

bool is_linear_in_level(MinFilter filter) {
  return filter == MinFilter::kLinear || filter == MinFilter::kLinearMipmapNearest ||
         filter == MinFilter::kLinearMipmapLinear;
}

double mirrored(double f) {
  const double whole = std::floor(f);
  const double fraction = f - whole;
  return std::fmod(whole, 2) == 0 ? fraction : 1 - fraction;
}

/// A coordinate in the image, 0..1.
double wrapped(double f, Wrap wrap, int size) {
  if (wrap == Wrap::kRepeat) return f - std::floor(f);
  const double half_texel = 0.5 / size;
  return std::clamp(wrap == Wrap::kMirroredRepeat ? mirrored(f) : f, half_texel, 1 - half_texel);
}

std::int64_t wrapped_texel(std::int64_t i, Wrap wrap, int size) {
  if (wrap == Wrap::kRepeat) return (i % size + size) % size;
  return std::clamp<std::int64_t>(i, 0, size - 1);
}

}  // namespace

Vec4 pixel_color(const Image& image, std::int64_t column, std::int64_t row) {
  const std::size_t at = level_at(image, column, row, 0);
  const auto channel = [&](std::size_t c) { return image.levels[at + c] / 255.0; };
  switch (image.channels) {
    case 1: return {channel(0), channel(0), channel(0), 1};
    case 2: return {channel(0), channel(0), channel(0), channel(1)};
    case 3: return {channel(0), channel(1), channel(2), 1};
    default: return {channel(0), channel(1), channel(2), channel(3)};
  }
}

Image next_mipmap(const Image& image) {
  Image next{std::max(1, image.width / 2), std::max(1, image.height / 2), image.channels, {}};
  const std::int64_t w = image.width;
  const std::int64_t h = image.height;
  const std::int64_t area = w * h;
  for (std::int64_t j = 0; j < next.height; ++j)
    for (std::int64_t i = 0; i < next.width; ++i)
      for (std::int64_t channel = 0; channel < image.channels; ++channel) {
        std::int64_t sum = 0;  // the weights sum to `area`
        for (std::int64_t y = j * h / next.height; y * next.height < (j + 1) * h; ++y)
          for (std::int64_t x = i * w / next.width; x * next.width < (i + 1) * w; ++x)
            sum += overlap(i * w, (i + 1) * w, x * next.width, (x + 1) * next.width) *
                   overlap(j * h, (j + 1) * h, y * next.height, (y + 1) * next.height) *
                   image.levels[level_at(image, x, y, channel)];
        next.levels.push_back(static_cast<std::uint8_t>((2 * sum + area) / (2 * area)));
      }
  return next;
}

TextureSampler::TextureSampler(const Texture& texture)
    : mipmaps_{texture.image},
      mag_(texture.mag),
      min_(texture.min),
      wrap_s_(texture.wrap_s),
      wrap_t_(texture.wrap_t) {
  if (min_ == MinFilter::kNearest || min_ == MinFilter::kLinear) return;
  while (mipmaps_.back().width > 1 || mipmaps_.back().height > 1)
    mipmaps_.push_back(next_mipmap(mipmaps_.back()));
}

double TextureSampler::level_of_detail(TexCoord d_dx, TexCoord d_dy) const {
  const double w = mipmaps_[0].width;
  const double h = mipmaps_[0].height;
  const auto texels = [&](TexCoord d) {
    return std::hypot(w * d.s, h > 1 ? h * d.t : 0.0);
  };  // one row: t is ignored
  return std::log2(std::max(texels(d_dx), texels(d_dy)));
}

Vec4 TextureSampler::nearest(std::size_t level, TexCoord at) const {
  const auto [w, h] = std::pair{mipmaps_[level].width, mipmaps_[level].height};
  const auto index = [](double f, int size) {
    return std::min(static_cast<std::int64_t>(std::floor(f * size)), std::int64_t{size - 1});
  };
  return pixel_color(mipmaps_[level], index(wrapped(at.s, wrap_s_, w), w),
                     index(wrapped(at.t, wrap_t_, h), h));
}

Vec4 TextureSampler::linear(std::size_t level, TexCoord at) const {
  const auto [w, h] = std::pair{mipmaps_[level].width, mipmaps_[level].height};
  const double u = wrapped(at.s, wrap_s_, w) * w - 0.5, v = wrapped(at.t, wrap_t_, h) * h - 0.5;
  const double a = u - std::floor(u);
  const double b = v - std::floor(v);
  const auto i = static_cast<std::int64_t>(std::floor(u));
  const auto j = static_cast<std::int64_t>(std::floor(v));
  const auto at_texel = [&, width = w, height = h](std::int64_t x, std::int64_t y) {
    return pixel_color(mipmaps_[level], wrapped_texel(x, wrap_s_, width), wrapped_texel(y, wrap_t_, height));
  };
  return (1 - b) * ((1 - a) * at_texel(i, j) + a * at_texel(i + 1, j)) +
         b * ((1 - a) * at_texel(i, j + 1) + a * at_texel(i + 1, j + 1));
}

Vec4 TextureSampler::sample(TexCoord at, double lambda) const {
  if (mipmaps_[0].height == 1) at.t = 0.5;  // a 1-D texture
  // Beyond the horizon of a plane, at an uncovered centre.
  if (!std::isfinite(at.s) || !std::isfinite(at.t)) at = {};
  // If magnification is the sharper filter, it switches half a level later.
  const bool is_late = mag_ == MagFilter::kLinear &&
                       (min_ == MinFilter::kNearestMipmapNearest || min_ == MinFilter::kNearestMipmapLinear);
  const bool is_minified = lambda > (is_late ? 0.5 : 0.0);
  if (!is_minified) return mag_ == MagFilter::kLinear ? linear(0, at) : nearest(0, at);

  const auto in_level = [&](std::size_t level) {
    return is_linear_in_level(min_) ? linear(level, at) : nearest(level, at);
  };
  const std::size_t last = mipmaps_.size() - 1;
  switch (min_) {
    case MinFilter::kNearest:
    case MinFilter::kLinear: return in_level(0);
    case MinFilter::kNearestMipmapNearest:
    case MinFilter::kLinearMipmapNearest:
      if (lambda <= 0.5) return in_level(0);
      return in_level(
          lambda >= static_cast<double>(last) ? last : static_cast<std::size_t>(std::ceil(lambda + 0.5) - 1));
    case MinFilter::kNearestMipmapLinear:
    case MinFilter::kLinearMipmapLinear: break;
  }
  if (lambda >= static_cast<double>(last)) return in_level(last);
  const auto lower = static_cast<std::size_t>(std::floor(lambda));
  const double above = lambda - std::floor(lambda);
  return (1 - above) * in_level(lower) + above * in_level(lower + 1);
}

}  // namespace tessera::reference
