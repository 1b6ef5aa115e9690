// Detects meshes that fold when snapped: vertices move by up to half of 1/256 pixel, which flips thinner
// triangles. Flipped triangles overlap their neighbours in any renderer; all other meshes cover each pixel
// once.
#pragma once

#include "tests/numerics/counted_mesh.h"
#include "tests/numerics/exact_region.h"

namespace tessera::test {

/// Clips and snaps the triangles in exact fractions, independently of the engine. Returns true if a triangle
/// is flipped or its edges cross.
///
/// @param transform maps the mesh's positions to clip space
bool snapping_folds(const CountedMesh& mesh, const SquareViewport& view, bool reversed = false,
                    const Matrix& transform = {});

}  // namespace tessera::test
