// Fragment operations on one chunk of pixels. Twin: fragment_ops_reference.h.
#if defined(TESSERA_SHADING_FRAGMENT_OPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_FRAGMENT_OPS_INL_H_
#undef TESSERA_SHADING_FRAGMENT_OPS_INL_H_
#else
#define TESSERA_SHADING_FRAGMENT_OPS_INL_H_
#endif

#include "framebuffer/format.h"
#include "raster/lanes-inl.h"
#include "shading/fragment_ops.h"
#include "shading/stencil_constants.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

HWY_INLINE LaneMask no_lanes() { return hn::Gt(hn::Zero(kInt), hn::Zero(kInt)); }

template <class Vector>
HWY_INLINE auto compare_lanes(Vector a, Compare op, Vector b) {
  const auto less = hn::Lt(a, b);
  const auto equal = hn::Eq(a, b);
  const auto greater = hn::Lt(b, a);
  switch (op) {
    case Compare::never: return hn::And(less, greater);
    case Compare::less: return less;
    case Compare::equal: return equal;
    case Compare::lequal: return hn::Or(less, equal);
    case Compare::greater: return greater;
    case Compare::notequal: return hn::Or(less, greater);
    case Compare::gequal: return hn::Or(greater, equal);
    default: return hn::Or(hn::Or(less, equal), greater);
  }
}

/// Lanes that pass the stencil test.
HWY_INLINE LaneMask stencil_passes(const StencilTestConstants& stencil, Int stored) {
  const Int first = splat(static_cast<std::int32_t>(stencil.passing.first));
  const Int count = splat(static_cast<std::int32_t>(stencil.passing.count));
  const Int from_first = hn::Sub(hn::And(stored, splat(stencil.mask)), first);
  return hn::RebindMask(kInt, hn::Lt(hn::BitCast(kUint, from_first), hn::BitCast(kUint, count)));
}

HWY_INLINE Int stencil_op_lanes(const StencilOpConstants& op, Int stored) {
  const Int value = hn::Add(hn::Xor(hn::And(stored, splat(op.keep)), splat(op.flip)), splat(op.add));
  return hn::Min(hn::Max(value, splat(op.min_value)), splat(op.max_value));
}

/// Stencil values after the tests.
/// @param failed   lanes that failed the stencil test
/// @param zfailed  lanes that passed it and failed the depth test
/// @param zpassed  lanes that passed both
HWY_INLINE Int stencil_result(const StencilTestConstants& stencil, Int stored, LaneMask failed,
                              LaneMask zfailed, LaneMask zpassed) {
  Int value = stored;
  if (stencil.fail_writes) value = hn::IfThenElse(failed, stencil_op_lanes(stencil.fail, stored), value);
  if (stencil.zfail_writes) value = hn::IfThenElse(zfailed, stencil_op_lanes(stencil.zfail, stored), value);
  if (stencil.zpass_writes) value = hn::IfThenElse(zpassed, stencil_op_lanes(stencil.zpass, stored), value);
  const Int mask = splat(stencil.write_mask);
  return hn::Or(hn::AndNot(mask, stored), hn::And(value, mask));
}

struct Colors {
  Float c[4];  // r g b a
};

/// Clamps to 0..1. A NaN becomes 0.
HWY_INLINE Float clamped_unit(Float c) { return lesser_of(greater_of(c, hn::Zero(kFloat)), splat(1.0f)); }

/// Clamps to 0 or more. A NaN becomes 0.
HWY_INLINE Float clamped_below(Float c) { return hn::Max(c, hn::Zero(kFloat)); }

/// Component 0..1 of packed colours; 1 if it has no bits.
HWY_INLINE Float component_from(Int packed, int shift, int bits) {
  if (bits == 0) return splat(1.0f);
  const Int level = hn::And(hn::BitCast(kInt, hn::ShiftRightSame(hn::BitCast(kUint, packed), shift)),
                            splat((1 << bits) - 1));
  return hn::Mul(hn::ConvertTo(kFloat, level), splat(1.0f / static_cast<float>((1 << bits) - 1)));
}

HWY_INLINE Colors unpack_colors(const ColorLayout& layout, Int packed) {
  const Float a = component_from(packed, layout.bits, layout.alpha_bits);
  if (layout.luminance) {
    const Float l = component_from(packed, 0, layout.bits);
    return {{l, l, l, a}};
  }
  return {{component_from(packed, layout.r_shift(), layout.r_bits),
           component_from(packed, layout.g_shift(), layout.g_bits), component_from(packed, 0, layout.b_bits),
           a}};
}

HWY_INLINE Float blend_factor_lanes(BlendFactor factor, int c, const Colors& s, const Colors& d,
                                    const std::array<float, 4>& constant) {
  const Float one = splat(1.0f);
  switch (factor) {
    case BlendFactor::zero: return hn::Zero(kFloat);
    case BlendFactor::one: return one;
    case BlendFactor::src_color: return s.c[c];
    case BlendFactor::one_minus_src_color: return hn::Sub(one, s.c[c]);
    case BlendFactor::dst_color: return d.c[c];
    case BlendFactor::one_minus_dst_color: return hn::Sub(one, d.c[c]);
    case BlendFactor::src_alpha: return s.c[3];
    case BlendFactor::one_minus_src_alpha: return hn::Sub(one, s.c[3]);
    case BlendFactor::dst_alpha: return d.c[3];
    case BlendFactor::one_minus_dst_alpha: return hn::Sub(one, d.c[3]);
    case BlendFactor::constant_color: return splat(constant[static_cast<std::size_t>(c)]);
    case BlendFactor::one_minus_constant_color:
      return hn::Sub(one, splat(constant[static_cast<std::size_t>(c)]));
    case BlendFactor::constant_alpha: return splat(constant[3]);
    case BlendFactor::one_minus_constant_alpha: return hn::Sub(one, splat(constant[3]));
    default: {
      const Float one_minus_dst_alpha = hn::Sub(one, d.c[3]);
      return c == 3 ? one : lesser_of(one_minus_dst_alpha, s.c[3]);
    }
  }
}

