// Matrices and projections of the public API. The results do not depend on the caller's floating-point mode.
#include <algorithm>
#include <cmath>
#include <string>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/record/checks.h"
#include "engine/record/matrix.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/worker_pool.h"
#include "engine/tessera/tessera.hpp"
#include "framebuffer/trigonometry.h"

namespace tessera {
using namespace detail;

namespace detail {

glm::dmat4 to_glm(const Matrix& matrix) {
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result[column][row] = matrix.m[static_cast<std::size_t>(4 * row + column)];
  return result;
}

Matrix from_glm(const glm::dmat4& matrix) {
  Matrix result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result.m[static_cast<std::size_t>(4 * row + column)] = matrix[column][row];
  return result;
}

}  // namespace detail

Matrix operator*(const Matrix& left, const Matrix& right) {
  const FloatingPointMode mode;
  return from_glm(to_glm(left) * to_glm(right));
}

Matrix translate(double x, double y, double z) { return {{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}}; }
Matrix scale(double x, double y, double z) { return {{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}}; }

namespace detail {

glm::dvec3 scaled_to_safe_range(const glm::dvec3& v) {
  const double largest = std::fmax(std::abs(v.x), std::fmax(std::abs(v.y), std::abs(v.z)));
  const bool has_direction = largest > 0 && std::isfinite(largest);
  const bool is_safe = largest > 1e-100 && largest < 1e100;
  if (!has_direction || is_safe) return v;
  const int exponent = std::ilogb(largest);
  return {std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent), std::scalbn(v.z, -exponent)};
}

}  // namespace detail

SinCos sin_cos_degrees(double degrees) {
  const SineCosine result = sine_cosine(degrees);
  return {result.sine, result.cosine};
}

// [GL 2.1, 2.11.2, Rotate]
Matrix rotate(double degrees, double x, double y, double z) {
  const FloatingPointMode mode;
  const glm::dvec3 axis = scaled_to_safe_range({x, y, z});
  x = axis.x;
  y = axis.y;
  z = axis.z;
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0) || !std::isfinite(length))
    throw Error(ErrorCode::invalid_argument,
                "rotate: the axis has no direction, it must be a finite vector other than 0 0 0");
  if (!std::isfinite(degrees)) throw Error(ErrorCode::invalid_argument, "rotate: the angle is not finite");
  x /= length;
  y /= length;
  z /= length;
  const auto [s, c] = sine_cosine(degrees);
  const double t = 1 - c;
  return {{x * x * t + c, x * y * t - z * s, x * z * t + y * s, 0,  //
           y * x * t + z * s, y * y * t + c, y * z * t - x * s, 0,  //
           x * z * t - y * s, y * z * t + x * s, z * z * t + c, 0,  //
           0, 0, 0, 1}};
}

Matrix look_at(Vec3 eye, Vec3 target, Vec3 up) {
  const FloatingPointMode mode;
  const glm::dvec3 e(eye.x, eye.y, eye.z);
  const glm::dvec3 t(target.x, target.y, target.z);
  const glm::dvec3 u = scaled_to_safe_range({up.x, up.y, up.z});
  const double span = glm::length(glm::cross(t - e, u));
  if (!(span > 0) || !std::isfinite(span))
    throw Error(
        ErrorCode::invalid_argument,
        "look_at: eye, target and up do not span a frame; eye and target must differ, and up must not lie "
        "along the view");
  const Matrix matrix = from_glm(glm::lookAtRH(e, t, u));
  if (!std::all_of(matrix.m.begin(), matrix.m.end(), [](double element) { return std::isfinite(element); }))
    throw Error(ErrorCode::invalid_argument,
                "look_at: eye and target are too far apart, or too near, for their distance to be a number");
  return matrix;
}

namespace {

void require_span(const char* function, const char* low_name, double low, const char* high_name,
                  double high) {
  if (!std::isfinite(low) || !std::isfinite(high) || low == high)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": " + low_name + " is " +
                                                 std::to_string(low) + " and " + high_name + " is " +
                                                 std::to_string(high) + ", they must be finite and differ");
}

void require_depths(const char* function, double near, double far, bool infinite_allowed) {
  const bool far_ok = std::isfinite(far) || (infinite_allowed && far > 0 && !std::isnan(far));
  if (!std::isfinite(near) || !far_ok || near == far)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": near is " + std::to_string(near) +
                                                 " and far is " + std::to_string(far) +
                                                 ", they must be finite and differ" +
                                                 (infinite_allowed ? " (far may be infinity)" : ""));
}

void require_positive_depths(const char* function, double near, double far) {
  if (!(near > 0) || !(far > 0))
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": near is " + std::to_string(near) +
                                                 " and far is " + std::to_string(far) +
                                                 ", both must be above 0");
}

