// Blending against long double: every pair of levels for the common factors, every factor and equation for
// selected levels, in buffers of 1 to 24 bits.
//
// Error bound in u = 2^-24 of 1.0. A stored level or texel becomes a component by 1 / levels in float and a
// product: errors of up to 1 u and 0.5 u. A factor is a component or 1 minus a component: another 0.5 u. A
// product of component and factor carries the sum of both errors, 3.5 u. One of the two products is rounded
// (0.5 u), and so is their sum (0.5 u while it is at most 1; larger sums are clamped to 1). The total is 8 u.
// The result times the level count, plus a half, is rounded once more (2^(bits - 25)) before the fraction is
// cut off.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/numerics/bounds.h"
#include "tests/numerics/color_components.h"

namespace tessera::test::blending_rounding_test {
namespace {

using Components = std::array<long double, 4>;

long double bound_of(int bits) { return ((1 << bits) - 1) * 8 * 0x1p-24L + std::ldexp(1.0L, bits - 25); }

long double factor(BlendFactor factor, std::size_t c, const Components& s, const Components& d,
                   const Components& constant) {
  switch (factor) {
    case BlendFactor::zero: return 0;
    case BlendFactor::one: return 1;
    case BlendFactor::src_color: return s[c];
    case BlendFactor::one_minus_src_color: return 1 - s[c];
    case BlendFactor::dst_color: return d[c];
    case BlendFactor::one_minus_dst_color: return 1 - d[c];
    case BlendFactor::src_alpha: return s[3];
    case BlendFactor::one_minus_src_alpha: return 1 - s[3];
    case BlendFactor::dst_alpha: return d[3];
    case BlendFactor::one_minus_dst_alpha: return 1 - d[3];
    case BlendFactor::constant_color: return constant[c];
    case BlendFactor::one_minus_constant_color: return 1 - constant[c];
    case BlendFactor::constant_alpha: return constant[3];
    case BlendFactor::one_minus_constant_alpha: return 1 - constant[3];
    case BlendFactor::src_alpha_saturate: return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
  }
  return 0;
}

Components blended(const BlendState& state, const Components& s, const Components& d) {
  const Components constant{state.color.r, state.color.g, state.color.b, state.color.a};
  Components result;
  for (std::size_t c = 0; c < 4; ++c) {
    const long double from =
        s[c] * factor(c == 3 ? state.src_alpha.value_or(state.src) : state.src, c, s, d, constant);
    const long double to =
        d[c] * factor(c == 3 ? state.dst_alpha.value_or(state.dst) : state.dst, c, s, d, constant);
    const long double sums[] = {from + to, from - to, to - from, std::min(s[c], d[c]), std::max(s[c], d[c])};
    result[c] = std::clamp(sums[static_cast<int>(state.equation)], 0.0L, 1.0L);
  }
  return result;
}

/// Draws an RGBA byte image over another and measures the distance from the exact result beyond half a level.
class Blender {
 public:
  Blender(FrameBufferFormat format, InstructionSet set)
      : buffer_(format), split_(format), renderer_({.threads = 1, .instruction_set = set}) {}

  void blend(const std::vector<std::uint8_t>& below, const std::vector<std::uint8_t>& above,
             const BlendState& state) {
    const int width = buffer_.format().width, height = buffer_.format().height;
    Frame frame(buffer_);
    frame.draw_image({.pixels = below.data(), .width = width, .height = height});
    renderer_.finish(frame);
    const auto before = packed_colors(buffer_);
    frame.draw_image({.pixels = above.data(), .width = width, .height = height}, {.blend = state});
    renderer_.finish(frame);
    compare(
        before,
        [&](std::size_t i) {
          Components s;
          for (std::size_t c = 0; c < 4; ++c) s[c] = above[4 * i + c] / 255.0L;
          return s;
        },
        state);
  }
  /// Draws a triangle of constant colour over every pixel of an image.
  void blend(const std::vector<std::uint8_t>& below, const Color& color, const BlendState& state) {
    static const MeshData all = whole_window();
    Frame frame(buffer_);
    frame.draw_image(
        {.pixels = below.data(), .width = buffer_.format().width, .height = buffer_.format().height});
    renderer_.finish(frame);
    const auto before = packed_colors(buffer_);
    DrawState draw = unlit(color);
    draw.depth.enabled = false;
    draw.blend = state;
    frame.draw(all.view(), draw);
    renderer_.finish(frame);
    compare(
        before,
        [&](std::size_t) {
          return Components{color.r, color.g, color.b, color.a};
        },
        state);
  }
  /// Largest error beyond half a level over buffers with `bits` bits per component.
  long double worst(int bits) const { return worst_[static_cast<std::size_t>(bits)]; }
  const ComponentBits& split() const { return split_; }

