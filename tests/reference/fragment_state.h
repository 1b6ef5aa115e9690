// Per-fragment state of a draw, in the order of the operations; see the specification, section 2.
#pragma once

#include <array>
#include <cstdint>

#include "linear.h"

namespace tessera::reference {

/// "incoming compare stored"; for stencils "reference compare stored".
enum class Compare { kNever, kLess, kEqual, kLequal, kGreater, kNotequal, kGequal, kAlways };

struct AlphaTest {
  Compare func = Compare::kGreater;
  double ref = 0.5;  ///< 0..1
};

enum class StencilOp { kKeep, kZero, kReplace, kIncr, kDecr, kInvert, kIncrWrap, kDecrWrap };

struct StencilFace {
  Compare func = Compare::kAlways;
  std::uint32_t ref = 0;  ///< as written; clamped to the buffer's largest value when used, as in OpenGL
  std::uint32_t mask = 255;
  StencilOp fail = StencilOp::kKeep;
  StencilOp zfail = StencilOp::kKeep;
  StencilOp zpass = StencilOp::kKeep;
  std::uint32_t write_mask = 255;
};

struct StencilState {
  StencilFace front;
  StencilFace back;  ///< defaults to `front`
};

struct DepthState {
  Compare test = Compare::kLess;
  bool write = true;
};

/// Added to the depths of a polygon: slope * factor + smallest difference of the format * units.
struct PolygonOffset {
  double factor = 0;
  double units = 0;
};

enum class BlendFactor {
  kZero,
  kOne,
  kSrcColor,
  kOneMinusSrcColor,
  kDstColor,
  kOneMinusDstColor,
  kSrcAlpha,
  kOneMinusSrcAlpha,
  kDstAlpha,
  kOneMinusDstAlpha,
  kConstantColor,
  kOneMinusConstantColor,
  kConstantAlpha,
  kOneMinusConstantAlpha,
  kSrcAlphaSaturate
};

enum class BlendEquation { kAdd, kSubtract, kReverseSubtract, kMin, kMax };

struct Blend {
  BlendFactor src = BlendFactor::kSrcAlpha;
  BlendFactor dst = BlendFactor::kOneMinusSrcAlpha;
  BlendFactor src_alpha = BlendFactor::kSrcAlpha;  ///< defaults to `src`
  BlendFactor dst_alpha = BlendFactor::kOneMinusSrcAlpha;
  BlendEquation equation = BlendEquation::kAdd;  ///< for colour and alpha
  Vec4 color{0, 0, 0, 0};                        ///< blend constant, 0..1
};

enum class Dither { kNone, kBayer2, kBayer4, kBayer8 };

enum class LogicOp {
  kClear,
  kAnd,
  kAndReverse,
  kCopy,
  kAndInverted,
  kNoop,
  kXor,
  kOr,
  kNor,
  kEquiv,
  kInvert,
  kOrReverse,
  kCopyInverted,
  kOrInverted,
  kNand,
  kSet
};

}  // namespace tessera::reference