// Finite arguments may yield a matrix that is not finite.
Matrix finite(const char* function, const Matrix& matrix) {
  for (const double element : matrix.m)
    if (!std::isfinite(element))
      throw Error(ErrorCode::invalid_argument,
                  std::string(function) +
                      ": the volume is too large or too thin, an element of its matrix is " +
                      std::to_string(element));
  return matrix;
}

}  // namespace

// [GL 2.1, 2.11.2, Frustum]. An infinite far plane is the limit of the formula. Reversed depth: z is w at
// near and 0 at far.
Matrix frustum(double left, double right, double bottom, double top, double near, double far, bool reversed) {
  const FloatingPointMode mode;
  require_span("frustum", "left", left, "right", right);
  require_span("frustum", "bottom", bottom, "top", top);
  require_depths("frustum", near, far, true);
  require_positive_depths("frustum", near, far);
  double a, b;  // clip z is a z + b
  if (std::isinf(far)) {
    a = reversed ? 0 : -1;
    b = reversed ? near : -2 * near;
  } else if (reversed) {
    a = near / (far - near);
    b = far * near / (far - near);
  } else {
    a = -(far + near) / (far - near);
    b = -2 * far * near / (far - near);
  }
  return finite("frustum", {{2 * near / (right - left), 0, (right + left) / (right - left), 0,  //
                             0, 2 * near / (top - bottom), (top + bottom) / (top - bottom), 0,  //
                             0, 0, a, b,                                                        //
                             0, 0, -1, 0}});
}

Matrix perspective(double fovy_degrees, double aspect, double near, double far, bool reversed) {
  const FloatingPointMode mode;
  if (!(fovy_degrees > 0 && fovy_degrees < 180))
    throw Error(ErrorCode::invalid_argument, "perspective: fovy is " + std::to_string(fovy_degrees) +
                                                 " degrees, it must be above 0 and below 180");
  if (!(aspect > 0) || !std::isfinite(aspect))
    throw Error(ErrorCode::invalid_argument,
                "perspective: aspect is " + std::to_string(aspect) + ", it must be finite and above 0");
  require_depths("perspective", near, far, true);
  require_positive_depths("perspective", near, far);
  const auto [s, c] = sine_cosine(fovy_degrees / 2);
  const double half_height = near * (s / c);
  const double half_width = half_height * aspect;
  return frustum(-half_width, half_width, -half_height, half_height, near, far, reversed);
}

Matrix orthographic(double left, double right, double bottom, double top, double near, double far,
                    bool reversed) {
  const FloatingPointMode mode;
  require_span("orthographic", "left", left, "right", right);
  require_span("orthographic", "bottom", bottom, "top", top);
  require_depths("orthographic", near, far, false);
  const double a = reversed ? 1 / (far - near) : -2 / (far - near);
  const double b = reversed ? far / (far - near) : -(far + near) / (far - near);
  return finite("orthographic", {{2 / (right - left), 0, 0, -(right + left) / (right - left),  //
                                  0, 2 / (top - bottom), 0, -(top + bottom) / (top - bottom),  //
                                  0, 0, a, b,                                                  //
                                  0, 0, 0, 1}});
}

// x/z in OpenCV's axes is x/w in clip space. Pixel coordinates start at the centre of the first pixel, window
// coordinates at its corner.
Camera calibrated_camera(const Intrinsics& i, const Matrix& camera_from_world, double near, double far,
                         CameraAxes axes, bool reversed) {
  const FloatingPointMode mode;
  require_enum({"calibrated_camera: axes"}, axes, CameraAxes::opengl);
  for (const double f : {i.fx, i.fy})
    if (!(f > 0) || !std::isfinite(f))
      throw Error(ErrorCode::invalid_argument, "calibrated_camera: a focal length is " + std::to_string(f) +
                                                   " pixels, must be finite and above 0");
  if (!std::isfinite(i.cx) || !std::isfinite(i.cy))
    throw Error(ErrorCode::invalid_argument, "calibrated_camera: the principal point is " +
                                                 std::to_string(i.cx) + ", " + std::to_string(i.cy) +
                                                 ", must be finite");
  if (i.width < 1 || i.height < 1)
    throw Error(ErrorCode::invalid_argument, "calibrated_camera: the picture's size is " +
                                                 std::to_string(i.width) + "x" + std::to_string(i.height) +
                                                 ", must be at least 1x1");
  require_finite({"calibrated_camera: camera_from_world"}, camera_from_world);
  Camera camera{.view = camera_from_world,
                .projection = frustum(-1, 1, -1, 1, near, far, reversed),
                .reversed = reversed};
  auto& m = camera.projection.m;
  m[0] = 2 * i.fx / i.width;
  m[2] = 1 - (2 * i.cx + 1) / i.width;
  m[5] = 2 * i.fy / i.height;
  m[6] = (2 * i.cy + 1) / i.height - 1;
  finite("calibrated_camera", camera.projection);
  if (axes == CameraAxes::opencv) camera.view = scale(1, -1, -1) * camera.view;
  return camera;
}

}  // namespace tessera
