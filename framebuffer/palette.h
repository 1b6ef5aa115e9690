// Palettes of colour-index buffers: index -> colour of 8 bits per component.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "framebuffer/check.h"

namespace tessera::detail {

/// A colour of 8 bits per component.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb8, Rgb8) = default;
};
/// floor(255 c + 0.5) per component; c is clamped to 0..1, NaN counts as 0.
Rgb8 quantize_rgb8(float r, float g, float b) noexcept;

/// 2^bits entries. The first entries.size() are set, the others are black.
struct Palette {
  int bits = 8;               ///< 1 .. 24
  std::vector<Rgb8> entries;  ///< at most 2^bits

  /// Number of entries, including unset ones.
  std::uint32_t size() const noexcept { return std::uint32_t{1} << bits; }
  /// Colour of any index; black for unset entries and beyond the end.
  Rgb8 operator[](std::uint32_t index) const noexcept {
    TESSERA_ASSERT(entries.size() <= size());
    return index < entries.size() ? entries[index] : Rgb8{};
  }
};

/// Entries of a named palette: "bw" (2), "gray" (2^bits), "ega16" (16), "vga256" (256), "web216" (216).
/// - nullopt for an unknown name.
/// - The result may exceed 2^bits entries; the caller checks.
/// - Throws std::bad_alloc only.
///
/// @param bits  1 .. 24; affects "gray" only
std::optional<std::vector<Rgb8>> palette_entries(std::string_view name, int bits);
/// Default palette of a buffer of `bits` bits: bw at 1, gray at 2 and 3, ega16 at 4 to 7, vga256 from 8 on.
std::string_view default_palette_name(int bits) noexcept;
Palette default_palette_of(int bits);

}  // namespace tessera::detail
