// Version, errors, and the small value types of the public API.
#pragma once

#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "Tessera needs C++20: -std=c++20"
#endif

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "export.h"
#include "version.h"

namespace tessera {

// Implementation details, not part of the API.
namespace detail {
struct FrameBufferState;
struct FrameRecording;
struct RendererState;
struct TextureState;
class WorkerPool;
}  // namespace detail

/// Version of the library that runs, "0.1.0". TESSERA_VERSION is the version of the headers.
TESSERA_API std::string_view version();

/// Kinds of errors. Values are stable; new enumerators are appended.
enum class ErrorCode : std::uint8_t {
  invalid_argument,     ///< a value is out of range, or values do not fit together
  incompatible_format,  ///< the frame buffer lacks a buffer or mode that the call needs
  invalid_state,        ///< a moved-from object, a buffer that was not kept, a call at the wrong time
  unsupported,          ///< this build or machine cannot do it
  out_of_memory,        ///< an allocation failed
  cancelled,            ///< a progress callback stopped the frame
  executor_failure,     ///< an Executor broke its contract
  internal              ///< a defect of the library
};

/// The one exception type of the library.
/// - what() names the function, the value found and the values expected.
/// - std::bad_alloc becomes an Error with out_of_memory, except in material_names(),
///   available_instruction_sets() and serial_executor(), which may throw std::bad_alloc.
class TESSERA_API Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : Error(ErrorCode::invalid_argument, message) {}
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};
/// Thrown by Renderer::finish if its progress callback returned false.
class TESSERA_API Cancelled : public Error {
 public:
  explicit Cancelled(const std::string& message) : Error(ErrorCode::cancelled, message) {}
};

/// A point or direction. Geometry is double, because transforms are computed in double.
struct Vec3 {
  double x = 0, y = 0, z = 0;
};

/// Red, green, blue, alpha; 1 is full intensity.
/// - Any finite values, unless a range is given where the colour is used.
/// - No transfer curve: 0.5 is stored as 128 of 255.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;
};

/// A rectangle of pixels in window coordinates: x, y is the lower left corner.
struct Rect {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< pixels, 0 or more
};

/// A 4 x 4 matrix for column vectors, stored in rows: element (row, column) is m[4 * row + column].
/// - Default: the identity.
/// - Functions that take a matrix throw Error if an element is not finite.
struct Matrix {
  std::array<double, 16> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// Sine and cosine of one angle.
struct SinCos {
  double sine, cosine;
};
/// Sine and cosine of an angle in degrees.
/// - Error below 1e-15; multiples of 90 degrees are exact.
/// - Bit-identical on every machine.
/// @pre degrees is finite
TESSERA_API SinCos sin_cos_degrees(double degrees);

TESSERA_API Matrix operator*(const Matrix& left, const Matrix& right);
TESSERA_API Matrix translate(double x, double y, double z);
TESSERA_API Matrix scale(double x, double y, double z);
/// Rotation about the axis x, y, z, counter-clockwise for a viewer that the axis points at.
/// @throws Error  if the axis has length 0, or a value is not finite
TESSERA_API Matrix rotate(double degrees, double x, double y, double z);
/// World to eye. The camera is at `eye` and faces `target`; `up` appears upwards.
/// @throws Error  if eye equals target, or up is parallel to the view direction
TESSERA_API Matrix look_at(Vec3 eye, Vec3 target, Vec3 up);

}  // namespace tessera
