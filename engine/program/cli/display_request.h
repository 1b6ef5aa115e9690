// The display that `tessera display` and `tessera render` show pictures on, as their options name it.
#pragma once

#include <optional>
#include <string>

#include "framebuffer/tessera/screen.hpp"

namespace tessera::program::cli {

struct DisplayRequest {
  std::optional<Display> display;  ///< absent: pictures are written as they are
  ScreenView view;                 ///< part of the screen, scale and gain
  double start_ms = 0;             ///< time of the first picture
  double frame_ms = 0;             ///< time from each picture to the next; 0: one frame of the mode
};

/// Returns find_display(text).
/// @throws Error as find_display() throws DisplayError; for a mistyped name with a suggestion
Display named_display(const std::string& text);

/// "X,Y,W,H": a part of the screen in millimetres, with X and Y at least 0, W and H above 0.
/// @throws Error for other texts
void parse_part(const std::string& text, ScreenView& view);

}  // namespace tessera::program::cli
