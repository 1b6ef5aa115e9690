// Light of blocks of rows -> rows of the image's columns.
#pragma once

#include <cstddef>

#include "framebuffer/display/resample_table.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Resamples kBlockRows rows and transposes them.
/// @param light   [sample][row], kBlockRows floats per sample
/// @param rows    the first `row_count` rows are written: row r begins at rows + r * row_stride and has one
///                float per pixel of the table
using ResampleRowsFn = void(const float* light, const ResampleTable& table, int row_count, float* rows,
                            std::ptrdiff_t row_stride);
ResampleRowsFn* resample_rows_for(InstructionSet isa);

}  // namespace tessera::detail
