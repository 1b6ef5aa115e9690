// Arithmetic of the accumulation buffer: signed components, 1.0 is 32767 or 2^31 - 1. Results saturate at the
// ends of the signed integer's range.
#pragma once

#include <array>
#include <cstdint>

#include "scene.h"

namespace tessera::reference {

/// Red, green, blue, alpha.
using AccumPixel = std::array<std::int32_t, 4>;

/// Rounds each component to the nearest level, halves up, like every stored level.
AccumPixel accum_levels(Vec4 value, int bits);

/// Accumulation value of one pixel after any operation but kReturn.
/// @param color  as read back from the colour buffer; used by kAccum and kLoad.
AccumPixel accumulated(AccumOp op, double value, const AccumPixel& stored, Vec4 color, int bits);

/// The colour that kReturn writes, clamped to 0..1.
Vec4 returned(double value, const AccumPixel& stored, int bits);

}  // namespace tessera::reference
