#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/shading/power_lanes.cpp"
#include "framebuffer/lanes.h"

#include "shading/power-inl.h"
#include "shading/power_reference.h"
#include "tests/shading/power_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

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
    const Float y = function == test::PowerFunction::power  ? power_lanes(x, exponent)
                    : function == test::PowerFunction::log2 ? log2_lanes(x)
                                                            : exp2_lanes(x);
    hn::StoreU(y, kFloat, results + i);
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
