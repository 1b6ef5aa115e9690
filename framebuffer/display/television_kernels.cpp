#include "framebuffer/display/television_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/display/television_kernels.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <cstddef>

#include "framebuffer/display/display_lanes-inl.h"
#include "framebuffer/display/television_system.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

static_assert(kSampleGroup % (4 * kFloatLanes) == 0 && Subcarrier::kSize >= kFloatLanes + 4);

void average_pixels(const ConstYuvPointers& pixels, const PixelAreas& areas, const YuvPointers& samples) {
  const float* const weights = areas.weights.data();
  for (int k = 0; k < areas.count; k += kFloatLanes) {
    const IntVec first = hn::LoadU(kInts, areas.first.data() + k);
    FloatVec y = splat(0), u = splat(0), v = splat(0);
    for (int tap = 0; tap < areas.taps; ++tap) {
      const FloatVec weight = load(weights + static_cast<std::ptrdiff_t>(tap) * areas.count + k);
      y = mul_add(hn::GatherIndex(kFloats, pixels.y + tap, first), weight, y);
      u = mul_add(hn::GatherIndex(kFloats, pixels.u + tap, first), weight, u);
      v = mul_add(hn::GatherIndex(kFloats, pixels.v + tap, first), weight, v);
    }
    store(y, samples.y + k);
    store(u, samples.u + k);
    store(v, samples.v + k);
  }
}

/// Computes several vectors at a time, because each sum waits for its last addition.
void filter(const float* samples, const FilterTaps& taps, float* out, int count) {
  constexpr int kVectors = std::clamp(kSampleGroup / kFloatLanes, 4, 8);
  for (int k = 0; k < count; k += kVectors * kFloatLanes) {
    FloatVec sums[kVectors];
    for (FloatVec& sum : sums) sum = splat(0);
    const float* from = samples + k + taps.first;
    for (const float value : taps.taps) {
      const FloatVec tap = splat(value);
      for (int j = 0; j < kVectors; ++j) sums[j] = mul_add(load(from + j * kFloatLanes), tap, sums[j]);
      from += taps.step;
    }
    for (int j = 0; j < kVectors; ++j) store(sums[j], out + k + j * kFloatLanes);
  }
}

void modulate(const ConstYuvPointers& line, const Subcarrier& carrier, float* out, int count) {
  for (int k = 0; k < count; k += kFloatLanes) {
    const FloatVec with_u = mul_add(load(line.u + k), load(carrier.u.data() + k % 4), load(line.y + k));
    store(mul_add(load(line.v + k), load(carrier.v.data() + k % 4), with_u), out + k);
  }
}

// For chroma U sin(a) +- V cos(a) with constant U and V, the band is b = U sin(a) +- V cos(a) and the
// quadrature is q = U cos(a) -+ V sin(a). Hence U = b sin(a) + q cos(a) and V = +-(b cos(a) - q sin(a)).
void demodulate(const float* band, const float* quadrature, const Subcarrier& carrier, float* u, float* v,
                int count) {
  for (int k = 0; k < count; k += kFloatLanes) {
    const FloatVec b = load(band + k), q = load(quadrature + k);
    const float* const carrier_u = carrier.u.data() + k % 4;
    const float* const carrier_v = carrier.v.data() + k % 4;
    store(mul_add(b, load(carrier_u), hn::Mul(q, load(carrier_u + 1))), u + k);
    store(mul_add(b, load(carrier_v), hn::Mul(q, load(carrier_v + 1))), v + k);
  }
}

void subtract(const float* a, const float* b, float* out, int count) {
  for (int k = 0; k < count; k += kFloatLanes) store(hn::Sub(load(a + k), load(b + k)), out + k);
}

void half_difference(const float* a, const float* b, float* out, int count) {
  for (int k = 0; k < count; k += kFloatLanes)
    store(hn::Mul(hn::Sub(load(a + k), load(b + k)), splat(.5f)), out + k);
}

void half_sum(const float* a, const float* b, float* out, int count) {
  for (int k = 0; k < count; k += kFloatLanes)
    store(hn::Mul(hn::Add(load(a + k), load(b + k)), splat(.5f)), out + k);
}

void to_rgb(const ConstYuvPointers& line, const RgbPointers& out, int count) {
  constexpr auto kRedOfV = static_cast<float>(1 / kVScale);
  constexpr auto kBlueOfU = static_cast<float>(1 / kUScale);
  constexpr auto kGreenOfU = static_cast<float>(-kLumaBlue / kLumaGreen / kUScale);
  constexpr auto kGreenOfV = static_cast<float>(-kLumaRed / kLumaGreen / kVScale);
  for (int k = 0; k < count; k += kFloatLanes) {
    const FloatVec y = load(line.y + k), u = load(line.u + k), v = load(line.v + k);
    store(mul_add(v, splat(kRedOfV), y), out.r + k);
    store(mul_add(v, splat(kGreenOfV), mul_add(u, splat(kGreenOfU), y)), out.g + k);
    store(mul_add(u, splat(kBlueOfU), y), out.b + k);
  }
}

}  // namespace

TelevisionKernels make_television_kernels() {
  return {.average_pixels = average_pixels,
          .filter = filter,
          .modulate = modulate,
          .demodulate = demodulate,
          .subtract = subtract,
          .half_difference = half_difference,
          .half_sum = half_sum,
          .to_rgb = to_rgb};
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

TelevisionKernels television_kernels([[maybe_unused]] InstructionSet isa) {
  return (TESSERA_KERNEL(isa, make_television_kernels))();
}

}  // namespace tessera::detail
#endif
