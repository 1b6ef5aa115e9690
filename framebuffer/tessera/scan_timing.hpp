// Timing of a display: how often its lines and frames are scanned.
#pragma once

namespace tessera {

/// Video timing of a display mode.
struct ScanTiming {
  double pixel_clock_hz = 0;
  int total_columns = 1;    ///< pixel clocks per line, blanking included
  int total_lines = 1;      ///< lines per frame, blanking included
  int lines_per_row = 1;    ///< scanned lines per row of pixels: 2 if each row is shown twice
  bool interlaced = false;  ///< a frame is two fields of half of the lines each

  /// Lines per second: pixel clock / columns.
  constexpr double line_rate_hz() const { return pixel_clock_hz / total_columns; }
  /// Frames per second: line rate / lines.
  constexpr double frame_rate_hz() const { return line_rate_hz() / total_lines; }
  /// Vertical scans per second: two per frame if interlaced, else one.
  constexpr double field_rate_hz() const { return frame_rate_hz() * (interlaced ? 2 : 1); }
};

}  // namespace tessera
