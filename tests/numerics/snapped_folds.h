// Whether snapping folds a mesh: vertices move by up to half of 1/256 pixel, which turns over triangles that are thinner than that. Those overlap their
// neighbours once they are snapped, whoever draws them; all others cover each pixel once.
#pragma once

#include "tests/numerics/counted_mesh.h"
#include "tests/numerics/exact_region.h"

namespace tessera::test {

/// Clips and snaps the triangles in long double and by rules of its own. True if one is turned over, or its edges cross.
bool snapping_folds(const CountedMesh& mesh, const SquareView& view, bool reversed = false);

}  // namespace tessera::test
