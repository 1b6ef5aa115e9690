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
    const Int packed = pack_colors(layout, source, splat(arrays.threshold), ops.dither);
    const Int result = ops.logic == LogicOp::copy ? packed : logic_op_lanes(ops.logic, packed, stored);
    hn::StoreU(result, kInt, arrays.results + i);
  }
}

void test_stencil_lanes(const StencilSide& side, std::int32_t max_value, const test::FragmentArrays& arrays) {
  const StencilTestConstants constants = stencil_test_constants(side, max_value);
  for (std::size_t i = 0; i < arrays.count; i += kLanes) {
    const Int stored = hn::LoadU(kInt, arrays.stored + i);
    const Int outcome = hn::LoadU(kInt, arrays.outcome + i);
    const LaneMask covered = hn::Gt(outcome, hn::Zero(kInt));
    const LaneMask passed = hn::And(covered, stencil_passes(constants, stored));
    const LaneMask failed = hn::AndNot(passed, covered);
    const LaneMask zpassed = hn::And(passed, hn::Gt(outcome, splat(1)));
    const LaneMask zfailed = hn::AndNot(zpassed, passed);
    const Int value = stencil_result(constants, stored, failed, zfailed, zpassed);
    const Int passed_bit = hn::And(hn::VecFromMask(kInt, passed), splat(256));
    hn::StoreU(hn::Or(value, passed_bit), kInt, arrays.results + i);
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
