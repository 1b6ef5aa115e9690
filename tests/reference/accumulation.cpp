#include "accumulation.h"

#include <algorithm>
#include <cmath>

#include "lighting.h"

namespace tessera::reference {
namespace {

double one(int bits) { return std::ldexp(1.0, bits - 1) - 1; }

std::int32_t saturated(double level, int bits) {
  return static_cast<std::int32_t>(std::clamp(std::floor(level + 0.5), -one(bits) - 1, one(bits)));
}

}  // namespace

AccumPixel accum_levels(Vec4 value, int bits) {
  const auto level = [&](double v) { return saturated(v * one(bits), bits); };
  return {level(value.x), level(value.y), level(value.z), level(value.w)};
}

AccumPixel accumulated(AccumOp op, double value, const AccumPixel& stored, Vec4 color, int bits) {
  const std::array<double, 4> c{color.x, color.y, color.z, color.w};
  AccumPixel result = stored;
  for (std::size_t i = 0; i < 4; ++i) {
    const double acc = stored[i];
    switch (op) {
      case AccumOp::kAccum: result[i] = saturated(acc + value * c[i] * one(bits), bits); break;
      case AccumOp::kLoad: result[i] = saturated(value * c[i] * one(bits), bits); break;
      case AccumOp::kAdd: result[i] = saturated(acc + value * one(bits), bits); break;
      case AccumOp::kMult: result[i] = saturated(acc * value, bits); break;
      case AccumOp::kReturn: break;
    }
  }
  return result;
}

Vec4 returned(double value, const AccumPixel& stored, int bits) {
  const auto component = [&](std::size_t i) { return value * (stored[i] / one(bits)); };
  return clamp01(Vec4{component(0), component(1), component(2), component(3)});
}

}  // namespace tessera::reference