HWY_INLINE Colors blend_lanes(const FragmentOps& ops, const Colors& s, const Colors& d) {
  Colors out;
  for (int c = 0; c < 4; ++c) {
    const Float s_factor = blend_factor_lanes(c == 3 ? ops.src_alpha : ops.src_color, c, s, d, ops.constant);
    const Float d_factor = blend_factor_lanes(c == 3 ? ops.dst_alpha : ops.dst_color, c, s, d, ops.constant);
    Float result;
    switch (ops.equation) {
      case BlendEquation::add: result = mul_add(s.c[c], s_factor, hn::Mul(d.c[c], d_factor)); break;
      case BlendEquation::subtract:
        result = mul_add(s.c[c], s_factor, hn::Neg(hn::Mul(d.c[c], d_factor)));
        break;
      case BlendEquation::reverse_subtract:
        result = neg_mul_add(s.c[c], s_factor, hn::Mul(d.c[c], d_factor));
        break;
      case BlendEquation::min: result = lesser_of(d.c[c], s.c[c]); break;
      default: result = greater_of(d.c[c], s.c[c]); break;
    }
    out.c[c] = clamped_unit(result);
  }
  return out;
}

/// ComponentTable::at().
HWY_INLINE Float table_lanes(const ComponentTable& table, Float c) {
  const Float position = hn::Mul(c, splat(table.intervals()));
  const Int node = truncate(position);
  const Float left = hn::GatherIndex(kFloat, table.values(), node);
  const Float right = hn::GatherIndex(kFloat, table.values() + 1, node);
  return mul_add(hn::Sub(position, hn::ConvertTo(kFloat, node)), hn::Sub(right, left), left);
}

/// Packs clamped colours in an RGB or luminance layout.
/// @param dither  in light, it changes the components before the threshold; null: it does not
HWY_INLINE Int pack_colors(const ColorLayout& layout, const Colors& colors, Float threshold,
                           const ColorDither* dither = nullptr) {
  const auto level = [&](Float x, int bits) HWY_ATTR {
    return truncate(mul_add(x, splat(static_cast<float>((1 << bits) - 1)), threshold));
  };
  const auto component = [&](std::size_t c, Float x) HWY_ATTR {
    const ComponentTable* const table = dither != nullptr ? dither->table(c) : nullptr;
    return table != nullptr ? table_lanes(*table, x) : x;
  };
  Int packed = hn::Zero(kInt);
  if (layout.alpha_bits != 0) packed = hn::ShiftLeftSame(level(colors.c[3], layout.alpha_bits), layout.bits);
  if (layout.luminance) {
    const Float luminance = mul_add(splat(kLumaR), colors.c[0],
                                    mul_add(splat(kLumaG), colors.c[1], hn::Mul(splat(kLumaB), colors.c[2])));
    return hn::Or(packed, level(component(0, clamped_unit(luminance)), layout.bits));
  }
  const Int red = level(component(0, colors.c[0]), layout.r_bits);
  const Int green = level(component(1, colors.c[1]), layout.g_bits);
  packed = hn::Or(packed, hn::ShiftLeftSame(red, layout.r_shift()));
  packed = hn::Or(packed, hn::ShiftLeftSame(green, layout.g_shift()));
  return hn::Or(packed, level(component(2, colors.c[2]), layout.b_bits));
}

/// pack_colors() for 8 bits per component and no alpha, rounded to nearest.
HWY_INLINE Int pack_rgb8(const Colors& colors) {
  const auto level = [&](int c) HWY_ATTR {
    const Float scaled = mul_add(colors.c[c], splat(255.0f), splat(0.5f));
    return truncate(scaled);
  };
  return hn::Or(hn::Or(hn::ShiftLeft<16>(level(0)), hn::ShiftLeft<8>(level(1))), level(2));
}

HWY_INLINE Int logic_op_lanes(LogicOp logic, Int s, Int d) {
  switch (logic) {
    case LogicOp::clear: return hn::Zero(kInt);
    case LogicOp::bit_and: return hn::And(s, d);
    case LogicOp::and_reverse: return hn::AndNot(d, s);
    case LogicOp::copy: return s;
    case LogicOp::and_inverted: return hn::AndNot(s, d);
    case LogicOp::noop: return d;
    case LogicOp::bit_xor: return hn::Xor(s, d);
    case LogicOp::bit_or: return hn::Or(s, d);
    case LogicOp::nor: return hn::Not(hn::Or(s, d));
    case LogicOp::equiv: return hn::Not(hn::Xor(s, d));
    case LogicOp::invert: return hn::Not(d);
    case LogicOp::or_reverse: return hn::Or(s, hn::Not(d));
    case LogicOp::copy_inverted: return hn::Not(s);
    case LogicOp::or_inverted: return hn::Or(hn::Not(s), d);
    case LogicOp::nand: return hn::Not(hn::And(s, d));
    default: return splat(-1);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
