// Palettes chosen for pictures, for materials and lights, and for animations.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "display_mode.hpp"
#include "scene.hpp"
#include "types.hpp"

namespace tessera {

namespace detail {
class ColorCounts;
class SmoothEntries;
}  // namespace detail

inline constexpr int kMaxChosenEntries = 4096;  ///< most entries of a chosen palette

/// Size and colours of a palette that is to be chosen.
struct PaletteRequest {
  int count = 256;  ///< entries, 1 to kMaxChosenEntries
  /// Bits per component of the colours that entries may have: 1 to 8. 2: EGA, 4: Amiga, 6: VGA, 8: all.
  /// Level v is shown as round(255 v / (2^bits - 1)).
  int component_bits = 8;
};
/// The palettes that a display mode takes: at most 2^color_bits and kMaxChosenEntries entries.
/// @throws Error  for a mode whose palette is fixed or that has none; names what it has
TESSERA_API PaletteRequest palette_request(const DisplayMode& mode);

/// The colours of one or more pictures, and how often they occur. Memory: 16 bytes per distinct colour.
/// @code
/// PictureColors colors;
/// colors.add(pixels);  // one call per picture that shares the palette
/// const std::vector<Color> palette = adaptive_palette(colors, {.count = 32, .component_bits = 4});
/// FrameBuffer amiga({.color_mode = ColorMode::index, .color_bits = 5, .palette = palette});
/// @endcode
class TESSERA_API PictureColors {
 public:
  PictureColors();
  ~PictureColors();
  PictureColors(PictureColors&&) noexcept;
  PictureColors& operator=(PictureColors&&) noexcept;

  /// Adds a picture as Renderer::finish() writes it: r g b a bytes, alpha is ignored.
  /// @throws Error  for 0 bytes, or a number that is no multiple of 4
  void add(std::span<const std::uint8_t> rgba);
  /// Adds a picture as FrameBuffer::read_packed_colors() gives it for 24 colour bits: R:G:B, the upper 8 bits
  /// are ignored.
  /// @throws Error  for 0 words
  void add(std::span<const std::uint32_t> words);

 private:
  friend class SmoothPalette;
  friend TESSERA_API std::vector<Color> adaptive_palette(const PictureColors&, const PaletteRequest&);
  std::unique_ptr<detail::ColorCounts> counts_;
};

/// The palette of a picture: variance-based median cut, then k-means, in OKLab (Ottosson 2020).
/// - Dark to light. Entries are colours of the converter, and no two are equal.
/// - Fewer than `count` only if the picture has fewer colours, components rounded to the converter's levels.
/// - Same bits on every machine. Serial: 640x480 pixels take about 20 ms.
/// @throws Error  for a picture without pixels (see PictureColors::add) or requests out of range
TESSERA_API std::vector<Color> adaptive_palette(const PictureColors& picture,
                                                const PaletteRequest& request = {});
TESSERA_API std::vector<Color> adaptive_palette(std::span<const std::uint8_t> rgba,
                                                const PaletteRequest& request = {});
TESSERA_API std::vector<Color> adaptive_palette(std::span<const std::uint32_t> words,
                                                const PaletteRequest& request = {});

/// Materials under the same lights.
struct LitMaterials {
  std::vector<Material> materials{};
  std::vector<Light> lights{};
  LightModel light_model{};
};
/// The palette of lit materials, before anything is drawn.
/// - Ramps of each material: from its colour in ambient light over full diffuse light to the highlight, for
///   each light alone and for all of them, clamped to 0 to 1. Emission is included. Lights shine with their
///   full colour, divided by attenuation_constant if that is above 1.
/// - `colors` are single colours: background, unlit draws, textures. Clamped to 0 to 1.
/// - The ends of ramps and `colors` have entries; others are evenly spaced along all ramps, by their lengths
///   in OKLab. With more ends and colours than entries, the adaptive palette of all of them is returned.
/// - Dark to light, distinct colours of the converter. Fewer than `count` only if the ramps have no more.
/// - Same bits on every machine.
/// @throws Error  without a material and a colour, for values that are not finite, or requests out of range
TESSERA_API std::vector<Color> ramp_palette(std::span<const LitMaterials> groups,
                                            std::span<const Color> colors,
                                            const PaletteRequest& request = {});

/// A palette that follows an animation without jumps.
/// - Entries keep their indices.
/// - 6 bits per component and more: an entry moves at most 0.02 in OKLab (Euclidean) from one picture to the
///   next, after rounding to the converter's levels. It stays if the converter's next colour is further away.
/// - Fewer bits: at most one component of an entry changes, by one level.
/// - The first picture has its adaptive_palette(); entries beyond the colours of the picture repeat it.
/// - Same bits on every machine.
/// @code
/// SmoothPalette palette({.count = 16, .component_bits = 4});
/// PictureColors colors;
/// colors.add(pixels);  // r g b a bytes of a frame of 24 bits
/// buffer.set_palette(palette.follow(colors));
/// @endcode
class TESSERA_API SmoothPalette {
 public:
  /// @throws Error  for requests out of range
  explicit SmoothPalette(const PaletteRequest& request = {});
  ~SmoothPalette();
  SmoothPalette(SmoothPalette&&) noexcept;
  SmoothPalette& operator=(SmoothPalette&&) noexcept;

  /// Adapts the palette to the next picture, by k-means that starts from the present entries.
  /// @return `count` entries
  /// @throws Error  for a picture without pixels
  std::vector<Color> follow(const PictureColors& picture);

 private:
  std::unique_ptr<detail::SmoothEntries> entries_;
};

}  // namespace tessera
