// The work of a frame in units of the prices.
#pragma once

#include <span>

#include "engine/plan/frame_commands.h"
#include "engine/tessera/prices.hpp"
#include "engine/tessera/renderer.hpp"

namespace tessera::detail {

/// A finished frame, to be counted.
struct FinishedFrame {
  const FrameCommands& commands;
  const FrameRecording& recording;
  const FrameBufferState& target;
  std::span<const DrawMeasurement> draws;  ///< per recorded draw, with fragments
  const FrameStats& stats;
  bool presented = false;  ///< the colour went to an image
};
WorkCounts count_work(const FinishedFrame& frame);

}  // namespace tessera::detail
