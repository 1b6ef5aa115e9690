// Scan-out: packed pixels -> display pixels of 4 bytes in the caller's memory; alpha is 255 or as stored.
// Twin: scan_out_reference.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/palette.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

/// Conversion of packed pixels to display pixels. A component is `(packed >> shift & mask) * scale`, rounded
/// from 16 fraction bits, at `byte_shift` of the display pixel. An index is looked up in `pixels`.
struct ScanOutRule {
  struct Component {
    int shift = 0;            ///< lowest bit of the component in the packed pixel
    std::uint32_t mask = 0;   ///< 2^bits - 1
    std::uint32_t scale = 0;  ///< 255 / mask in 16.16 fixed point, rounded
    int byte_shift = 0;       ///< lowest bit of its byte in the display pixel: 0, 8 or 16
  };
  bool index = false;
  std::array<Component, 3> components;  ///< red, green, blue
  std::uint32_t index_mask = 0;
  std::uint32_t last_index = 0;  ///< last index of `pixels`
  int alpha_shift = -1;          ///< left shift of stored alpha to the highest byte; -1: no alpha planes
  const std::uint32_t* pixels = nullptr;  ///< display pixel per index; larger indices use the last one
};

using ScanOutTileFn = void(const ScanOutRule& rule, const std::uint32_t* tile, int tile_size, int width_px,
                           int height_px, std::uint8_t* first_row, std::ptrdiff_t stride_bytes) noexcept;
using ScanOutRowFn = void(const ScanOutRule& rule, const std::uint32_t* packed_pixels, int width_px,
                          std::uint8_t* row) noexcept;

/// Converter of one frame; const use is thread-safe.
class ScanOut {
 public:
  /// Throws std::bad_alloc only.
  /// @param palette  palette of layout.bits bits for index layouts, copied; ignored (may be null) for others
  ScanOut(const ColorLayout& layout, const Palette* palette, PixelOrder order, InstructionSet isa);
  /// Prepares for another frame and reuses the memory. Throws std::bad_alloc only; the object must then be
  /// set again before use.
  void set(const ColorLayout& layout, const Palette* palette, PixelOrder order);
  ScanOut(ScanOut&&) noexcept = default;
  ScanOut& operator=(ScanOut&&) noexcept = default;

  /// Converts the top left width_px x height_px pixels of a tile.
  /// - Writes these pixels only, top row first. Bits beyond the layout are ignored.
  /// - Bit-identical to scan_out_pixel_reference() on every instruction set. Never fails, never allocates.
  ///
  /// @param packed_tile          tile memory, kTileAlignment aligned
  /// @param width_px, height_px  part of the tile inside the picture: 0 .. tile_size
  /// @param first_row            top row of the destination, any alignment
  /// @param stride_bytes         row stride of the destination; may be negative
  void tile(const std::uint32_t* packed_tile, int tile_size, int width_px, int height_px,
            std::uint8_t* first_row, std::ptrdiff_t stride_bytes) const noexcept {
    tile_fn_(rule_, packed_tile, tile_size, width_px, height_px, first_row, stride_bytes);
  }
  /// Converts one row of packed pixels, left to right.
  void row(const std::uint32_t* packed_pixels, int width_px, std::uint8_t* row_bytes) const noexcept {
    row_fn_(rule_, packed_pixels, width_px, row_bytes);
  }

 private:
  ScanOutRule rule_;
  std::vector<std::uint32_t> pixels_;
  ScanOutTileFn* tile_fn_;
  ScanOutRowFn* row_fn_;
};

}  // namespace tessera::detail
