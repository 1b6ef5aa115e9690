// Scan-out: packed pixels -> what a display shows, straight into the caller's memory; 4 bytes a pixel, alpha
// 255 or as stored. Twin: scan_out_reference.h.
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

/// How packed pixels become display pixels. A component is `(word >> shift & mask) * scale`, rounded from 16
/// fraction bits, and goes to `byte_shift` of the pixel; an index is looked up.
struct ScanOutRule {
  struct Component {
    int shift = 0;            ///< of its lowest bit in the word
    std::uint32_t mask = 0;   ///< 2^bits - 1
    std::uint32_t scale = 0;  ///< 255 / mask in 16.16 fixed point, rounded
    int byte_shift = 0;       ///< of its byte in the pixel: 0, 8 or 16
  };
  bool index = false;
  std::array<Component, 3> components;  ///< red, green, blue
  std::uint32_t index_mask = 0;
  std::uint32_t last_index = 0;  ///< of `pixels`
  int alpha_shift = -1;          ///< from the stored alpha to the pixel's highest byte; -1: none is stored
  const std::uint32_t* pixels = nullptr;  ///< pixel of each index; the last one stands for all beyond it
};

using ScanOutTileFn = void(const ScanOutRule& rule, const std::uint32_t* tile, int tile_size, int width_px,
                           int height_px, std::uint8_t* first_row, std::ptrdiff_t stride_bytes) noexcept;
using ScanOutRowFn = void(const ScanOutRule& rule, const std::uint32_t* packed_pixels, int width_px,
                          std::uint8_t* row) noexcept;

/// Set once a frame; const use is thread-safe.
class ScanOut {
 public:
  /// @param palette  for index layouts, with layout.bits bits; copied. Ignored (may be null) for the others.
  /// Throws std::bad_alloc only.
  ScanOut(const ColorLayout& layout, const Palette* palette, PixelOrder order, InstructionSet isa);
  /// For another frame, in the same memory. Throws std::bad_alloc only; then it may but be set again.
  void set(const ColorLayout& layout, const Palette* palette, PixelOrder order);
  ScanOut(ScanOut&&) noexcept = default;
  ScanOut& operator=(ScanOut&&) noexcept = default;

  /// The top left width_px x height_px pixels of a tile (tile memory, kTileAlignment aligned) go to the rows
  /// that start at `first_row`, top row first. stride_bytes may be negative. Nothing else is written. Bits of
  /// a word beyond the layout's are ignored. Bit-identical to scan_out_pixel_reference() on every instruction
  /// set. Never fails, never allocates.
  /// @param width_px, height_px  what of the tile lies in the picture: 0 .. tile_size.
  /// @param first_row            any alignment.
  void tile(const std::uint32_t* packed_tile, int tile_size, int width_px, int height_px,
            std::uint8_t* first_row, std::ptrdiff_t stride_bytes) const noexcept {
    tile_fn_(rule_, packed_tile, tile_size, width_px, height_px, first_row, stride_bytes);
  }
  /// The same for one row of packed pixels, left to right.
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
