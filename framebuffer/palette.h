// Palettes of colour-index buffers: stored 8-bit colours, by index.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "framebuffer/check.h"

namespace tessera::detail {

/// A stored colour: 0 .. 255 each.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb8, Rgb8) = default;
};
/// The stored colour of components 0..1 (clamped; a NaN counts as 0): floor(255 c + 0.5).
Rgb8 quantize_rgb8(float r, float g, float b) noexcept;

/// Exactly 2^bits entries, of which the first entries.size() were given; the others show black.
struct Palette {
  int bits = 8;               ///< 1 .. 24
  std::vector<Rgb8> entries;  ///< at most 2^bits

  /// Entries, the unset ones included.
  std::uint32_t size() const noexcept { return std::uint32_t{1} << bits; }
  /// Any index; black where nothing was set.
  Rgb8 operator[](std::uint32_t index) const noexcept {
    TESSERA_ASSERT(entries.size() <= size());
    return index < entries.size() ? entries[index] : Rgb8{};
  }
};

/// Entries of a palette known by name: "bw" (2), "gray" (2^bits), "ega16" (16), "vga256" (256), "web216"
/// (216). Empty for another name. They may be more than 2^bits: the caller refuses that. Throws
/// std::bad_alloc only.
/// @param bits  1 .. 24; matters to "gray" alone.
std::optional<std::vector<Rgb8>> palette_entries(std::string_view name, int bits);
/// Name of the default palette of a buffer with `bits` bits: bw at 1, gray at 2 and 3, ega16 at 4 to 7,
/// vga256 at 8 and more.
std::string_view default_palette_name(int bits) noexcept;
/// That palette.
Palette default_palette_of(int bits);

}  // namespace tessera::detail
