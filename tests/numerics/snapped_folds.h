// Whether snapping folds a mesh: vertices move by up to half of 1/256 pixel, which turns over triangles that
// are thinner than that. Those overlap their neighbours once they are snapped, whoever draws them; all others
// cover each pixel once.
#pragma once

#include "tests/numerics/counted_mesh.h"
#include "tests/numerics/exact_region.h"

namespace tessera::test {

/// Clips and snaps the triangles in fractions of whole numbers of any size, and by rules of its own. True if
/// one is turned over, or its edges cross.
///
/// @param transform  carries the mesh's positions to clip space
bool snapping_folds(const CountedMesh& mesh, const SquareViewport& view, bool reversed = false,
                    const Matrix& transform = {});

}  // namespace tessera::test
