// Stencil test and actions as constants of one formula each, so that pixels need no branch on the operation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "shading/fragment_ops.h"

namespace tessera::detail {

/// A stencil action: min(max(((stored & keep) ^ flip) + add, min_value), max_value). The caller applies the
/// write mask. The default keeps the value.
struct StencilOpConstants {
  std::int32_t keep = -1;
  std::int32_t flip = 0;
  std::int32_t add = 0;
  std::int32_t min_value = std::numeric_limits<std::int32_t>::min();
  std::int32_t max_value = std::numeric_limits<std::int32_t>::max();

  constexpr std::int32_t operator()(std::int32_t stored) const {
    return std::min(std::max(((stored & keep) ^ flip) + add, min_value), max_value);
  }
};

/// @param max_value  of the buffer: 2^bits - 1
constexpr StencilOpConstants stencil_op_constants(StencilOp action, std::int32_t reference,
                                                  std::int32_t max_value) {
  switch (action) {
    case StencilOp::zero: return {.keep = 0};
    case StencilOp::replace: return {.keep = 0, .flip = reference};
    case StencilOp::incr: return {.add = 1, .max_value = max_value};
    case StencilOp::decr: return {.add = -1, .min_value = 0};
    case StencilOp::invert: return {.flip = -1};
    case StencilOp::incr_wrap: return {.add = 1};
    case StencilOp::decr_wrap: return {.add = -1};
    default: return {};
  }
}

/// Masked stored values that pass: `count` values from `first` on, modulo 2^32.
struct PassingValues {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// The values v, all below 2^31, for which `reference func v` holds.
constexpr PassingValues passing_values(Compare func, std::int32_t reference) {
  const auto value = static_cast<std::uint32_t>(reference);
  constexpr std::uint32_t kAllStored = std::uint32_t{1} << 31;
  switch (func) {
    case Compare::never: return {};
    case Compare::less: return {value + 1, kAllStored};
    case Compare::equal: return {value, 1};
    case Compare::lequal: return {value, kAllStored};
    case Compare::greater: return {0, value};
    case Compare::notequal: return {value + 1, ~std::uint32_t{0}};
    case Compare::gequal: return {0, value + 1};
    default: return {0, kAllStored};
  }
}

/// Stencil test and actions of one face.
struct StencilTestConstants {
  PassingValues passing;
  std::int32_t mask = 0;
  std::int32_t write_mask = 0;
  StencilOpConstants fail;
  StencilOpConstants zfail;
  StencilOpConstants zpass;
  // Whether the action of each outcome may change the stored value.
  bool fail_writes = false;
  bool zfail_writes = false;
  bool zpass_writes = false;

  constexpr bool writes() const { return fail_writes || zfail_writes || zpass_writes; }
  constexpr bool passes(std::int32_t stored) const {
    return static_cast<std::uint32_t>(stored & mask) - passing.first < passing.count;
  }
};

/// @param max_value  of the buffer: 2^bits - 1
constexpr StencilTestConstants stencil_test_constants(const StencilSide& face, std::int32_t max_value) {
  const std::int32_t write_mask = face.write_mask & max_value;
  const auto writes = [&](StencilOp action) { return action != StencilOp::keep && write_mask != 0; };
  return {.passing = passing_values(face.func, face.reference & face.mask),
          .mask = face.mask,
          .write_mask = write_mask,
          .fail = stencil_op_constants(face.fail, face.reference, max_value),
          .zfail = stencil_op_constants(face.zfail, face.reference, max_value),
          .zpass = stencil_op_constants(face.zpass, face.reference, max_value),
          .fail_writes = writes(face.fail),
          .zfail_writes = writes(face.zfail),
          .zpass_writes = writes(face.zpass)};
}

}  // namespace tessera::detail
