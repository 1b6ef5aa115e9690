// Perspective-correct barycentric coordinates of a triangle's pixels, from exact edge functions. Twin:
// interpolate_reference.h.
#if defined(TESSERA_SHADING_INTERPOLATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_INTERPOLATE_INL_H_
#undef TESSERA_SHADING_INTERPOLATE_INL_H_
#else
#define TESSERA_SHADING_INTERPOLATE_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "raster/clip.h"
#include "raster/lanes-inl.h"
#include "shading/interpolate.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Coordinates of vertices 1 and 2; that of vertex 0 is 1 - b1 - b2. An attribute is a0 + b1 (a1 - a0) +
/// b2 (a2 - a0), which keeps a constant attribute exact.
struct Barycentric {
  Float b1, b2;
  Float inverse;  // 1 / sum of the weights
};

HWY_INLINE Barycentric from_weights(Float w0, Float w1, Float w2, bool affine) {
  if (affine) return {w1, w2, splat(1.0f)};
  const Float inverse = hn::Div(splat(1.0f), hn::Add(hn::Add(w0, w1), w2));
  return {hn::Mul(w1, inverse), hn::Mul(w2, inverse), inverse};
}

/// Constants of the weights of a narrow triangle's vertices, broadcast to all lanes.
struct WeightLanes {
  Float scale[3], shift[3];
  bool affine;

  HWY_INLINE void set_up(const ShadedTriangle& t) {
    affine = t.affine;
    for (int k = 0; k < 3; ++k) set(k, t.scale[k], t.shift[k]);
  }
  /// @pre set_up_weights() has run for the group
  HWY_INLINE void set_up(const TriangleGroup& g, int i) {
    affine = g.affine[i] != 0;
    for (int k = 0; k < 3; ++k) set(k, g.scale[k][i], g.shift[k][i]);
  }
  /// @param e0, e1, e2  edges at the pixels
  HWY_INLINE Barycentric at(Int e0, Int e1, Int e2) const {
    const auto weight = [&](int k, Int e)
                            HWY_ATTR { return mul_add(hn::ConvertTo(kFloat, e), scale[k], shift[k]); };
    const Float w1 = weight(1, e1), w2 = weight(2, e2);
    return from_weights(affine ? w1 : weight(0, e0), w1, w2, affine);
  }

 private:
  HWY_INLINE void set(int k, float scale_k, float shift_k) {
    scale[k] = splat(scale_k);
    shift[k] = splat(shift_k);
  }
};
HWY_INLINE Barycentric barycentric_from_edges(const ShadedTriangle& t, Int e0, Int e1, Int e2) {
  WeightLanes weights;
  weights.set_up(t);
  return weights.at(e0, e1, e2);
}

/// Exact edges of a narrow triangle at the pixels of a block. A chunk is whole rows, or one pixel.
struct BlockEdges32 {
  const ShadedTriangle& triangle;
  Int first[3];  // at the first chunk

  HWY_INLINE BlockEdges32(const ShadedTriangle& t, int bx, int by) : triangle(t) {
    const Int x = hn::Add(splat(bx), block_columns(0)), y = hn::Add(splat(by), block_rows(0));
    for (int k = 0; k < 3; ++k)
      first[k] = hn::Add(splat(t.edges.e[k]),
                         hn::Add(hn::Mul(splat(t.edges.a[k]), x), hn::Mul(splat(t.edges.b[k]), y)));
  }
  HWY_INLINE Int at(int k, int chunk) const {
    return hn::Add(first[k], splat(triangle.edges.a[k] * kBlockColumn[chunk * kLanes] +
                                   triangle.edges.b[k] * kBlockRow[chunk * kLanes]));
  }
  HWY_INLINE Barycentric barycentric(int chunk) const {
    return barycentric_from_edges(triangle, at(0, chunk), at(1, chunk), at(2, chunk));
  }
};

inline HWY_NOINLINE Barycentric barycentric_edges64(const ShadedTriangle& t, const Edges64& edges64, int bx,
                                                    int by, int chunk) {
  alignas(64) float w[3][kLanes];
  for (int k = 0; k < 3; ++k) {
    const double start = edges64.e[k] + edges64.a[k] * bx + edges64.b[k] * by;  // all exact
    for (int l = 0; l < kLanes; ++l) {
      const int p = chunk * kLanes + l;
      w[k][l] = static_cast<float>(start + edges64.a[k] * kBlockColumn[p] + edges64.b[k] * kBlockRow[p]) *
                t.scale[k];
    }
  }
  const Barycentric found =
      from_weights(hn::Load(kFloat, w[0]), hn::Load(kFloat, w[1]), hn::Load(kFloat, w[2]), t.affine);
  // Beyond a line's end the sum of the weights may be 0. The value of the first vertex is used there, which
  // keeps constants.
  const auto is_finite = hn::And(hn::IsFinite(found.b1), hn::IsFinite(found.b2));
  return {hn::IfThenElseZero(is_finite, found.b1), hn::IfThenElseZero(is_finite, found.b2),
          hn::IfThenElseZero(is_finite, found.inverse)};
}

