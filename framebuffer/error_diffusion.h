// Error diffusion: reduces a picture of 8 bits per component to the levels or palette entries of a frame
// buffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "framebuffer/format.h"
#include "framebuffer/light_curve.h"
#include "framebuffer/palette.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

struct ErrorDiffusionOptions {
  Dither kind = Dither::floyd_steinberg;  ///< or jarvis
  ColorLayout stored;                     ///< layout of the result
  const Palette* palette = nullptr;       ///< index layouts; need not outlive the construction
  std::optional<LightCurve> light;        ///< absent: DitherSpace::levels
  int width = 0;                          ///< pixels
};

/// Share of a rounding error for the pixel dx to the right (in the direction of the row) and dy below. Lists
/// begin with dx = 1, then dx = 2 if it has a share, of dy = 0.
struct ErrorShare {
  int dx, dy;
  float share;
};
/// [Floyd and Steinberg 1976]
inline constexpr std::array<ErrorShare, 4> kFloydSteinberg{
    {{1, 0, 7.0f / 16}, {-1, 1, 3.0f / 16}, {0, 1, 5.0f / 16}, {1, 1, 1.0f / 16}}};
/// [Jarvis, Judice and Ninke 1976]
inline constexpr std::array<ErrorShare, 12> kJarvis{{{1, 0, 7.0f / 48},
                                                     {2, 0, 5.0f / 48},
                                                     {-2, 1, 3.0f / 48},
                                                     {-1, 1, 5.0f / 48},
                                                     {0, 1, 7.0f / 48},
                                                     {1, 1, 5.0f / 48},
                                                     {2, 1, 3.0f / 48},
                                                     {-2, 2, 1.0f / 48},
                                                     {-1, 2, 3.0f / 48},
                                                     {0, 2, 5.0f / 48},
                                                     {1, 2, 3.0f / 48},
                                                     {2, 2, 1.0f / 48}}};

/// Distributes the rounding error of each pixel among its neighbours.
/// - Rows run from the top, alternately to the right and to the left (serpentine).
/// - Values are stored values, or their light. RGB components are rounded to the nearest level. For a palette
///   the nearest entry is taken; values with errors are limited to 0..1, so that colours which no mix of
///   entries reaches leave no trail.
/// - Shares beyond the left and right edge go to the pixel at the edge, those of the last pixel of a row to
///   the pixel below it; shares below the picture are lost.
/// - A pixel that a draw gave an index keeps it, and neither takes nor passes errors.
/// - Same bits on every machine. One thread at a time.
class ErrorDiffusion {
 public:
  /// Takes all memory. Throws std::bad_alloc only.
  explicit ErrorDiffusion(const ErrorDiffusionOptions& options);
  ~ErrorDiffusion();
  ErrorDiffusion(ErrorDiffusion&&) noexcept;
  ErrorDiffusion& operator=(ErrorDiffusion&&) noexcept;

  /// Starts at the top row.
  void begin_picture();
  /// Reduces the next row.
  /// @param words   `width` packed colours of working_layout(stored)
  /// @param stored  receives `width` packed colours of the stored layout
  void row(const std::uint32_t* words, std::uint32_t* stored);

 private:
  class Rows;
  std::unique_ptr<Rows> rows_;
};

}  // namespace tessera::detail
