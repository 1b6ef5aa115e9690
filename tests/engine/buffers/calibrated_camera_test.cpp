// Calibrated cameras, as in computer vision: points are drawn at the pixel of the pinhole formula, with their
// view depth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/engine/frame/api_support.h"

namespace tessera::calibrated_camera_test {
namespace {

using namespace test;

constexpr Intrinsics kIntrinsics{
    .fx = 310.5, .fy = 290.25, .cx = 170.3, .cy = 101.8, .width = 320, .height = 240};
const FrameBufferFormat kFormat{.width = 320, .height = 240, .depth = DepthFormat::unorm32};

// Matrix times point, by the textbook formula.
std::array<double, 3> in_camera(const Matrix& m, const std::array<double, 3>& p) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row)
    out[row] = m.m[4 * row] * p[0] + m.m[4 * row + 1] * p[1] + m.m[4 * row + 2] * p[2] + m.m[4 * row + 3];
  return out;
}

class CalibratedCamera : public testing::TestWithParam<std::tuple<CameraAxes, bool>> {};

TEST_P(CalibratedCamera, DrawsPointsAtTheirPixelAndDepth) {
  const auto [axes, reversed] = GetParam();
  const Matrix extrinsics = translate(0.1, -0.2, axes == CameraAxes::opencv ? 3 : -3) * rotate(25, 1, 2, -1);
  const Camera camera = calibrated_camera(kIntrinsics, extrinsics, 0.5, 9, axes, reversed);
  Random random(8);
  Renderer renderer({.threads = 1});
  int checked = 0;
  for (int round = 0; round < 300; ++round) {
    const std::array<double, 3> p{random.between(-1.5f, 1.5f), random.between(-1, 1),
                                  random.between(-1.5f, 1.5f)};
    std::array<double, 3> c = in_camera(extrinsics, p);
    if (axes == CameraAxes::opengl) {
      c[1] = -c[1];
      c[2] = -c[2];
    }
    const double u = kIntrinsics.fx * c[0] / c[2] + kIntrinsics.cx;
    const double v = kIntrinsics.fy * c[1] / c[2] + kIntrinsics.cy;
    const double column = std::floor(u + 0.5), row = std::floor(v + 0.5);
    const bool near_border = std::max(std::abs(u - column), std::abs(v - row)) > 0.45;
    if (near_border || column < 0 || column >= 320 || row < 0 || row >= 240) continue;
    // A triangle much smaller than a pixel, moved to the pixel's centre so that it covers that pixel alone.
    const double z = c[2];
    std::array<double, 3> center{(column - kIntrinsics.cx) / kIntrinsics.fx * z,
                                 (row - kIntrinsics.cy) / kIntrinsics.fy * z, z};
    if (axes == CameraAxes::opengl) {
      center[1] = -center[1];
      center[2] = -center[2];
    }
    // Back to world space: the extrinsic matrix is rigid.
    MeshData mesh;
    const double size = 0.2 * z / kIntrinsics.fx;  // a fifth of a pixel
    const double offsets[3][2] = {{-size, -size}, {2 * size, -size}, {-size, 2 * size}};
    for (const auto& offset : offsets) {
      const double camera_point[3] = {center[0] + offset[0], center[1] + offset[1], center[2]};
      for (std::size_t k = 0; k < 3; ++k) {
        double world = 0;
        for (std::size_t r = 0; r < 3; ++r)
          world += extrinsics.m[4 * r + k] * (camera_point[r] - extrinsics.m[4 * r + 3]);
        mesh.positions.push_back(static_cast<float>(world));
      }
    }
    FrameBuffer buffer(kFormat);
    Frame frame(buffer);
    frame.set_camera(camera);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = reversed ? 0.0 : 1.0});
    DrawState state = unlit({1, 1, 1, 1});
    state.depth.test = reversed ? Compare::greater : Compare::less;
    frame.draw(mesh.view(), state);
    renderer.finish(frame);
    std::vector<float> depth(pixel_count(buffer));
    buffer.read_view_depth(depth, camera, -1);
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const bool expected = i == static_cast<std::size_t>(row) * 320 + static_cast<std::size_t>(column);
      ASSERT_EQ(words[i] != 0, expected)
          << i % 320 << ' ' << i / 320 << ", expected " << column << ' ' << row;
      if (expected) ASSERT_NEAR(depth[i], z, 1e-5);
      else ASSERT_EQ(depth[i], -1.0f);
    }
    ++checked;
  }
  EXPECT_GT(checked, 60);
}

INSTANTIATE_TEST_SUITE_P(Axes, CalibratedCamera,
                         testing::Combine(testing::Values(CameraAxes::opencv, CameraAxes::opengl),
                                          testing::Bool()));

TEST(CalibratedCameraErrors, NameTheFieldOutOfRange) {
  const auto message = [](Intrinsics i, double near, double far) {
    return error_of([&] { calibrated_camera(i, {}, near, far); }).value_or("");
  };
  Intrinsics i = kIntrinsics;
  i.fx = 0;
  EXPECT_THAT(message(i, 1, 2), testing::HasSubstr("focal length is 0"));
  i = kIntrinsics;
  i.cy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(i, 1, 2), testing::HasSubstr("principal point"));
  i = kIntrinsics;
  i.height = 0;
  EXPECT_THAT(message(i, 1, 2), testing::HasSubstr("320x0"));
  EXPECT_THAT(message(kIntrinsics, 2, 2), testing::HasSubstr("near is 2"));
}

}  // namespace
}  // namespace tessera::calibrated_camera_test
