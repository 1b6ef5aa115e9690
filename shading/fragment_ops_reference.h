// Scalar twin of fragment_ops-inl.h and its specification: one fragment at a time, the same steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "shading/fragment_scalar.h"

namespace tessera::detail {

constexpr std::int32_t stencil_op_reference(StencilOp action, std::int32_t stored, const StencilSide& face,
                                            std::int32_t max_value) {
  const auto value = [&] {
    switch (action) {
      case StencilOp::zero: return 0;
      case StencilOp::replace: return face.reference;
      case StencilOp::incr: return stored < max_value ? stored + 1 : max_value;
      case StencilOp::decr: return stored > 0 ? stored - 1 : 0;
      case StencilOp::invert: return ~stored;
      case StencilOp::incr_wrap: return stored + 1;
      case StencilOp::decr_wrap: return stored - 1;
      default: return stored;
    }
  };
  const std::int32_t mask = face.write_mask & max_value;
  return (stored & ~mask) | (value() & mask);
}

constexpr std::uint32_t logic_op_reference(LogicOp logic, std::uint32_t s, std::uint32_t d) {
  switch (logic) {
    case LogicOp::clear: return 0;
    case LogicOp::bit_and: return s & d;
    case LogicOp::and_reverse: return s & ~d;
    case LogicOp::copy: return s;
    case LogicOp::and_inverted: return ~s & d;
    case LogicOp::noop: return d;
    case LogicOp::bit_xor: return s ^ d;
    case LogicOp::bit_or: return s | d;
    case LogicOp::nor: return ~(s | d);
    case LogicOp::equiv: return ~(s ^ d);
    case LogicOp::invert: return ~d;
    case LogicOp::or_reverse: return s | ~d;
    case LogicOp::copy_inverted: return ~s;
    case LogicOp::or_inverted: return ~s | d;
    case LogicOp::nand: return ~(s & d);
    default: return ~0u;
  }
}

/// A level of b bits as a component 0..1; 1 if there are no bits.
inline float component_of(std::uint32_t level, int bits) {
  if (bits == 0) return 1.0f;
  return static_cast<float>(static_cast<std::int32_t>(level)) * (1.0f / static_cast<float>((1 << bits) - 1));
}

/// Unpacks a stored colour.
inline Rgba unpack_color_reference(const ColorLayout& layout, std::uint32_t packed) {
  const auto field = [&](int shift, int bits) {
    return component_of(packed >> shift & ((1u << bits) - 1), bits);
  };
  const float a = layout.alpha_bits == 0 ? 1.0f : field(layout.bits, layout.alpha_bits);
  if (layout.luminance) {
    const float l = field(0, layout.bits);
    return {l, l, l, a};
  }
  return {field(layout.r_shift(), layout.r_bits), field(layout.g_shift(), layout.g_bits),
          field(0, layout.b_bits), a};
}

inline float blend_factor_reference(BlendFactor factor, std::size_t c, const Rgba& s, const Rgba& d,
                                    const Rgba& constant) {
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
    default: return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
  }
}

inline float blend_equation_reference(BlendEquation equation, float s, float s_factor, float d,
                                      float d_factor) {
  switch (equation) {
    case BlendEquation::add: return std::fma(s, s_factor, d * d_factor);
    case BlendEquation::subtract: return std::fma(s, s_factor, -(d * d_factor));
    case BlendEquation::reverse_subtract: return std::fma(-s, s_factor, d * d_factor);
    case BlendEquation::min: return std::min(s, d);
    default: return std::max(s, d);
  }
}

/// The result is clamped to 0..1.
inline Rgba blend_reference(const FragmentOps& ops, const Rgba& s, const Rgba& d) {
  Rgba out;
  for (std::size_t c = 0; c < 4; ++c) {
    const float s_factor =
        blend_factor_reference(c == 3 ? ops.src_alpha : ops.src_color, c, s, d, ops.constant);
    const float d_factor =
        blend_factor_reference(c == 3 ? ops.dst_alpha : ops.dst_color, c, s, d, ops.constant);
    out[c] = clamp_unit(blend_equation_reference(ops.equation, s[c], s_factor, d[c], d_factor));
  }
  return out;
}

}  // namespace tessera::detail
