#include "framebuffer/display/signal_to_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/display/signal_to_light.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "framebuffer/display/display_lanes-inl.h"
#include "framebuffer/display/power.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

/// LightTable::at()
HWY_INLINE FloatVec light_at(const LightTable& table, FloatVec signal) {
  const FloatVec last = splat(static_cast<float>(table.values.size() - 1));
  FloatVec position = hn::Mul(hn::Sub(signal, splat(table.first)), splat(table.nodes_per_unit));
  position = hn::Min(hn::Max(position, splat(0)), last);
  // The last node is reached from the left, so that a node follows every index.
  const IntVec node =
      hn::Min(hn::ConvertTo(kInts, position), hn::Set(kInts, static_cast<int>(table.values.size()) - 2));
  const FloatVec fraction = hn::Sub(position, hn::ConvertTo(kFloats, node));
  const FloatVec left = hn::GatherIndex(kFloats, table.values.data(), node);
  const FloatVec right = hn::GatherIndex(kFloats, table.values.data() + 1, node);
  return mul_add(fraction, hn::Sub(right, left), left);
}

void signal_to_light(const float* signal, int samples, const SignalResponse& response, float* light) {
  for (int row = 0; row < kBlockRows; row += kFloatLanes) {
    FloatVec amplifier = splat(0);
    const float* in = signal + row;
    float* out = light + row;
    for (int sample = 0; sample < samples; ++sample, in += kBlockRows) {
      const FloatVec target = load(in);
      const FloatVec step = hn::Sub(amplifier, target);
      for (int k = 0; k < response.subsamples; ++k, out += kBlockRows)
        store(light_at(*response.light,
                       mul_add(step, splat(response.missing[static_cast<std::size_t>(k)]), target)),
              out);
      amplifier = mul_add(step, splat(response.missing_at_end), target);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

float LightTable::at(float signal) const {
  const float last = static_cast<float>(values.size() - 1);
  const float position = std::min(std::max((signal - first) * nodes_per_unit, 0.0f), last);
  const std::size_t node = std::min(static_cast<std::size_t>(position), values.size() - 2);
  const float left = values[node], right = values[node + 1];
  return std::fma(position - static_cast<float>(node), right - left, left);
}

LightTable tube_light(double gamma, double black) {
  constexpr double kFirst = -0.25, kLast = 1.75;
  constexpr int kNodesPerUnit = 1020;  // a node at each level of 255
  const double black_root = power(black, 1 / gamma);
  const double b = black_root / (1 - black_root);
  const double a = power(1 - black_root, gamma);
  LightTable table{.first = kFirst, .nodes_per_unit = kNodesPerUnit, .values = {}};
  for (int node = 0; node <= (kLast - kFirst) * kNodesPerUnit; ++node) {
    const double signal = kFirst + static_cast<double>(node) / kNodesPerUnit;
    table.values.push_back(static_cast<float>(a * power(std::max(signal + b, 0.0), gamma)));
  }
  return table;
}

SignalResponse signal_response(int subsamples, double time_constant, const LightTable& light) {
  SignalResponse response{.subsamples = subsamples, .missing = {}, .missing_at_end = 0, .light = &light};
  if (time_constant == 0) return response;
  for (int k = 0; k < subsamples; ++k)
    response.missing[static_cast<std::size_t>(k)] =
        static_cast<float>(exponential(-(k + 0.5) / subsamples / time_constant));
  response.missing_at_end = static_cast<float>(exponential(-1 / time_constant));
  return response;
}

SignalToLightFn* signal_to_light_for(InstructionSet isa) { return TESSERA_KERNEL(isa, signal_to_light); }

}  // namespace tessera::detail
#endif
