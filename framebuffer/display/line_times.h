// When the lines of a tube are scanned, and how much of their light an exposure collects.
#pragma once

#include <array>

#include "framebuffer/tessera/display.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Lines and times of the scan of one frame.
struct FrameScan {
  int lines;          ///< scan lines of the picture
  int lines_per_row;  ///< scan lines per row of pixels
  bool interlaced;    ///< even lines are scanned in the first half of the frame, odd ones in the second
  double frame_ms;    ///< from one frame to the next
  double line_ms;     ///< from one line of a field to the next
  double pixel_clock_hz;

  /// Time of a line after the beginning of its frame.
  double time_of(int line) const {
    return interlaced ? (line % 2) * frame_ms / 2 + (line / 2) * line_ms : line * line_ms;
  }
};

/// Timing of a mode without one: 60 frames per second, blank for 25 % of the columns and 5 % of the lines.
ScanTiming default_timing(int width, int height);

FrameScan frame_scan(const VideoMode& mode, const CrtTube& tube);

/// Decay of a phosphor: light is left exp(-t / time constant).
/// @return time constants of red, green, blue; of a monochrome phosphor three times the same, milliseconds
std::array<double, 3> decay_ms(Phosphor phosphor);

/// Whether a phosphor is seen in the frame after the one that excited it.
bool outlasts_frame(Phosphor phosphor);

/// Shares of light that an exposure collects of a line, if each excitation emits light 1 in all.
struct CollectedShares {
  double present;  ///< share of the excitations by this frame and by the next, which shows the same picture
  double earlier;  ///< share of the light that was left after the excitation by the frame before
};

/// @param from_ms, to_ms  the exposure, from the beginning of the present frame
/// @param line_ms         time of the line in its frame
CollectedShares collected_shares(double from_ms, double to_ms, double line_ms, double frame_ms,
                                 double decay_ms);

}  // namespace tessera::detail
