#include "fragment_ops.h"

#include <algorithm>

namespace tessera::reference {
namespace {

std::uint32_t largest(int bits) { return (std::uint32_t{1} << bits) - 1; }

std::uint32_t applied(StencilOp op, std::uint32_t ref, std::uint32_t stored, int bits) {
  const std::uint32_t most = largest(bits);
  switch (op) {
    case StencilOp::kKeep: return stored;
    case StencilOp::kZero: return 0;
    case StencilOp::kReplace: return ref;
    case StencilOp::kIncr: return stored == most ? most : stored + 1;
    case StencilOp::kDecr: return stored == 0 ? 0 : stored - 1;
    case StencilOp::kInvert: return ~stored & most;
    case StencilOp::kIncrWrap: return (stored + 1) & most;
    case StencilOp::kDecrWrap: return (stored - 1) & most;
  }
  return stored;
}

Vec4 times(Vec4 a, Vec4 b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }
Vec4 all(double a) { return {a, a, a, a}; }

Vec4 factor(BlendFactor name, Vec4 source, Vec4 destination, Vec4 constant) {
  const Vec4 one = all(1);
  switch (name) {
    case BlendFactor::kZero: return all(0);
    case BlendFactor::kOne: return one;
    case BlendFactor::kSrcColor: return source;
    case BlendFactor::kOneMinusSrcColor: return one - source;
    case BlendFactor::kDstColor: return destination;
    case BlendFactor::kOneMinusDstColor: return one - destination;
    case BlendFactor::kSrcAlpha: return all(source.w);
    case BlendFactor::kOneMinusSrcAlpha: return all(1 - source.w);
    case BlendFactor::kDstAlpha: return all(destination.w);
    case BlendFactor::kOneMinusDstAlpha: return all(1 - destination.w);
    case BlendFactor::kConstantColor: return constant;
    case BlendFactor::kOneMinusConstantColor: return one - constant;
    case BlendFactor::kConstantAlpha: return all(constant.w);
    case BlendFactor::kOneMinusConstantAlpha: return all(1 - constant.w);
    case BlendFactor::kSrcAlphaSaturate: {
      const double f = std::min(source.w, 1 - destination.w);
      return {f, f, f, 1};
    }
  }
  return one;
}

Vec4 with_alpha(Vec4 color, double alpha) { return {color.x, color.y, color.z, alpha}; }

// M_1 = [0], M_2n = [[4 M_n, 4 M_n + 2], [4 M_n + 3, 4 M_n + 1]].
int bayer(int n, int row, int column) {
  if (n == 1) return 0;
  constexpr int kQuadrant[2][2] = {{0, 2}, {3, 1}};
  const int half = n / 2;
  return 4 * bayer(half, row % half, column % half) + kQuadrant[row / half][column / half];
}

int bayer_size(Dither dither) {
  switch (dither) {
    case Dither::kBayer2: return 2;
    case Dither::kBayer4: return 4;
    case Dither::kBayer8: return 8;
    default: return 1;
  }
}

}  // namespace

bool passes_stencil(const StencilFace& face, std::uint32_t stored, int bits) {
  const std::uint32_t ref = std::min(face.ref, largest(bits));
  return passes(face.func, ref & face.mask, stored & face.mask);
}

std::uint32_t stencil_after(StencilOp op, const StencilFace& face, std::uint32_t stored, int bits) {
  const std::uint32_t ref = std::min(face.ref, largest(bits));
  return (stored & ~face.write_mask) | (applied(op, ref, stored, bits) & face.write_mask);
}

Vec4 blended(const Blend& blend, Vec4 source, Vec4 destination) {
  if (blend.equation == BlendEquation::kMin || blend.equation == BlendEquation::kMax) {
    const auto pick = [&](double s, double d) {
      return blend.equation == BlendEquation::kMin ? std::min(s, d) : std::max(s, d);
    };
    return {pick(source.x, destination.x), pick(source.y, destination.y), pick(source.z, destination.z),
            pick(source.w, destination.w)};
  }
  const auto of = [&](BlendFactor name) { return factor(name, source, destination, blend.color); };
  const Vec4 s = times(source, with_alpha(of(blend.src), of(blend.src_alpha).w));
  const Vec4 d = times(destination, with_alpha(of(blend.dst), of(blend.dst_alpha).w));
  switch (blend.equation) {
    case BlendEquation::kSubtract: return s - d;
    case BlendEquation::kReverseSubtract: return d - s;
    default: return s + d;
  }
}

std::uint32_t combined(LogicOp op, std::uint32_t s, std::uint32_t d) {
  switch (op) {
    case LogicOp::kClear: return 0;
    case LogicOp::kAnd: return s & d;
    case LogicOp::kAndReverse: return s & ~d;
    case LogicOp::kCopy: return s;
    case LogicOp::kAndInverted: return ~s & d;
    case LogicOp::kNoop: return d;
    case LogicOp::kXor: return s ^ d;
    case LogicOp::kOr: return s | d;
    case LogicOp::kNor: return ~(s | d);
    case LogicOp::kEquiv: return ~(s ^ d);
    case LogicOp::kInvert: return ~d;
    case LogicOp::kOrReverse: return s | ~d;
    case LogicOp::kCopyInverted: return ~s;
    case LogicOp::kOrInverted: return ~s | d;
    case LogicOp::kNand: return ~(s & d);
    case LogicOp::kSet: return ~std::uint32_t{0};
  }
  return s;
}

double dither_threshold(Dither dither, int x, int y) {
  const int n = bayer_size(dither);
  return (bayer(n, y % n, x % n) + 0.5) / (n * n);
}

}  // namespace tessera::reference
