// The parts of a frame's signal that carry no picture: blanking, sync and burst.
#pragma once

#include <cstdint>

#include "framebuffer/display/television_encoder.h"
#include "framebuffer/display/television_raster.h"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Levels of the picture, in the unit of the system.
struct SignalLevels {
  double black, white;
};
SignalLevels signal_levels(const TelevisionSystem& system, const Television& television);

/// A frame without rows: line and field sync, and the burst on all lines without field sync.
/// - Pulses have vertical edges; a sample is the mean over its time.
/// - The burst has no rise time.
VideoSignal blank_frame(const TelevisionSystem& system, const Television& television,
                        const TelevisionRaster& raster, std::int64_t frame);

/// Puts the picture's part of a line into the frame. The active part of the line around it becomes black.
void insert_picture(const TelevisionSystem& system, const SignalLevels& levels,
                    const TelevisionRaster& raster, const SampleRange& range, const WireLine& wires, int line,
                    VideoSignal& signal);

}  // namespace tessera::detail
