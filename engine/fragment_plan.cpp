#include "engine/fragment_plan.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

static_assert(static_cast<int>(CompareOp::always) == static_cast<int>(Compare::always) &&
              static_cast<int>(CompareOp::greater) == static_cast<int>(Compare::greater));
static_assert(static_cast<int>(StencilAction::decr_wrap) == static_cast<int>(StencilOp::decr_wrap) &&
              static_cast<int>(StencilAction::replace) == static_cast<int>(StencilOp::replace));
static_assert(static_cast<int>(Factor::src_alpha_saturate) ==
                  static_cast<int>(BlendFactor::src_alpha_saturate) &&
              static_cast<int>(Factor::dst_color) == static_cast<int>(BlendFactor::dst_color));
static_assert(static_cast<int>(Equation::max) == static_cast<int>(BlendEquation::max) &&
              static_cast<int>(Logic::set) == static_cast<int>(LogicOp::set));

StencilSide side(const StencilFace& face, std::int32_t max_value) {
  return {.func = static_cast<CompareOp>(face.func),
          .reference =
              static_cast<std::int32_t>(std::min<std::uint32_t>(face.ref, static_cast<std::uint32_t>(max_value))),
          .mask = static_cast<std::int32_t>(face.mask) & max_value,
          .fail = static_cast<StencilAction>(face.fail),
          .zfail = static_cast<StencilAction>(face.zfail),
          .zpass = static_cast<StencilAction>(face.zpass),
          .write_mask = static_cast<std::int32_t>(face.write_mask) & max_value};
}

bool does_nothing(const StencilSide& side) { return side.func == CompareOp::always && !side.writes(); }

void plan_stencil(FragmentPlan& plan, const StencilState& state, int bits) {
  FragmentOps& ops = plan.ops;
  ops.stencil_max = (1 << bits) - 1;
  ops.faces[0] = side(state.front, ops.stencil_max);
  ops.faces[1] = side(state.back.value_or(state.front), ops.stencil_max);
  ops.stencil = plan.uses_stencil = !does_nothing(ops.faces[0]) || !does_nothing(ops.faces[1]);
}

// Takes the source as it is.
bool is_replacing(const FragmentOps& ops) {
  return ops.src_color == Factor::one && ops.src_alpha == Factor::one && ops.dst_color == Factor::zero &&
         ops.dst_alpha == Factor::zero &&
         (ops.equation == Equation::add || ops.equation == Equation::subtract);
}

void plan_blend(FragmentOps& ops, const BlendState& state) {
  ops.src_color = static_cast<Factor>(state.src);
  ops.dst_color = static_cast<Factor>(state.dst);
  ops.src_alpha = static_cast<Factor>(state.src_alpha.value_or(state.src));
  ops.dst_alpha = static_cast<Factor>(state.dst_alpha.value_or(state.dst));
  ops.equation = static_cast<Equation>(state.equation);
  ops.constant = {state.color.r, state.color.g, state.color.b, state.color.a};
  ops.blend = !is_replacing(ops);
}

}  // namespace

FragmentOps dither_ops(const FrameBufferState& target) {
  FragmentOps ops;
  const Dither dither = target.format.dither;
  set_dither(ops,
             dither == Dither::none     ? 1
             : dither == Dither::bayer2 ? 2
             : dither == Dither::bayer4 ? 4
                                        : 8,
             target.format.height);
  if (target.layout.index)
    ops.palette_spread = static_cast<float>(
        1 / std::fmax(1.0, std::cbrt(static_cast<double>(target.palette.entries.size())) - 1));
  return ops;
}

FragmentPlan plan_fragments(const DrawState& state, const FrameBufferState& target, bool writes_color,
                            bool only_indices, std::string* reasons) {
  FragmentPlan plan;
  FragmentOps& ops = plan.ops;
  const auto note = [&](const char* line) {
    if (reasons) *reasons += std::string("  ") + line + "\n";
  };
  if (writes_color && !only_indices) ops = dither_ops(target);
  if (state.alpha_test) {
    ops.alpha_func = static_cast<CompareOp>(state.alpha_test->func);
    ops.alpha_reference = state.alpha_test->ref;
    ops.alpha_test = ops.alpha_func != CompareOp::always;
    note(ops.alpha_test ? "alpha test" : "alpha test: always passes, left out");
  }
  if (state.stencil) {
    plan_stencil(plan, *state.stencil, target.format.stencil_bits);
    note(ops.stencil ? "stencil test" : "stencil: always passes and writes nothing, left out");
  }
  if (writes_color && state.blend) {
    plan_blend(ops, *state.blend);
    note(ops.blend ? "blending" : "blending: replaces what was there, left out");
  }
  if (writes_color && ops.dither) note("ordered dither");
  if (writes_color && only_indices && target.format.dither != Dither::none) note("indices are not dithered");
  if (writes_color && state.logic_op != LogicOp::copy) {
    ops.logic = static_cast<Logic>(state.logic_op);
    note("logic operation");
  }
  const bool stores_alpha = writes_color && target.layout.alpha_bits > 0;
  if (stores_alpha) note("alpha planes");
  const bool depends_on_color =
      ops.alpha_test || ops.blend || ops.dither || ops.logic != Logic::copy || stores_alpha;
  plan.needed = ops.stencil || depends_on_color;
  plan.is_stencil_only = ops.stencil && !depends_on_color;
  return plan;
}

}  // namespace tessera
