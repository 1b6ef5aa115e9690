// Vertex transform: object space -> clip space -> raster space in batches.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"

namespace tessera::detail {

inline constexpr int kVertexBatch = 64;  ///< vertices transformed at a time

/// Bits of a vertex outcode. A triangle whose vertices share a plane's bit is outside; one with any bit set
/// is clipped; one with kNonFinite is dropped.
enum Outcode : std::uint8_t {
  kLeftOfGuardBand = 1,
  kRightOfGuardBand = 2,
  kBelowGuardBand = 4,
  kAboveGuardBand = 8,
  kBeforeNear = 16,
  kBehindFar = 32,
  kNonPositiveW = 64,
  kNonFinite = 128
};

/// An array of per-vertex float records. The stride counts floats.
struct StridedFloats {
  const float* data = nullptr;
  std::size_t stride = 0;

  const float* at(std::size_t vertex) const { return data + vertex * stride; }
  StridedFloats from(std::size_t vertex) const { return {at(vertex), stride}; }
  explicit operator bool() const { return data != nullptr; }
};

struct ClipPosition {
  double x = 0, y = 0, z = 0, w = 1;
};

/// Positions of a batch in object, clip or eye space.
struct PositionBatch {
  alignas(64) double x[kVertexBatch], y[kVertexBatch], z[kVertexBatch], w[kVertexBatch];
};

inline bool is_finite(const ClipPosition& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

/// Transform of a draw's vertices from object to raster space. In double: the depth of a vertex then resolves
/// the smallest difference of every format, and matrices may scale by 10^6 and back.
struct VertexTransform {
  double clip_from_object[16] = {};        ///< row-major
  double half_width = 0, half_height = 0;  ///< half the viewport's size, pixels
  double guard_x = 0, guard_y = 0;  ///< guard band in units of w: kGuardBandPixels / half_width, half_height
  std::int32_t center_x = 0, center_y = 0;  ///< centre of the viewport in raster space, 1/256 pixel
  bool reversed = false;                    ///< clip z ranges from 0 (far) to w (near), else from -w to w
  double depth_near = 0, depth_far = 1;     ///< depth range
  DepthFormat depth = DepthFormat::none;
  // Error bounds relative to term_magnitude(): of the distances from the near and far planes and from the
  // guard planes, and of w (see set_error_bounds()). Negative: the distance has no rounding error.
  double near_error = 0, far_error = 0;
  double guard_x_error = 0, guard_y_error = 0;
  double w_error = 0;
  double max_row_norm_xyz = 0;     ///< largest 1-norm of a matrix row's x, y and z elements
  double max_abs_translation = 0;  ///< largest magnitude of a matrix row's w element

  /// Computes the error bounds from the matrix and the guard band.
  void set_error_bounds();
  /// Upper bound of the sum of the magnitudes of a clip coordinate's terms.
  double term_magnitude(double x, double y, double z, double w) const {
    return std::fma(max_row_norm_xyz, std::max(std::max(std::abs(x), std::abs(y)), std::abs(z)),
                    max_abs_translation * std::abs(w));
  }
};

/// A vertex in clip space.
///
/// Each coordinate has four roundings relative to terms that may be far larger than their sum. If the error
/// might change the side of a plane, or is too large relative to w for the window position, `needs_exact` is
/// set: coordinates are then exact sums rounded once, and the outcode is that of the exact coordinates.
/// Exception: exact coordinates or terms outside the range of normal doubles; then the vertex keeps the
/// ordinary roundings.
struct TransformedVertex {
  ClipPosition position;
  std::uint8_t outcode = 0;
  bool needs_exact = false;
};
TransformedVertex transform_vertex(const VertexTransform& transform, const std::array<float, 4>& object);

/// Clip position with the ordinary four roundings per coordinate.
ClipPosition clip_position(const VertexTransform& transform, double x, double y, double z, double w);
std::uint8_t compute_outcode(const VertexTransform& transform, const ClipPosition& position);
/// Projects and snaps one vertex: the scalar twin of the kernel, also used for vertices made by clipping.
/// Positions beyond the guard band are clamped to its border. @pre position.w > 0, all coordinates are finite
WindowVertex project(const VertexTransform& transform, const ClipPosition& position);

/// Transforms `count` vertices, at most kVertexBatch. Returns the bitwise or of all outcodes.
/// - `positions` holds x y z or x y z w; `components` is 3 or 4.
/// - Vertices with an outcode are placed at the viewport's centre.
using TransformVertices = std::uint8_t(const VertexTransform& transform, StridedFloats positions,
                                       int components, std::size_t count, WindowVertex* vertices,
                                       std::uint8_t* outcodes);
TransformVertices* transform_vertices(InstructionSet isa);

/// Clip-space positions of up to kVertexBatch vertices: those of transform_vertex().
using ClipPositions = void(const VertexTransform& transform, StridedFloats positions, int components,
                           std::size_t count, PositionBatch& clip);
ClipPositions* clip_positions(InstructionSet isa);
/// The second half of TransformVertices, for given clip-space positions, which count as exact. Twins:
/// compute_outcode() and project().
using PlaceVertices = std::uint8_t(const VertexTransform& transform, const PositionBatch& clip,
                                   std::size_t count, WindowVertex* vertices, std::uint8_t* outcodes);
PlaceVertices* place_vertices(InstructionSet isa);

}  // namespace tessera::detail
