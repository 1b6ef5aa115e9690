// FLIP, written directly from its formulas: two-dimensional filters, standard functions, one pixel at a time.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/engine/program/compare/known_flip_pairs.h"

namespace tessera::program {

/// The error of each pixel.
std::vector<double> flip_oracle(const RgbPicture& picture, const RgbPicture& reference,
                                double pixels_per_degree);

}  // namespace tessera::program
