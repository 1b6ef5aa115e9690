// Prefetch of memory that will be written.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::detail {

/// Prefetches for writing the cache lines of `rows` rows of `bytes` bytes each. Rows of a tile are too short
/// for the hardware prefetcher and need not be line-aligned; without this, stores miss the cache line by
/// line.
void prefetch_lines(const std::uint8_t* first_row, std::ptrdiff_t stride_bytes, int bytes, int rows) noexcept;

}  // namespace tessera::detail
