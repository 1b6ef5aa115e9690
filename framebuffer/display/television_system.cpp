#include "framebuffer/display/television_system.h"

#include "framebuffer/check.h"

namespace tessera::detail {
namespace {

constexpr double kNtscSubcarrierHz = 315e6 / 88;

constexpr TelevisionSystem kNtscM{
    .subcarrier_hz = kNtscSubcarrierHz,
    .cycles_per_line = 455 / 2.0,
    .alternates_v = false,
    .lines = 525,
    .rows_per_field = 240,
    .first_line = 22,
    .active_us = 52.7,
    .active_start_us = 9.36,  // 63.556 less 1.5 of front porch and 52.7
    .sync_us = 4.7,
    .equalizing_us = 2.3,
    .equalizing_before = 6,
    .broad = 6,
    .first_broad_half_line = 6,
    .burst_start_us = 19 / kNtscSubcarrierHz * 1e6,  // 19 cycles
    .burst_cycles = 9,
    .white = 100,
    .sync = -40,
    .setup = 7.5,
    .burst_peak = 20,
    .unit = "IRE",
    .luma_mhz = 4.2,
    .chroma_mhz = 1.3,
    .receiver_mhz = 0.5,
};

constexpr TelevisionSystem kPalBg{
    .subcarrier_hz = 4433618.75,
    .cycles_per_line = 1135 / 4.0 + 1 / 625.0,
    .alternates_v = true,
    .lines = 625,
    .rows_per_field = 288,
    .first_line = 21,  // BT.470 has 22, whose 288 lines end with the half line 623
    .active_us = 52,
    .active_start_us = 10.5,
    .sync_us = 4.7,
    .equalizing_us = 2.35,
    .equalizing_before = 5,
    .broad = 5,
    .first_broad_half_line = 0,
    .burst_start_us = 5.6,
    .burst_cycles = 10,
    .white = 700,
    .sync = -300,
    .setup = 0,
    .burst_peak = 150,
    .unit = "mV",
    .luma_mhz = 5.0,
    .chroma_mhz = 1.3,
    .receiver_mhz = 1.0,
};

}  // namespace

const TelevisionSystem& television_system(DisplayKind kind) {
  TESSERA_ASSERT(kind == DisplayKind::ntsc || kind == DisplayKind::pal);
  return kind == DisplayKind::pal ? kPalBg : kNtscM;
}

}  // namespace tessera::detail