 private:
  template <class Source>
  void compare(const std::vector<std::uint32_t>& before, const Source& source, const BlendState& state) {
    const auto after = packed_colors(buffer_);
    for (std::size_t i = 0; i < after.size(); ++i) {
      Components d, s = source(i);
      for (std::size_t c = 0; c < 4; ++c)
        d[c] =
            split_.bits[c] == 0 ? 1 : static_cast<long double>(split_.level(before[i], c)) / split_.levels(c);
      Components exact = blended(state, s, d);
      const bool gray = split_.is_luminance();
      if (gray) exact[0] = exact[1] = exact[2] = 0.30L * exact[0] + 0.59L * exact[1] + 0.11L * exact[2];
      for (std::size_t c = 0; c < 4; ++c) {
        const int bits = split_.bits[c];
        if (bits == 0) continue;
        const long double beyond =
            std::abs(static_cast<long double>(split_.level(after[i], c)) - exact[c] * split_.levels(c)) -
            0.5L;
        // Luminance adds 1.875 u for its float weights and sums (color_rounding_test.cpp).
        const long double bound = bound_of(bits) + (gray && c < 3 ? split_.levels(c) * 1.875L * 0x1p-24L : 0);
        ASSERT_LE(beyond, bound) << "factors " << static_cast<int>(state.src) << ", "
                                 << static_cast<int>(state.dst) << ", equation "
                                 << static_cast<int>(state.equation) << ", component " << c << ": level "
                                 << split_.level(after[i], c) << ", exactly " << exact[c] * split_.levels(c)
                                 << ", of " << split_.levels(c);
        long double& most = worst_[static_cast<std::size_t>(bits)];
        update_worst(most, beyond);
      }
    }
  }

  FrameBuffer buffer_;
  ComponentBits split_;
  Renderer renderer_;
  std::array<long double, 9> worst_{};
};

using enum BlendFactor;
using enum BlendEquation;

TEST(BlendingRounding, EveryPairOfLevelsWithTheCommonFactors) {
  const BlendState states[] = {
      {.src = src_alpha, .dst = one_minus_src_alpha},
      {.src = src_alpha, .dst = one},
      {.src = one, .dst = one},
      {.src = one, .dst = one_minus_src_alpha},
      {.src = dst_color, .dst = zero},
      {.src = zero, .dst = src_color},
      {.src = dst_color, .dst = src_color},
      {.src = one_minus_dst_color, .dst = one},
      {.src = one_minus_dst_alpha, .dst = dst_alpha},
      {.src = one, .dst = one, .equation = subtract},
      {.src = one, .dst = one, .equation = reverse_subtract},
      {.equation = BlendEquation::min},
      {.equation = BlendEquation::max},
      {.src = constant_alpha, .dst = one_minus_constant_alpha, .color = {0, 0, 0, 0.3f}},
      {.src = src_alpha_saturate, .dst = one}};
  Blender blender(
      {.width = 256, .height = 256, .depth = DepthFormat::none, .stencil_bits = 0, .alpha_bits = 8},
      InstructionSet::automatic);
  std::vector<std::uint8_t> below(4 * 65536);
  std::vector<std::uint8_t> above(below.size());
  int turn = 0;
  for (const BlendState& state : states)
    for (const int alpha : {0, 1, 85, 128, 254, 255}) {
      for (std::size_t i = 0; i < 65536; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
          below[4 * i + c] = static_cast<std::uint8_t>(c == 3 ? 255 - (i >> 8) : i >> 8);
          above[4 * i + c] = static_cast<std::uint8_t>(
              c == 3 ? alpha + 7 * static_cast<int>(i & 255) * (turn % 2) : static_cast<int>(i & 255));
        }
      blender.blend(below, above, state);
      ++turn;
      if (HasFatalFailure()) return;
    }
  expect_within("blending, 8 bits a component, beyond half a level", std::max(0.0L, blender.worst(8)),
                bound_of(8), "levels of 255");
}

TEST(BlendingRounding, EveryFactorAndEquationInEveryFormat) {
  Random random(8);
  for (const int color_bits : {1, 2, 3, 4, 8, 15, 16, 20, 24})
    for (const int alpha_bits : {0, 8})
      for (const int samples : {1, 4}) {
        std::vector<Blender> blenders;
        const FrameBufferFormat format{.width = 24,
                                       .height = 8,
                                       .color_bits = color_bits,
                                       .depth = DepthFormat::none,
                                       .stencil_bits = 0,
                                       .alpha_bits = alpha_bits,
                                       .samples = samples};
        for (const InstructionSet set : available_instruction_sets()) blenders.emplace_back(format, set);
        const auto picture = [&] {
          std::vector<std::uint8_t> bytes;
          for (int i = 0; i < 4 * format.width * format.height; ++i)
            bytes.push_back(
                static_cast<std::uint8_t>(i % 7 == 0 ? 255 * (random.next() % 2) : random.next() % 256));
          return bytes;
        };
        const auto color = [&] {
          return Color{random.between(0, 1), random.between(0, 1), random.between(0, 1),
                       random.between(0, 1)};
        };
        for (int src = 0; src < 15; ++src)
          for (int dst = 0; dst < 15; ++dst) {
            const int turn = 15 * src + dst;
            BlendState state{.src = static_cast<BlendFactor>(src),
                             .dst = static_cast<BlendFactor>(dst),
                             .equation = static_cast<BlendEquation>((turn / 2 + color_bits) % 5),
                             .color = color()};
            if (turn % 3 == 1) state.src_alpha = static_cast<BlendFactor>(random.next() % 15);
            if (turn % 3 == 2) state.dst_alpha = static_cast<BlendFactor>(random.next() % 15);
            const std::vector<std::uint8_t> below = picture();
            const std::vector<std::uint8_t> above = picture();
            Blender& blender = blenders[static_cast<std::size_t>(turn) % blenders.size()];
            if (turn % 2 == 0) blender.blend(below, above, state);
            else blender.blend(below, color(), state);
            if (HasFatalFailure()) {
              ADD_FAILURE() << color_bits << " colour bits, " << alpha_bits << " of alpha, " << samples
                            << " samples";
              return;
            }
          }
      }
}

}  // namespace
}  // namespace tessera::test::blending_rounding_test
