// The lines of a television frame that shows a display mode: rows and samples in a line, and the phase of the
// subcarrier.
#pragma once

#include <cstdint>

#include "framebuffer/display/television_system.h"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// A line of a frame.
struct ScanLine {
  int number;  ///< in the order of time, from 0
  int row;     ///< row of pixels that the line shows

  friend bool operator==(const ScanLine&, const ScanLine&) = default;
};

/// Two kinds of frames:
/// - Modes whose line rate is within 3 % of the system's keep their timing. The subcarrier has as many cycles
///   per line as fit: 228 for CGA and NTSC.
/// - Others are broadcast: their rows are the lines of an interlaced frame of 525 or 625 lines, and their
///   width fills the active part of a line. Frames of more than 480 or 576 rows get more lines.
class TelevisionRaster {
 public:
  TelevisionRaster(const TelevisionSystem& system, const VideoMode& mode);

  int lines() const { return lines_; }  ///< per frame, blanking included
  bool interlaced() const { return interlaced_; }
  double cycles_per_line() const {
    return cycles_per_line_;
  }  ///< cycles of the subcarrier, blanking included

  /// Samples of the part of a line that shows pixels. There are four per cycle of the subcarrier; sample k is
  /// the mean of the pixels from k / samples_per_pixel() to (k + 1) / samples_per_pixel().
  int samples() const { return samples_; }
  double samples_per_pixel() const { return samples_per_pixel_; }
  /// Position of sample 0 of the picture in the line.
  int first_sample() const { return first_sample_; }

  /// Lines that show a row of pixels.
  int lines_per_row() const { return lines_per_row_; }
  /// @param repeat  0 to lines_per_row() - 1
  ScanLine line_of_row(int row, int repeat = 0) const;
  /// The line that is scanned `distance` lines before the first line of a row. Before the first row of the
  /// field, this row is shown.
  ScanLine line_before_row(int row, int distance) const;

  /// Angle of the subcarrier sin(angle) at sample 0 of the picture, in degrees. Sample k is at 90 k more.
  /// - The angle of line 0 of frame 0 is -90 degrees: a bright sample 0 has the phase of the burst. On CGA,
  ///   the pattern 1000 is then olive, 0100 red, 0010 blue and 0001 green, as on IBM's adapter.
  double subcarrier_degrees(std::int64_t frame, int line) const;
  /// -1 on lines on which V is inverted, else 1.
  int v_sign(std::int64_t frame, int line) const;

 private:
  void keep_timing(const VideoMode& mode);
  void broadcast(const VideoMode& mode);

  const TelevisionSystem& system_;
  double cycles_per_line_ = 0;
  double samples_per_pixel_ = 0;
  int lines_ = 0;
  int lines_per_row_ = 1;
  bool interlaced_ = false;
  int first_line_ = 0;  ///< shows the first row
  int samples_ = 0, first_sample_ = 0;
};

}  // namespace tessera::detail
