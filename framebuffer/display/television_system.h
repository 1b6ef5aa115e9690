// NTSC-M and PAL-B/G: rates, levels, and the structure of their lines.
#pragma once

#include <string_view>

#include "framebuffer/tessera/display.hpp"

namespace tessera::detail {

/// Constants of a television system. Times count from the leading edge of the line's sync.
/// Sources: SMPTE 170M-1999 (NTSC-M), ITU-R BT.1700 and BT.470-6 (PAL-B/G).
struct TelevisionSystem {
  double subcarrier_hz;
  double cycles_per_line;     ///< cycles of the subcarrier
  bool alternates_v;          ///< V changes its sign on each line
  int lines;                  ///< per frame of two fields
  int rows_per_field;         ///< rows of pictures that fill the screen
  int first_line;             ///< line of a field, from 0, that shows the first of these rows
  double active_us;           ///< length of the picture in a line
  double active_start_us;     ///< its beginning
  double sync_us;             ///< length of the line sync, and of the gap between two broad pulses
  double equalizing_us;       ///< length of an equalizing pulse
  int equalizing_before;      ///< equalizing pulses before the broad pulses of a field, one per half line
  int broad;                  ///< broad pulses, and equalizing pulses after them
  int first_broad_half_line;  ///< half line of the frame in which the first broad pulse begins
  double burst_start_us;
  int burst_cycles;
  double white, sync, setup;  ///< levels in `unit`; blanking is 0, `setup` the usual level of black
  double burst_peak;          ///< half of the burst's peak-to-peak amplitude
  std::string_view unit;
  double luma_mhz, chroma_mhz, receiver_mhz;  ///< bandwidths unless others are given
};

/// @param kind  ntsc or pal
const TelevisionSystem& television_system(DisplayKind kind);

// Y = .299 R + .587 G + .114 B, U = kUScale (B - Y), V = kVScale (R - Y) [SMPTE 170M, ITU-R BT.470].
inline constexpr double kLumaRed = .299, kLumaGreen = .587, kLumaBlue = .114;
inline constexpr double kUScale = .492111, kVScale = .877283;

}  // namespace tessera::detail
