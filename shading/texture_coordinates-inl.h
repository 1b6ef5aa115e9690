// Texture coordinates of a triangle's pixels, and footprints in texels per pixel, from exact derivatives.
//
// Weights w_k are linear in the window. With W = w_0 + w_1 + w_2, N = w_1 (s_1 - s_0) + w_2 (s_2 - s_0):
//   s     = s_0 + N / W
//   ds/dx = (dN/dx - (s - s_0) dW/dx) / W
// Along a line the derivative is (x, y) times the slope along its length, with x^2 + y^2 = 1 [GL 2.1,
// equation 3.15]. Points have none.
#if defined(TESSERA_SHADING_TEXTURE_COORDINATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TEXTURE_COORDINATES_INL_H_
#undef TESSERA_SHADING_TEXTURE_COORDINATES_INL_H_
#else
#define TESSERA_SHADING_TEXTURE_COORDINATES_INL_H_
#endif

#include "shading/interpolate-inl.h"
#include "shading/lighting.h"
#include "shading/texture.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// One coordinate and its slopes, in texels of level 0.
struct TextureAxis {
  Interpolant interpolant;
  float dx, dy;          // dN/dx, dN/dy
  float sum_dx, sum_dy;  // dW/dx, dW/dy

  HWY_INLINE void set_up(const ShadedTriangle& t, int attribute, bool clamps_to_range, float texels,
                         const float (&weight_dx)[3], const float (&weight_dy)[3]) {
    interpolant = make_interpolant(t, attribute, clamps_to_range);
    dx = texels * std::fma(weight_dx[1], interpolant.to_second, weight_dx[2] * interpolant.to_third);
    dy = texels * std::fma(weight_dy[1], interpolant.to_second, weight_dy[2] * interpolant.to_third);
    sum_dx = t.affine ? 0.0f : texels * (weight_dx[0] + weight_dx[1] + weight_dx[2]);
    sum_dy = t.affine ? 0.0f : texels * (weight_dy[0] + weight_dy[1] + weight_dy[2]);
  }
};

/// Texture coordinates of one triangle, point or line.
struct TextureCoordinates {
  const ShadedTriangle* triangle = nullptr;
  TextureAxis s, t;
  bool has_slopes = false;
  bool is_line = false;

  HWY_NOINLINE void set_up(const ShadedTriangle& of, const Edges64* edges64, const DrawTexture& texture,
                           bool of_line, int samples) {
    triangle = &of;
    // Rounding to slightly beyond the vertices could change the nearest texel, and with several samples
    // pixels' centres may lie far outside the triangle.
    const bool is_linear = texture.levels->mag_linear && texture.levels->min_linear;
    const bool clamps_to_range = !of_line && (samples > 1 || !is_linear);
    is_line = of_line;
    float weight_dx[3], weight_dy[3];
    const bool is_narrow = of.edges64_index < 0;
    for (int k = 0; k < 3; ++k) {
      const float edge_dx =
          is_narrow ? static_cast<float>(of.edges.a[k]) : static_cast<float>(edges64[of.edges64_index].a[k]);
      const float edge_dy =
          is_narrow ? static_cast<float>(of.edges.b[k]) : static_cast<float>(edges64[of.edges64_index].b[k]);
      weight_dx[k] = of.scale[k] * edge_dx;
      weight_dy[k] = of.scale[k] * edge_dy;
    }
    const TextureLevel& level = texture.levels->level[0];
    const auto width = static_cast<float>(level.width);
    // In a single row t does not matter.
    const float height = level.height > 1 ? static_cast<float>(level.height) : 0.0f;
    s.set_up(of, texture.attribute, clamps_to_range, width, weight_dx, weight_dy);
    t.set_up(of, texture.attribute + 1, clamps_to_range, height, weight_dx, weight_dy);
    has_slopes = texture.levels->needs_footprint();
  }

  /// Calls store(field, value) for the coordinates and, if needed, the squared footprint.
  template <class Store>
  HWY_INLINE void at(const Barycentric& where, const Store& store) const {
    if (has_slopes) at<true, true>(where, store);
    else at<false, true>(where, store);
  }
  /// @param kClampsToRange  may be false only if set_up() has set no range
  template <bool kHasSlopes, bool kClampsToRange, class Store>
  HWY_INLINE void at(const Barycentric& where, const Store& store) const {
    const auto coordinate = [&](const TextureAxis& axis) HWY_ATTR {
      return kClampsToRange ? interpolate_clamped(where, axis.interpolant)
                            : interpolate(where, axis.interpolant);
    };
    const Float at_s = coordinate(s), at_t = coordinate(t);
    store(kTextureS, at_s);
    store(kTextureT, at_t);
    if constexpr (!kHasSlopes) return;
    const Float from_s = hn::Sub(at_s, splat(s.interpolant.first));
    const Float from_t = hn::Sub(at_t, splat(t.interpolant.first));
    // Squared length of a pixel's step in texels, times W^2.
    const auto squared_step = [&](float ds, float sum_ds, float dt, float sum_dt) HWY_ATTR {
      const Float along_s = neg_mul_add(from_s, splat(sum_ds), splat(ds));
      const Float along_t = neg_mul_add(from_t, splat(sum_dt), splat(dt));
      return mul_add(along_s, along_s, hn::Mul(along_t, along_t));
    };
    const Float x = squared_step(s.dx, s.sum_dx, t.dx, t.sum_dx);
    const Float y = squared_step(s.dy, s.sum_dy, t.dy, t.sum_dy);
    const Float footprint = is_line ? hn::Add(x, y) : greater_of(y, x);
    store(kFootprintSquared, hn::Mul(hn::Mul(footprint, where.inverse), where.inverse));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
