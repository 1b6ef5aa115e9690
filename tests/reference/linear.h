// Small double-precision vectors and matrices of the reference renderer. Column vectors; matrices hold rows
// as on paper, so `multiply(a, b)` is the product a b and the rightmost factor is applied first.
#pragma once

#include <array>
#include <cmath>

namespace tessera::reference {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

struct Vec4 {
  double x = 0, y = 0, z = 0, w = 0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::hypot(a.x, a.y, a.z); }

/// The unit vector along `a`; the null vector for the null vector.
inline Vec3 normalize(Vec3 a) {
  const double l = length(a);
  return l > 0 ? Vec3{a.x / l, a.y / l, a.z / l} : Vec3{};
}

inline Vec4 operator+(Vec4 a, Vec4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
inline Vec4 operator-(Vec4 a, Vec4 b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
inline Vec4 operator*(double s, Vec4 a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
inline Vec3 xyz(Vec4 a) { return {a.x, a.y, a.z}; }

/// The components of `a` that the mask selects, and the others of `b`.
inline Vec4 masked(Vec4 a, Vec4 b, const std::array<bool, 4>& mask) {
  return {mask[0] ? a.x : b.x, mask[1] ? a.y : b.y, mask[2] ? a.z : b.z, mask[3] ? a.w : b.w};
}

/// rows[r][c] is the element in row r and column c as on paper: a translation is in rows[0..2][3].
struct Mat4 {
  std::array<std::array<double, 4>, 4> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
};

inline Mat4 multiply(const Mat4& a, const Mat4& b) {
  Mat4 product;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      product.rows[r][c] = 0;
      for (int k = 0; k < 4; ++k) product.rows[r][c] += a.rows[r][k] * b.rows[k][c];
    }
  return product;
}

inline Vec4 transform(const Mat4& m, Vec4 v) {
  const auto row = [&](int r) {
    return m.rows[r][0] * v.x + m.rows[r][1] * v.y + m.rows[r][2] * v.z + m.rows[r][3] * v.w;
  };
  return {row(0), row(1), row(2), row(3)};
}

/// The upper left 3x3 part applied to a direction.
inline Vec3 transform_direction(const Mat4& m, Vec3 v) { return xyz(transform(m, {v.x, v.y, v.z, 0})); }

}  // namespace tessera::reference
