#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/fragment_ops_lanes.cpp"
#include "framebuffer/lanes.h"

#include "shading/fragment_ops-inl.h"
#include "tests/shading/fragment_ops_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void store_fragments_lanes(const FragmentOps& ops, const ColorLayout& layout,
                           const test::FragmentArrays& arrays) {
  for (std::size_t i = 0; i < arrays.count; i += kLanes) {
    Colors source;
    for (int c = 0; c < 4; ++c) source.c[c] = hn::LoadU(kFloat, arrays.source[c] + i);
    const Int stored = hn::LoadU(kInt, arrays.stored + i);
    if (ops.blend) source = blend_lanes(ops, source, unpack_colors(layout, stored));
    const Int words = pack_colors(layout, source, splat(arrays.threshold));
    hn::StoreU(ops.logic == LogicOp::copy ? words : logic_op_lanes(ops.logic, words, stored), kInt,
               arrays.words + i);
  }
}

void test_stencil_lanes(const StencilSide& side, std::int32_t most, const test::FragmentArrays& arrays) {
  const StencilTestConstants steps = stencil_test_constants(side, most);
  for (std::size_t i = 0; i < arrays.count; i += kLanes) {
    const Int stored = hn::LoadU(kInt, arrays.stored + i), outcome = hn::LoadU(kInt, arrays.outcome + i);
    const LaneMask covered = hn::Gt(outcome, hn::Zero(kInt)), deep = hn::Gt(outcome, splat(1));
    const LaneMask passed = hn::And(covered, stencil_passes(steps, stored)), zpassed = hn::And(passed, deep);
    const Int value =
        stencil_result(steps, stored, hn::AndNot(passed, covered), hn::AndNot(zpassed, passed), zpassed);
    hn::StoreU(hn::Or(value, hn::And(hn::VecFromMask(kInt, passed), splat(256))), kInt, arrays.words + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
StoreFragments* store_fragments(InstructionSet isa) { return TESSERA_KERNEL(isa, store_fragments_lanes); }
TestStencil* test_stencil(InstructionSet isa) { return TESSERA_KERNEL(isa, test_stencil_lanes); }
}  // namespace tessera::test
#endif
