// Matrices and projections, compared with the same formulas in long double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/engine/frame/api_support.h"

namespace tessera::api_matrix_test {
namespace {

using namespace test;
using Real = long double;
using Exact = std::array<Real, 16>;  // row by row

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Real kPi = 3.14159265358979323846264338327950288L;

// Differences relative to the largest element: a few roundings of a double.
void expect_close(const Matrix& matrix, const Exact& exact, Real tolerance = 1e-15L) {
  Real largest = 0;
  for (const Real v : exact) largest = std::max(largest, std::abs(v));
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_LE(std::abs(matrix.m[i] - exact[i]), tolerance * largest)
        << "row " << i / 4 << ", column " << i % 4;
}

struct Point {
  Real x;
  Real y;
  Real z;
  Real w;
};
Point apply(const Matrix& m, Real x, Real y, Real z, Real w = 1) {
  const auto row = [&](std::size_t r) {
    return m.m[4 * r] * x + m.m[4 * r + 1] * y + m.m[4 * r + 2] * z + m.m[4 * r + 3] * w;
  };
  return {row(0), row(1), row(2), row(3)};
}
Real depth_at(const Matrix& projection, Real distance) {
  const Point p = apply(projection, 0, 0, -distance);
  return p.z / p.w;
}

TEST(ApiMatrices, RotateMatchesTheFormula) {
  const double axes[][3] = {{1, 0, 0},    {0, 1, 0},  {0, 0, 1},          {1, 1, 1},
                            {-2, 0.5, 3}, {0, 0, -7}, {1e-3, 2e-3, -1e-3}};
  for (const auto& axis : axes)
    for (const double degrees :
         {0.0, 1.0, 30.0, 45.0, 90.0, 120.0, 180.0, -77.5, 359.0, 360.0, 725.0, 1e-7, 123456.789}) {
      SCOPED_TRACE(testing::Message() << degrees << " about " << axis[0] << ' ' << axis[1] << ' ' << axis[2]);
      const Real length =
          std::sqrt(Real{axis[0]} * axis[0] + Real{axis[1]} * axis[1] + Real{axis[2]} * axis[2]);
      const Real x = axis[0] / length;
      const Real y = axis[1] / length;
      const Real z = axis[2] / length;
      const Real angle = std::fmod(Real{degrees}, 360.0L) * kPi / 180;
      const Real s = std::sin(angle);
      const Real c = std::cos(angle);
      const Real t = 1 - c;
      expect_close(rotate(degrees, axis[0], axis[1], axis[2]),
                   {x * x * t + c, x * y * t - z * s, x * z * t + y * s, 0,  //
                    y * x * t + z * s, y * y * t + c, y * z * t - x * s, 0,  //
                    z * x * t - y * s, z * y * t + x * s, z * z * t + c, 0,  //
                    0, 0, 0, 1});
    }
}

TEST(ApiMatrices, QuarterTurnsAreExact) {
  EXPECT_EQ(rotate(90, 0, 0, 1).m, (std::array<double, 16>{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(rotate(-90, 1, 0, 0).m,
            (std::array<double, 16>{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(rotate(360, 1, 2, 3).m, Matrix{}.m);
}

TEST(ApiMatrices, StoreRowsAndApplyFromTheRight) {
  EXPECT_EQ(translate(1, 2, 3).m, (std::array<double, 16>{1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1}));
  EXPECT_EQ(scale(2, 3, 4).m, (std::array<double, 16>{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1}));
  EXPECT_EQ((translate(1, 2, 3) * scale(2, 3, 4)).m,
            (std::array<double, 16>{2, 0, 0, 1, 0, 3, 0, 2, 0, 0, 4, 3, 0, 0, 0, 1}));
  EXPECT_EQ((scale(2, 3, 4) * translate(1, 2, 3)).m,
            (std::array<double, 16>{2, 0, 0, 2, 0, 3, 0, 6, 0, 0, 4, 12, 0, 0, 0, 1}));
  Random random(6);
  Matrix a, b;
  for (std::size_t i = 0; i < 16; ++i) a.m[i] = random.between(-5, 5), b.m[i] = random.between(-5, 5);
  Exact product{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) product[4 * i + j] += Real{a.m[4 * i + k]} * b.m[4 * k + j];
  expect_close(a * b, product);
}

TEST(ApiMatrices, LookAtMapsTheEyeToTheOriginAndTheTargetToTheAxis) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const auto any = [&] {
      return Vec3{random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)};
    };
    const Vec3 eye = any();
    const Vec3 target = any();
    const Vec3 up = any();
    using V = std::array<Real, 3>;
    const auto cross = [](const V& a, const V& b) {
      return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto unit = [&](const V& a) {
      const Real length = std::sqrt(dot(a, a));
      return V{a[0] / length, a[1] / length, a[2] / length};
    };
    const V e{eye.x, eye.y, eye.z};
    const V forward = unit({target.x - e[0], target.y - e[1], target.z - e[2]});
    const V side = unit(cross(forward, {up.x, up.y, up.z}));
    const V top = cross(side, forward);
    const Matrix view = look_at(eye, target, up);
    expect_close(view,
                 {side[0], side[1], side[2], -dot(side, e), top[0], top[1], top[2], -dot(top, e), -forward[0],
                  -forward[1], -forward[2], dot(forward, e), 0, 0, 0, 1},
                 1e-14L);
    const Point p = apply(view, target.x, target.y, target.z);
    EXPECT_LT(p.z, 0);
    EXPECT_NEAR(static_cast<double>(std::abs(p.x) + std::abs(p.y)), 0, 1e-13);
  }
}

TEST(ApiMatrices, FrustumMatchesTheFormula) {
  for (const double far : {2.0, 100.0, 1e9}) {
    const Real l = -0.3;
    const Real r = 0.7;
    const Real b = -0.2;
    const Real t = 0.9;
    const Real n = 0.5;
    const Real f = far;
    expect_close(frustum(-0.3, 0.7, -0.2, 0.9, 0.5, far),
                 {2 * n / (r - l), 0, (r + l) / (r - l), 0,  //
                  0, 2 * n / (t - b), (t + b) / (t - b), 0,  //
                  0, 0, -(f + n) / (f - n), -2 * f * n / (f - n), 0, 0, -1, 0});
    expect_close(frustum(-0.3, 0.7, -0.2, 0.9, 0.5, far, true),
                 {2 * n / (r - l), 0, (r + l) / (r - l), 0,  //
                  0, 2 * n / (t - b), (t + b) / (t - b), 0,  //
                  0, 0, n / (f - n), f * n / (f - n), 0, 0, -1, 0});
  }
}

TEST(ApiMatrices, PerspectiveIsASymmetricFrustum) {
  for (const double fovy : {1e-3, 10.0, 45.0, 60.0, 90.0, 150.0, 179.9})
    for (const double aspect : {0.1, 1.0, 16.0 / 9})
      for (const bool reversed : {false, true}) {
        SCOPED_TRACE(fovy);
        const Real n = 0.25;
        const Real f = 80;
        const Real cotangent = 1 / std::tan(Real{fovy} * kPi / 360);
        const Real z = reversed ? n / (f - n) : -(f + n) / (f - n);
        const Real w = reversed ? f * n / (f - n) : -2 * f * n / (f - n);
        expect_close(perspective(fovy, aspect, 0.25, 80, reversed),
                     {cotangent / aspect, 0, 0, 0, 0, cotangent, 0, 0, 0, 0, z, w, 0, 0, -1, 0});
      }
}

TEST(ApiMatrices, InfiniteFarPlaneIsTheLimit) {
  for (const bool reversed : {false, true}) {
    const Matrix limit = perspective(50, 1.5, 0.5, kInfinity, reversed);
    const Matrix near_limit = perspective(50, 1.5, 0.5, 1e15, reversed);
    Exact exact;
    std::copy(near_limit.m.begin(), near_limit.m.end(), exact.begin());
    expect_close(limit, exact, 2e-15L);
    EXPECT_NEAR(static_cast<double>(depth_at(limit, 0.5)), reversed ? 1 : -1, 1e-15);
    EXPECT_NEAR(static_cast<double>(depth_at(limit, 1e30)), reversed ? 0 : 1, 1e-15);
  }
}

TEST(ApiMatrices, ReversedProjectionsRunFromOneToZero) {
  for (const Matrix& m : {perspective(40, 1, 0.5, 20, true), frustum(-1, 2, -1, 1, 0.5, 20, true),
                          orthographic(-1, 2, -1, 1, 0.5, 20, true)}) {
    EXPECT_NEAR(static_cast<double>(depth_at(m, 0.5)), 1, 1e-14);
    EXPECT_NEAR(static_cast<double>(depth_at(m, 20)), 0, 1e-14);
  }
  for (const Matrix& m :
       {perspective(40, 1, 0.5, 20), frustum(-1, 2, -1, 1, 0.5, 20), orthographic(-1, 2, -1, 1, 0.5, 20)}) {
    EXPECT_NEAR(static_cast<double>(depth_at(m, 0.5)), -1, 1e-14);
    EXPECT_NEAR(static_cast<double>(depth_at(m, 20)), 1, 1e-14);
  }
}

TEST(ApiMatrices, OrthographicMatchesTheFormula) {
  // A flipped volume and a near plane behind the eye are allowed.
  const Real l = -3;
  const Real r = 5;
  const Real b = 2;
  const Real t = -7;
  const Real n = -10;
  const Real f = 30;
  expect_close(orthographic(-3, 5, 2, -7, -10, 30),
               {2 / (r - l), 0, 0, -(r + l) / (r - l), 0, 2 / (t - b), 0, -(t + b) / (t - b), 0, 0,
                -2 / (f - n), -(f + n) / (f - n), 0, 0, 0, 1});
  expect_close(orthographic(-3, 5, 2, -7, -10, 30, true),
               {2 / (r - l), 0, 0, -(r + l) / (r - l), 0, 2 / (t - b), 0, -(t + b) / (t - b), 0, 0,
                1 / (f - n), f / (f - n), 0, 0, 0, 1});
}

TEST(ApiMatrices, ExtremeAxisAndUpLengthsStillHaveADirection) {
  for (const double length : {1e-200, 1e200}) {
    EXPECT_EQ(rotate(30, 0, 0, length).m, rotate(30, 0, 0, 1).m);
    EXPECT_EQ(look_at({0, 0, 5}, {0, 0, 0}, {0, length, 0}).m, look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).m);
  }
}

// Depth of a plane in front of a camera, through a whole frame.
TEST(Cameras, MapDistanceToDepth) {
  const MeshData mesh = rectangle(-900, -900, 900, 900);
  for (const bool reversed : {false, true})
    for (const double far : {50.0, kInfinity})
      for (const double distance : {1.5, 4.0, 20.0, 49.0}) {
        FrameBuffer buffer({.width = 8, .height = 8, .depth = DepthFormat::float32});
        Frame frame(buffer);
        Camera camera;
        camera.view = look_at({0, 0, distance}, {0, 0, 0}, {0, 1, 0});
        camera.projection = perspective(45, 1, 1, far, reversed);
        camera.reversed = reversed;
        frame.set_camera(camera);
        frame.clear({.depth = reversed ? 0.0 : 1.0});
        DrawState state = unlit({1, 1, 1, 1});
        state.depth.test = reversed ? Compare::greater : Compare::less;
        frame.draw(mesh.view(), state);
        Renderer({.threads = 1}).finish(frame);
        std::vector<float> depth(64);
        buffer.read_depth(depth);
        const double near_part =
            std::isinf(far) ? 1 / distance : (far / distance - 1) / (far - 1);  // 1 at near, 0 at far
        EXPECT_NEAR(depth[27], reversed ? near_part : 1 - near_part, 1e-6) << distance << " of " << far;
      }
}

}  // namespace
}  // namespace tessera::api_matrix_test