HWY_INLINE Barycentric barycentric(const ShadedTriangle& t, const Edges64* edges64, int bx, int by,
                                   int chunk) {
  return HWY_LIKELY(t.edges64_index < 0) ? BlockEdges32(t, bx, by).barycentric(chunk)
                                         : barycentric_edges64(t, edges64[t.edges64_index], bx, by, chunk);
}

/// One attribute at the three vertices, and its range.
struct Interpolant {
  float first, to_second, to_third;
  float low = -std::numeric_limits<float>::infinity(), high = std::numeric_limits<float>::infinity();
};
/// @param clamps_to_range  sets the range to that of the vertices
HWY_INLINE Interpolant make_interpolant(const ShadedTriangle& t, int attribute,
                                        bool clamps_to_range = false) {
  const float a = t.attributes[0][attribute], b = t.attributes[1][attribute], c = t.attributes[2][attribute];
  Interpolant interpolant{a, b - a, c - a};
  if (!clamps_to_range) return interpolant;
  interpolant.low = std::min(std::min(a, b), c);
  interpolant.high = std::max(std::max(a, b), c);
  return interpolant;
}
HWY_INLINE Float interpolate(const Barycentric& b, const Interpolant& c) {
  return mul_add(b.b1, splat(c.to_second), mul_add(b.b2, splat(c.to_third), splat(c.first)));
}
/// Interpolant broadcast to all lanes, for triangles of many pixels.
struct InterpolantLanes {
  Float first, to_second, to_third;
  HWY_INLINE void set(const Interpolant& c) {
    first = splat(c.first);
    to_second = splat(c.to_second);
    to_third = splat(c.to_third);
  }
};
/// InterpolantLanes and the interpolant's range.
struct ClampedInterpolantLanes {
  InterpolantLanes interpolant;
  Float low, high;
  HWY_INLINE void set(const Interpolant& c) {
    interpolant.set(c);
    low = splat(c.low);
    high = splat(c.high);
  }
};
HWY_INLINE Float interpolate(const Barycentric& b, const InterpolantLanes& c) {
  return mul_add(b.b1, c.to_second, mul_add(b.b2, c.to_third, c.first));
}
/// interpolate(), clamped to the range: sums may round to slightly beyond it, and with several samples a
/// pixel's centre may lie outside the triangle.
HWY_INLINE Float interpolate_clamped(const Barycentric& b, const ClampedInterpolantLanes& c) {
  return lesser_of(greater_of(interpolate(b, c.interpolant), c.low), c.high);
}
HWY_INLINE Float interpolate_clamped(const Barycentric& b, const Interpolant& c) {
  ClampedInterpolantLanes lanes;
  lanes.set(c);
  return interpolate_clamped(b, lanes);
}

/// Stores kCapacity attributes from `attribute` on. Attributes that the surface does not have are undefined.
HWY_INLINE void store_interpolants(const ShadedTriangle& t, int attribute,
                                   TriangleInterpolants& interpolants) {
  static_assert(TriangleInterpolants::kCapacity <= kAttributePadding);
  constexpr hn::CappedTag<float, TriangleInterpolants::kCapacity> some;
  for (int j = 0; j < TriangleInterpolants::kCapacity; j += static_cast<int>(hn::MaxLanes(some))) {
    const auto a0 = hn::LoadU(some, t.attributes[0] + attribute + j);
    hn::Store(a0, some, interpolants.first + j);
    hn::Store(hn::Sub(hn::LoadU(some, t.attributes[1] + attribute + j), a0), some,
              interpolants.to_second + j);
    hn::Store(hn::Sub(hn::LoadU(some, t.attributes[2] + attribute + j), a0), some, interpolants.to_third + j);
  }
}
HWY_INLINE Float interpolate(const Barycentric& b, const TriangleInterpolants& c, int j) {
  return interpolate(b, Interpolant{c.first[j], c.to_second[j], c.to_third[j]});
}

/// `count` attributes from `attribute` on, loaded in whole vectors: later elements are undefined.
struct InterpolantArrays {
  alignas(64) float first[kAttributePadding], to_second[kAttributePadding], to_third[kAttributePadding];
  HWY_INLINE InterpolantArrays(const ShadedTriangle& t, int attribute, int count) {
    for (int j = 0; j < count; j += kLanes) {
      const Float a0 = hn::LoadU(kFloat, t.attributes[0] + attribute + j);
      hn::Store(a0, kFloat, first + j);
      hn::Store(hn::Sub(hn::LoadU(kFloat, t.attributes[1] + attribute + j), a0), kFloat, to_second + j);
      hn::Store(hn::Sub(hn::LoadU(kFloat, t.attributes[2] + attribute + j), a0), kFloat, to_third + j);
    }
  }
  HWY_INLINE Interpolant operator[](int j) const { return {first[j], to_second[j], to_third[j]}; }
};
HWY_INLINE Float interpolate(const Barycentric& b, const InterpolantArrays& c, int j) {
  return interpolate(b, c[j]);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
