// Object space -> clip space -> raster space, for batches of vertices; and what the lighting of a vertex
// needs in eye space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"

namespace tessera::detail {

inline constexpr int kVertexBatch = 64;  ///< vertices transformed at a time

/// Why a vertex cannot be used as it is. A triangle whose vertices share one of the planes' bits is outside;
/// one with any bit set is clipped; kNonFinite drops it.
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

/// Floats of each vertex; the stride counts floats.
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

/// What carries a draw's vertices into raster space. All of it in double: the depth of a vertex then has the
/// smallest difference of every format, and matrices may scale by 10^6 and back.
struct VertexTransform {
  double clip_from_object[16] = {};         ///< in rows
  double half_width = 0, half_height = 0;   ///< of the viewport, pixels
  double guard_x = 0, guard_y = 0;          ///< the guard band in units of w: kGuardBandPixels / half_width
  std::int32_t center_x = 0, center_y = 0;  ///< the viewport's centre in raster space, 1/256 pixel
  bool reversed = false;                    ///< z runs 0..w, else -w..w
  double depth_near = 0, depth_far = 1;
  DepthFormat depth = DepthFormat::none;
  /// Distances from the near and far planes, from the guard band's, and w, that roundings may have made, of a
  /// vertex whose terms have a size of 1. Negative: they make none.
  double near_error = 0, far_error = 0, guard_x_error = 0, guard_y_error = 0, w_error = 0;
  /// Of the matrix's rows the largest: the sizes of x's, y's and z's elements together, and that of w's.
  double max_row_norm_xyz = 0, max_abs_translation = 0;

  /// Once the matrix and the guard band are there.
  void set_error_bounds();
  /// No sum of sizes that a coordinate of a vertex comes from is larger.
  double term_magnitude(double x, double y, double z, double w) const {
    return std::fma(max_row_norm_xyz, std::max(std::max(std::abs(x), std::abs(y)), std::abs(z)),
                    max_abs_translation * std::abs(w));
  }
};

/// A vertex in clip space. Each coordinate is rounded four times, beside sums of sizes that may be far larger
/// than itself; where that might be on the wrong side of a plane, or w too small beside them for the place in
/// the window, `needs_exact`: then coordinates are rounded once, and the outcode is that of the exact ones;
/// but not where those leave the range of doubles with all their digits, or their terms do.
struct TransformedVertex {
  ClipPosition position;
  std::uint8_t outcode = 0;
  bool needs_exact = false;
};
TransformedVertex transform_vertex(const VertexTransform& transform, const std::array<float, 4>& object);

/// The four roundings.
ClipPosition clip_position(const VertexTransform& transform, double x, double y, double z, double w);
std::uint8_t compute_outcode(const VertexTransform& transform, const ClipPosition& position);
/// The scalar twin of the kernel, and the way for single vertices that clipping makes; what lies beyond the
/// guard band is put onto its border.
/// @pre position.w > 0, all are finite
WindowVertex project(const VertexTransform& transform, const ClipPosition& position);

/// Transforms `count` vertices, at most kVertexBatch. `positions` holds x y z or x y z w; `components` is 3
/// or 4. Vertices with a outcode are left at the viewport's centre. Returns all outcodes or-ed together.
using TransformVertices = std::uint8_t(const VertexTransform& transform, StridedFloats positions,
                                       int components, std::size_t count, WindowVertex* vertices,
                                       std::uint8_t* outcodes);
TransformVertices* transform_vertices(InstructionSet isa);

/// Which lengths normals may have in eye space; those that are shorter or longer become as long as this, but
/// normals of 0 stay.
struct NormalLengths {
  double shortest = 1, longest = 1;
};
inline constexpr NormalLengths kUnitNormals{1, 1};
inline constexpr NormalLengths kUnscaledNormals{0, std::numeric_limits<double>::infinity()};
/// Of normals that will be interpolated and then normalized: the squares of these, and of what cancelling to
/// the last bit leaves of them, are normal floats.
inline constexpr NormalLengths kNormalizableNormals{0x1p-32, 0x1p32};

/// Carries vectors into eye space: 4 rows of 4 for points (x y z [w] -> x y z, each over w) and 3 rows of 3
/// for normals.
struct EyeTransform {
  double eye_from_object[16] = {};
  double normal_matrix[9] =
      {};  ///< the inverse transpose's 3x3, times a power of two where the lengths of normals do not matter
  NormalLengths normal_lengths{};
};
/// Eye-space positions of up to kVertexBatch vertices, as three arrays; where w is 0, which has no place,
/// by 1. Between vertices they are interpolated as attributes are: exact where w is the same at all of them.
using EyePositions = void(const EyeTransform& transform, StridedFloats positions, int components,
                          std::size_t count, float* x, float* y, float* z);
/// Eye-space normals.
using EyeNormals = void(const EyeTransform& transform, StridedFloats normals, std::size_t count, float* x,
                        float* y, float* z);
EyePositions* eye_positions(InstructionSet isa);
EyeNormals* eye_normals(InstructionSet isa);

}  // namespace tessera::detail
