// Memory that is about to be written is fetched in time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::detail {

/// Fetches the lines of memory that rows of bytes will be written to. Rows of a tile are too short for the
/// hardware to foresee the next one, and need not begin where a line does: without this the stores wait for
/// one line after the other.
void prefetch_lines(const std::uint8_t* first_row, std::ptrdiff_t stride_bytes, int bytes, int rows) noexcept;

}  // namespace tessera::detail
