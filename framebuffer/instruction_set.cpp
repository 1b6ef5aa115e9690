#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/instruction_set.cpp"
#include "framebuffer/lanes.h"

#if HWY_ONCE
namespace tessera::detail {

// The features that Highway compiles each target with (HWY_TARGET_STR), and AVX512CD for duplicate_lanes().
#if HWY_TARGETS & HWY_AVX2
static bool machine_has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("f16c") &&
         __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
}
#endif
#if HWY_TARGETS & HWY_AVX3
static bool machine_has_avx512() {
  return machine_has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd");
}
#endif

std::vector<InstructionSet> available_isas() {
  std::vector<InstructionSet> found;
#if HWY_TARGETS & HWY_AVX3
  if (machine_has_avx512()) found.push_back(InstructionSet::avx512);
#endif
#if HWY_TARGETS & HWY_AVX2
  if (machine_has_avx2()) found.push_back(InstructionSet::avx2);
#endif
  found.push_back(InstructionSet::scalar);
  return found;
}

bool machine_has_gfni() {
#if HWY_TARGETS & HWY_AVX3
  return machine_has_avx512() && __builtin_cpu_supports("gfni");
#else
  return false;
#endif
}

bool machine_has_fast_gather() {
#if HWY_TARGETS & HWY_AVX3
  // AVX512-FP16 identifies Sapphire Rapids and later, which are not slowed down by the gather mitigation
  // (INTEL-SA-00828).
  return machine_has_avx512() && __builtin_cpu_is("intel") && __builtin_cpu_supports("avx512fp16");
#else
  return false;
#endif
}

}  // namespace tessera::detail
#endif  // HWY_ONCE
