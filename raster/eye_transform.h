// Eye-space positions and normals of vertices, for lighting.
#pragma once

#include <cstddef>
#include <limits>

#include "framebuffer/instruction_set.h"
#include "raster/vertex_transform.h"

namespace tessera::detail {

/// Allowed lengths of eye-space normals. Shorter and longer normals are scaled to the nearer limit; zero
/// normals stay.
struct NormalLengths {
  double shortest = 1, longest = 1;
};
inline constexpr NormalLengths kUnitNormals{1, 1};
inline constexpr NormalLengths kUnscaledNormals{0, std::numeric_limits<double>::infinity()};
/// For normals that are interpolated and then normalized: their squares, and the squares of what remains
/// after cancellation to the last bit, are normal floats.
inline constexpr NormalLengths kNormalizableNormals{0x1p-32, 0x1p32};

/// Transform of positions and normals to eye space. Matrices are row-major.
struct EyeTransform {
  double eye_from_object[16] = {};  ///< points: x y z [w] -> (x, y, z) / w
  /// Upper 3x3 of the inverse transpose, times a power of two if the lengths of normals do not matter.
  double normal_matrix[9] = {};
  NormalLengths normal_lengths{};
};
/// Eye-space positions of up to kVertexBatch vertices, as three arrays. Divides by w; by 1 if w is 0.
/// Positions are interpolated like attributes, which is exact if w is the same at all vertices of a triangle.
using EyePositions = void(const EyeTransform& transform, StridedFloats positions, int components,
                          std::size_t count, float* x, float* y, float* z);
/// Eye-space normals of up to kVertexBatch vertices, as three arrays.
using EyeNormals = void(const EyeTransform& transform, StridedFloats normals, std::size_t count, float* x,
                        float* y, float* z);
EyePositions* eye_positions(InstructionSet isa);
EyeNormals* eye_normals(InstructionSet isa);

}  // namespace tessera::detail
