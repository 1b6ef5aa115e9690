// Writes the pixels of a frame buffer into the memory of a display mode, byte for byte as an adapter had
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "framebuffer/tessera/memory_layout.hpp"

namespace tessera::detail {

/// Size and arrangement of a picture in display memory.
struct MemoryShape {
  MemoryLayout layout = MemoryLayout::packed;
  ByteOrder byte_order = ByteOrder::little;  ///< `bytes` only
  int width = 0, height = 0;                 ///< pixels
  int bits = 1;                              ///< per pixel, 1 .. 24
};

/// Size of the memory in bytes, gaps included; 0 for character cells.
std::size_t memory_image_bytes(const MemoryShape& shape) noexcept;

/// Writes all bytes of `memory`.
/// - `words` holds width * height stored colours, rows from the top; bits beyond shape.bits (alpha) are
///   ignored.
/// @pre memory.size() is memory_image_bytes(shape); the layout is not character_cells and suits the bits
void write_memory_image(const MemoryShape& shape, std::span<const std::uint32_t> words,
                        std::span<std::uint8_t> memory) noexcept;

}  // namespace tessera::detail
