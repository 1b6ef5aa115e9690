#include "framebuffer/accumulation.h"

#include <algorithm>
#include <cmath>

#include "framebuffer/check.h"

namespace tessera::detail {
namespace {

struct Range {
  std::int64_t low, high;
};
constexpr Range range_of(int bits) {
  return bits == 16 ? Range{-32768, 32767} : Range{-2147483648LL, 2147483647LL};
}

std::int32_t saturated(std::int64_t level, Range range) {
  return static_cast<std::int32_t>(std::clamp(level, range.low, range.high));
}

// Nearest integer, halves up, clamped to -limit .. limit.
std::int64_t rounded(double level, double limit) {
  // The limits are integers, so clamping before rounding gives the same result, and the conversion is in
  // range. Truncation rounds negative values up; the last line corrects that.
  const double x = std::clamp(level + 0.5, -limit, limit);
  const auto truncated = static_cast<std::int64_t>(x);
  return truncated - (static_cast<double>(truncated) > x ? 1 : 0);
}

constexpr double kMaxTerm = 8589934592.0;  // 2^33: saturates a 32-bit component from any level

}  // namespace

std::int32_t accumulation_level(double value, int bits) {
  return saturated(rounded(value * accumulation_one(bits), kMaxTerm), range_of(bits));
}

Accumulation::Accumulation(AccumOp op, double value, int bits, const ColorLayout& layout)
    : op_(op), value_(value), bits_(bits), layout_(layout), terms_{} {
  TESSERA_ASSERT((bits == 16 || bits == 32) && std::isfinite(value) && !layout.index);
  const Field alpha{layout.bits, layout.alpha_bits};
  if (layout.luminance) {
    const Field grey{0, layout.bits};
    fields_ = {grey, grey, grey, alpha};
  } else {
    const Field red{layout.r_shift(), layout.r_bits};
    const Field green{layout.g_shift(), layout.g_bits};
    const Field blue{0, layout.b_bits};
    fields_ = {red, green, blue, alpha};
  }
  const double one = accumulation_one(bits);
  for (std::size_t c = 0; c < 4; ++c) {
    if (op == AccumOp::add || fields_[c].bits == 0) {
      terms_[c][0] = rounded(value * one, kMaxTerm);
      continue;
    }
    const int max_level = (1 << fields_[c].bits) - 1;
    for (int level = 0; level <= max_level; ++level)
      terms_[c][static_cast<std::size_t>(level)] =
          rounded(value * (static_cast<double>(level) / max_level) * one, kMaxTerm);
  }
}

template <bool kAccumulates>
void Accumulation::add_colors(const std::uint32_t* packed_colors, const AccumulatedPixels& levels,
                              int count) const {
  const Range range = range_of(bits_);
  for (std::size_t c = 0; c < 4; ++c) {
    const auto [shift, bits] = fields_[c];
    const std::uint32_t mask = (1u << bits) - 1;
    for (int i = 0; i < count; ++i) {
      const std::int64_t term = terms_[c][packed_colors[i] >> shift & mask];
      levels[c][i] = saturated(kAccumulates ? levels[c][i] + term : term, range);
    }
  }
}

void Accumulation::run(const std::uint32_t* packed_colors, const AccumulatedPixels& levels, int count) const {
  TESSERA_ASSERT(op_ != AccumOp::return_color);
  const Range range = range_of(bits_);
  switch (op_) {
    case AccumOp::accum: return add_colors<true>(packed_colors, levels, count);
    case AccumOp::load: return add_colors<false>(packed_colors, levels, count);
    case AccumOp::add:
      for (std::size_t c = 0; c < 4; ++c)
        for (int i = 0; i < count; ++i) levels[c][i] = saturated(levels[c][i] + terms_[c][0], range);
      return;
    default:
      for (std::int32_t* component : levels)
        for (int i = 0; i < count; ++i)
          component[i] = saturated(rounded(component[i] * value_, kMaxTerm), range);
  }
}

std::uint32_t Accumulation::packed_color(const AccumulatedPixel& levels, const ColorDither* dither, int x,
                                         int y) const {
  const double threshold = dither != nullptr ? dither->pattern().at(x, y) : 0.5;
  const auto component = [&](std::size_t c) {
    return std::clamp(value_ * (levels[c] / accumulation_one(bits_)), 0.0, 1.0);
  };
  const auto stored_level = [&](double value, int bits) {
    return static_cast<std::uint32_t>(value * ((1 << bits) - 1) + threshold);
  };
  const auto dithered_level = [&](std::size_t c, double value, int bits) {
    if (dither == nullptr || dither->table(c) == nullptr) return stored_level(value, bits);
    return stored_level(dither->component(c, static_cast<float>(value)), bits);
  };
  const double r = component(0), g = component(1), b = component(2);
  std::uint32_t packed = 0;
  if (layout_.alpha_bits != 0) packed = stored_level(component(3), layout_.alpha_bits) << layout_.bits;
  if (layout_.luminance)
    return packed | dithered_level(0, std::min(kLumaR * r + kLumaG * g + kLumaB * b, 1.0), layout_.bits);
  return packed | dithered_level(0, r, layout_.r_bits) << layout_.r_shift() |
         dithered_level(1, g, layout_.g_bits) << layout_.g_shift() | dithered_level(2, b, layout_.b_bits);
}

}  // namespace tessera::detail
