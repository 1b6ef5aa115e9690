#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/power_lanes.cpp"
#include "framebuffer/lanes.h"

#include "shading/power-inl.h"
#include "shading/power_reference.h"
#include "tests/shading/power_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

HWY_INLINE Float evaluate_one(test::PowerFunction function, Float x, float exponent) {
  switch (function) {
    case test::PowerFunction::power: return power_lanes(x, exponent);
    case test::PowerFunction::log2: return log2_lanes(x);
    default: return exp2_lanes(x);
  }
}

void evaluate_power_lanes(test::PowerFunction function, const float* arguments, float exponent,
                          float* results, std::size_t count) {
  if (function == test::PowerFunction::chosen)
    return with_power(make_power(exponent), [&](const auto& raise) HWY_ATTR {
      for (std::size_t i = 0; i < count; i += kLanes) {
        Float x[] = {hn::LoadU(kFloat, arguments + i)};
        raise(x);
        hn::StoreU(x[0], kFloat, results + i);
      }
    });
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Float x = hn::LoadU(kFloat, arguments + i);
    hn::StoreU(evaluate_one(function, x, exponent), kFloat, results + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::test {
EvaluatePower* evaluate_power(InstructionSet isa) { return TESSERA_KERNEL(isa, evaluate_power_lanes); }
}  // namespace tessera::test
#endif
