// Compiles the kernels of a translation unit once per instruction set. Usage, at the top of a .cpp:
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "raster/binning.cpp"
//   #include "framebuffer/lanes.h"        // then all std headers, then any "*-inl.h", then
//   HWY_BEFORE_NAMESPACE();
//   namespace tessera::detail { namespace HWY_NAMESPACE { void kernel(...) {...} } }
//   HWY_AFTER_NAMESPACE();
//   #if HWY_ONCE
//   namespace tessera::detail {
//   KernelFn* kernel_for(InstructionSet isa) { return TESSERA_KERNEL(isa, kernel); }
//   }
//   #endif
//
// Highway's SSSE3 and SSE4 targets are disabled: without fused multiply-add their results would differ. Older
// x86 takes the scalar path, which fuses with std::fma.
#ifndef TESSERA_LANES_CONFIGURED
#define TESSERA_LANES_CONFIGURED
#ifdef TESSERA_WITHOUT_AVX512
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_AVX3)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#define HWY_IS_DEBUG_BUILD 0  // Highway's asserts call its library, which is not linked
#define HWY_BROKEN_EMU128 1   // the baseline of every compiler is a single lane
// Vectors on x86 only: kernels depend on the widths and layouts of its vectors (raster/lane_packing-inl.h).
#if defined(TESSERA_SCALAR_ONLY) || !defined(__x86_64__)
#define HWY_COMPILE_ONLY_SCALAR
#endif
#endif

#include "framebuffer/instruction_set.h"

#include "hwy/foreach_target.h"  // IWYU pragma: keep
// highway.h must follow foreach_target.h
#include "hwy/highway.h"

#if HWY_TARGETS & HWY_AVX3
#define TESSERA_KERNEL_AVX512(isa, fn) (isa) == ::tessera::InstructionSet::avx512 ? &N_AVX3::fn:
#else
#define TESSERA_KERNEL_AVX512(isa, fn)
#endif
#if HWY_TARGETS & HWY_AVX2
#define TESSERA_KERNEL_AVX2(isa, fn) (isa) == ::tessera::InstructionSet::avx2 ? &N_AVX2::fn:
#else
#define TESSERA_KERNEL_AVX2(isa, fn)
#endif
/// The address of `fn` compiled for `isa`.
#define TESSERA_KERNEL(isa, fn) \
  (static_cast<void>(isa),      \
   TESSERA_KERNEL_AVX512(isa, fn) TESSERA_KERNEL_AVX2(isa, fn) & HWY_STATIC_DISPATCH(fn))
