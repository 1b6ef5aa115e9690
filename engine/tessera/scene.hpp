// Materials, lights and cameras.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "types.hpp"

namespace tessera {

/// Reflection of a surface. Defaults are OpenGL's.
struct Material {
  Color ambient{0.2f, 0.2f, 0.2f, 1};
  Color diffuse{0.8f, 0.8f, 0.8f, 1};  ///< its alpha is the alpha of lit fragments
  Color specular{0, 0, 0, 1};
  Color emission{0, 0, 0, 1};
  float shininess = 0;  ///< exponent of the highlight, 0 to 16384
  /// Colour-index buffers: ambient, diffuse and specular index (a, d, s). Lit draws then store
  ///   min(a + D (1 - S) (d - a) + S (s - a), s)
  /// where D and S are the luminances of the diffuse light and the highlights.
  /// Absent: colours are mapped to the nearest palette entries.
  std::optional<std::array<float, 3>> index_ramp{};
};
/// A material of the customary lighting tables: "emerald", "polished_gold", ... Empty for an unknown name.
TESSERA_API std::optional<Material> named_material(std::string_view name);
TESSERA_API std::vector<std::string_view> material_names();

/// A light source. Defaults are OpenGL's, except that every light starts white.
struct Light {
  Color ambient{0, 0, 0, 1};
  Color diffuse{1, 1, 1, 1};
  Color specular{1, 1, 1, 1};
  std::array<float, 4> position{0, 0, 1, 0};      ///< world space; w = 0: direction towards the light
  std::array<float, 3> spot_direction{0, 0, -1};  ///< world space, from the light; any length
  float spot_exponent = 0;  ///< intensity in the cone is cos(angle to the axis)^exponent; 0 to 16384
  float spot_cutoff = 180;  ///< half angle of the cone, degrees: 0 to 90, or 180 for no cone
  // Intensity at distance r is divided by constant + linear r + quadratic r^2. Directional lights ignore it.
  float attenuation_constant = 1;
  float attenuation_linear = 0;
  float attenuation_quadratic = 0;
};

/// Shape of highlights: Blinn (N.H)^shininess, or Phong (R.E)^shininess.
enum class SpecularModel : std::uint8_t { blinn, phong };

struct LightModel {
  Color ambient{0.2f, 0.2f, 0.2f, 1};  ///< ambient light of the scene
  bool local_viewer = false;           ///< highlights: viewer at the eye; false: at infinity, along +z
  bool two_sided = false;              ///< back faces are lit with reversed normals and their own material
  SpecularModel specular = SpecularModel::blinn;
};

/// Transforms from world space to clip space.
struct Camera {
  Matrix view{};        ///< world to eye space, in which lighting happens
  Matrix projection{};  ///< eye to clip space
  /// False: clip z is -w near to w far. True: clip z is w near to 0 far, and window depth is z / w. Clears
  /// and tests are not adapted: reversed depth needs a clear to 0 and Compare::greater.
  bool reversed = false;
};

// Projections. `far` may be infinity in perspective() and frustum().
// They throw Error for an empty volume, or if an element of the matrix would not be finite.

TESSERA_API Matrix perspective(double fovy_degrees, double aspect, double near, double far,
                               bool reversed = false);
TESSERA_API Matrix frustum(double left, double right, double bottom, double top, double near, double far,
                           bool reversed = false);
TESSERA_API Matrix orthographic(double left, double right, double bottom, double top, double near, double far,
                                bool reversed = false);

/// World to world: projects objects between a light and the plane a x + b y + c z + d = 0 onto that plane.
/// @throws Error  if the plane has no normal, or the light lies in the plane or shines along it
TESSERA_API Matrix planar_shadow(const std::array<double, 4>& plane, const Light& light);

/// Axes of camera space. opencv: x right, y down, z forwards. opengl: x right, y up, z backwards.
enum class CameraAxes : std::uint8_t { opencv, opengl };

/// Pinhole camera without distortion. A point (x, y, z) in OpenCV's axes projects to the pixel coordinates
/// (fx x/z + cx, fy y/z + cy), where (0, 0) is the centre of the top left pixel.
struct Intrinsics {
  double fx = 0, fy = 0;      ///< focal lengths, pixels, above 0
  double cx = 0, cy = 0;      ///< principal point, pixels
  int width = 0, height = 0;  ///< size of the calibrated picture, pixels
};
/// The camera of a calibrated picture. Frame buffers of another size stretch the picture.
/// @param camera_from_world  extrinsic matrix, world to camera space in the given axes
/// @param near, far          as for perspective(), in the units of the world
/// @throws Error  for focal lengths, sizes or volumes out of range, or a matrix that is not finite
TESSERA_API Camera calibrated_camera(const Intrinsics& intrinsics, const Matrix& camera_from_world,
                                     double near, double far, CameraAxes axes = CameraAxes::opencv,
                                     bool reversed = false);

}  // namespace tessera
