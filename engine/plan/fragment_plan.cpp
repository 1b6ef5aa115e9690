#include "engine/plan/fragment_plan.h"

#include <algorithm>
#include <cmath>

#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

StencilSide side(const StencilFace& face, std::int32_t max_value) {
  return {.func = face.func,
          .reference = static_cast<std::int32_t>(
              std::min<std::uint32_t>(face.ref, static_cast<std::uint32_t>(max_value))),
          .mask = static_cast<std::int32_t>(face.mask) & max_value,
          .fail = face.fail,
          .zfail = face.zfail,
          .zpass = face.zpass,
          .write_mask = static_cast<std::int32_t>(face.write_mask) & max_value};
}

bool does_nothing(const StencilSide& side) { return side.func == Compare::always && !side.writes(); }

void plan_stencil(FragmentPlan& plan, const StencilState& state, int bits) {
  FragmentOps& ops = plan.ops;
  ops.stencil_max = (1 << bits) - 1;
  ops.faces[0] = side(state.front, ops.stencil_max);
  ops.faces[1] = side(state.back.value_or(state.front), ops.stencil_max);
  ops.stencil = plan.uses_stencil = !does_nothing(ops.faces[0]) || !does_nothing(ops.faces[1]);
}

/// The blend yields the source colour.
bool is_replacing(const FragmentOps& ops) {
  const bool keeps_source = ops.src_color == BlendFactor::one && ops.src_alpha == BlendFactor::one;
  const bool drops_destination = ops.dst_color == BlendFactor::zero && ops.dst_alpha == BlendFactor::zero;
  const bool sums = ops.equation == BlendEquation::add || ops.equation == BlendEquation::subtract;
  return keeps_source && drops_destination && sums;
}

/// The blend yields the destination colour.
bool is_keeping(const FragmentOps& ops) {
  const bool drops_source = ops.src_color == BlendFactor::zero && ops.src_alpha == BlendFactor::zero;
  const bool keeps_destination = ops.dst_color == BlendFactor::one && ops.dst_alpha == BlendFactor::one;
  const bool sums = ops.equation == BlendEquation::add || ops.equation == BlendEquation::reverse_subtract;
  return drops_source && keeps_destination && sums;
}

void set_blend(FragmentOps& ops, const BlendState& state) {
  ops.src_color = state.src;
  ops.dst_color = state.dst;
  ops.src_alpha = state.src_alpha.value_or(state.src);
  ops.dst_alpha = state.dst_alpha.value_or(state.dst);
  ops.equation = state.equation;
  ops.constant = {state.color.r, state.color.g, state.color.b, state.color.a};
  ops.blend = !is_replacing(ops);
}

void plan_blend(FragmentPlan& plan, const BlendState& state, const std::optional<EqualAlpha>& alpha,
                const EffectNotes& notes) {
  FragmentOps& ops = plan.ops;
  set_blend(ops, state);
  if (!ops.blend) return notes.skipped(Effect::blending, EffectReason::replaces_destination);
  FragmentOps folded = ops;
  if (alpha) fold_alpha(folded, alpha->value);
  if (!is_replacing(folded)) return notes.active(Effect::blending);
  ops.blend = false;
  plan.is_elided = true;
  notes.skipped(Effect::blending, EffectReason::alpha_is_one, alpha->cause);
}

void plan_alpha_test(FragmentPlan& plan, const AlphaTest& state, const std::optional<EqualAlpha>& alpha,
                     const EffectNotes& notes) {
  FragmentOps& ops = plan.ops;
  ops.alpha_func = state.func;
  ops.alpha_reference = state.ref;
  ops.alpha_test = ops.alpha_func != Compare::always;
  if (!ops.alpha_test) return notes.skipped(Effect::alpha_test, EffectReason::always_passes);
  if (!alpha || ops.alpha_func == Compare::never) return notes.active(Effect::alpha_test);
  if (!compares(alpha->value, ops.alpha_func, ops.alpha_reference)) {
    ops.alpha_func = Compare::never;
    return notes.skipped(Effect::alpha_test, EffectReason::every_fragment_fails, alpha->cause);
  }
  ops.alpha_test = false;
  plan.is_elided = true;
  notes.skipped(Effect::alpha_test, EffectReason::every_fragment_passes, alpha->cause);
}

}  // namespace

bool keeps_stored_colors(const DrawState& state, const FrameBufferState& target, float alpha) {
  const ColorLayout& layout = target.layout;
  const int most_bits = std::max({layout.r_bits, layout.g_bits, layout.b_bits, layout.alpha_bits});
  if (!state.blend || layout.index || layout.luminance || most_bits > 8) return false;
  if (target.format.dither != Dither::none || state.logic_op != LogicOp::copy) return false;
  FragmentOps ops;
  set_blend(ops, *state.blend);
  fold_alpha(ops, alpha);
  return is_keeping(ops);
}

FragmentPlan plan_fragments(const DrawState& state, const FrameBufferState& target, bool writes_color,
                            bool only_indices, const std::optional<EqualAlpha>& alpha,
                            const EffectNotes& notes) {
  FragmentPlan plan;
  FragmentOps& ops = plan.ops;
  if (writes_color && !only_indices) ops.dither = target.dither.get();
  if (state.alpha_test) plan_alpha_test(plan, *state.alpha_test, alpha, notes);
  if (state.stencil) {
    plan_stencil(plan, *state.stencil, target.format.stencil_bits);
    if (ops.stencil) notes.active(Effect::stencil_test);
    else notes.skipped(Effect::stencil_test, EffectReason::passes_and_writes_nothing);
  }
  if (writes_color && state.blend) plan_blend(plan, *state.blend, alpha, notes);
  if (ops.dither != nullptr) notes.active(Effect::dither);
  if (writes_color && !only_indices && target.diffusion)
    notes.active(Effect::dither, EffectReason::per_finished_frame);
  if (writes_color && only_indices && target.format.dither != Dither::none)
    notes.skipped(Effect::dither, EffectReason::stores_indices);
  if (writes_color && state.logic_op != LogicOp::copy) {
    ops.logic = state.logic_op;
    notes.active(Effect::logic_op);
  }
  const bool stores_alpha = writes_color && target.layout.alpha_bits > 0;
  if (stores_alpha) notes.active(Effect::alpha_planes);
  const bool changes_color = ops.blend || ops.dither != nullptr || ops.logic != LogicOp::copy;
  const bool depends_on_color = ops.alpha_test || changes_color || stores_alpha;
  plan.needed = ops.stencil || depends_on_color;
  plan.is_stencil_only = ops.stencil && !depends_on_color;
  const bool reads_or_tests = ops.stencil || ops.alpha_test || ops.blend || ops.logic != LogicOp::copy;
  plan.only_dithers = ops.dither != nullptr && !reads_or_tests && !stores_alpha;
  return plan;
}

}  // namespace tessera::detail
