// Close-ups of simulated screens, at which phosphors, subpixels and scan lines are visible.
#pragma once

#include "engine/program/imageio/picture.h"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::program::cli {

inline constexpr int kCloseUpWidth = 640, kCloseUpHeight = 480;  ///< pixels
/// Pixels of a close-up per period of the screen's finest structure. Masks and subpixels keep their colours.
inline constexpr double kCloseUpPixelsPerPeriod = 8;

struct ScreenSize {
  double width_mm = 0, height_mm = 0;
};

/// A point of a screen.
struct ScreenPlace {
  double x = 0, y = 0;  ///< shares of the width and of the height, from the upper left corner, 0 to 1
};

/// Shortest period of a screen's structure in millimetres.
/// - Tubes: the triads of the mask along a row, or the scan lines across.
/// - Panels: the shorter side of a pixel.
double finest_period_mm(const Display& display, const VideoMode& mode, const ScreenSize& screen);

/// The close-up around a place, moved as far as needed to stay on the screen, and smaller than kCloseUpWidth
/// x kCloseUpHeight pixels if the screen is.
/// - Millimetres have three decimals and the scale has two: options of the program can name the same view.
ScreenView close_up_view(const Display& display, const VideoMode& mode, const ScreenSize& screen,
                         const ScreenPlace& place);

/// Exposure at which an image is as bright as the picture on the screen, if not more than 1 % of its pixels
/// are clipped, else at which 1 % are. At least 1, with two decimals.
/// @param image        the screen with gain 1
/// @param white_level  Screen::white_level(): even white is as bright as in the picture at 1 / white_level
double exposure_gain(const Picture& image, double white_level);

}  // namespace tessera::program::cli
