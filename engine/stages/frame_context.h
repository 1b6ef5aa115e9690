// Objects that exist while one frame runs.
#pragma once

#include <chrono>
#include <utility>

#include "engine/record/recording.h"
#include "engine/runtime/frame_progress.h"
#include "engine/runtime/frame_trace.h"
#include "framebuffer/tile_grid.h"
#include "shading/fragment_stage.h"

namespace tessera::detail {

/// Wall time between laps.
class StopWatch {
 public:
  /// Seconds since the last lap, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct FrameContext {
  FrameContext(FrameRecording& frame_recording, const ImageTarget* presented_image, const TileGrid& tile_grid,
               const RendererOptions& options, int workers)
      : recording(frame_recording),
        target(*frame_recording.target),
        image(presented_image),
        grid(tile_grid),
        trace(options.trace ? workers : 0),
        progress(options.progress, trace) {}
  FrameContext(const FrameContext&) = delete;
  FrameContext& operator=(const FrameContext&) = delete;

  FrameRecording& recording;
  FrameBufferState& target;
  const ImageTarget* image;  ///< may be null
  TileGrid grid;
  StopWatch clock;
  FrameTrace trace;
  FrameProgress progress;
  FrameStats stats;
  StageFailure stage_failure;  ///< first exception of a fragment stage
  bool bins_filled = false;    ///< the bins of all tiles fit in memory and are filled
};

}  // namespace tessera::detail
