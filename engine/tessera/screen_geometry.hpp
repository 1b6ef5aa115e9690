// Resolution of a 4:3 screen from its diagonal and dot pitch.
#pragma once

#include "export.h"

namespace tessera {

struct DisplayMode;

/// Size and resolution of a 4:3 screen.
struct ScreenResolution {
  double width_in = 0;   ///< 0.8 of the diagonal, inches
  double height_in = 0;  ///< 0.6 of the diagonal, inches
  double columns = 0;    ///< theoretical: 25.4 * width / pitch
  double rows = 0;       ///< theoretical: 25.4 * height / pitch
  /// Standard mode whose width has the smallest |log(width / columns)|: 640x480, 800x600, 1024x768,
  /// 1280x1024, 1600x1200 or 1920x1440.
  int mode_width = 0, mode_height = 0;
};

/// @param diagonal_in  inches
/// @param pitch_mm     distance of dots of one colour, millimetres
/// @throws Error  unless both are finite and above 0
TESSERA_API ScreenResolution screen_resolution(double diagonal_in, double pitch_mm);

/// Smallest diagonal, in inches, of a 4:3 screen that has a dot of each colour for every column and row of a
/// mode: its theoretical resolution is at least the mode's.
/// @throws Error  unless the pitch is finite and above 0, and the mode's size is at least 1x1
TESSERA_API double sharp_diagonal_in(const DisplayMode& mode, double pitch_mm);

}  // namespace tessera
