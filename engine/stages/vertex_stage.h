// Vertex stages of the user: their inputs and results, block by block.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/stages/scratch.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/tessera/stages.hpp"
#include "raster/vertex_transform.h"

namespace tessera::detail {

struct GeometryDraw;

/// Results of a vertex stage, per vertex: those that it writes.
struct StagedVertices {
  Scratch<ClipPosition> clip;
  Scratch<float> eye;        ///< x y z
  Scratch<float> normals;    ///< x y z, eye space
  Scratch<float> colors;     ///< r g b a
  Scratch<float> texcoords;  ///< s t
  Scratch<float> extras;     ///< VertexStage::extras floats

  /// Allocates the arrays. Throws std::bad_alloc.
  void resize(const VertexStage& stage, std::size_t vertices);
};

/// Runs the stage of a draw on vertices [first, first + count), at most kVertexBatch, and stores its results.
/// Vertices whose clip position the stage writes are placed in the window; others have been placed before.
/// Distinct ranges may run concurrently. Throws what the stage throws.
/// @param normals  the draw's normals in object space; may be null
/// @return  bitwise or of the outcodes that it changed
std::uint8_t run_vertex_stage(const GeometryDraw& draw, StridedFloats normals, std::size_t first,
                              std::size_t count, InstructionSet isa);

}  // namespace tessera::detail
