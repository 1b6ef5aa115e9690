// A heatmap next to its frame, with a key.
#pragma once

#include <string>

#include "perf/bench/traced_frame.h"

namespace tessera::bench {

/// The frame at the left, the heatmap at the right, and below them a bar of the colours with its costs in
/// nanoseconds of one thread per pixel.
/// @param frame  picture of the frame, as large as the heatmap
Picture heatmap_sheet(const Heatmap& map, const Picture& frame, const std::string& workload);

}  // namespace tessera::bench
