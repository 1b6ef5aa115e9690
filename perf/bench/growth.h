// How time and memory grow with the content of a frame: measured, as a table and as a plot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "perf/bench/measure.h"

namespace tessera::bench {

struct GrowthPoint {
  double count = 0;  ///< triangles, pixels, lights or draws
  double ms = 0;
  double mebibytes =
      0;  ///< growth of memory up to the end of the first frame: meshes, planes and image included
};

/// Frames that differ in one quantity only.
struct Growth {
  std::string quantity;     ///< "triangles", ...
  std::string description;  ///< the frame, in one line
  std::vector<GrowthPoint> points;
};

/// Measures 10 k to 20 M triangles, 64 k to 33 M pixels, 1 to 32 lights and 10 to 10,000 draws.
/// @throws Error if a picture is wrong
std::vector<Growth> measure_growth(const WorkloadSetup& setup, const MeasureOptions& options,
                                   const HardwareCounters& counters);

std::string growth_table(const std::vector<Growth>& all);
/// Log-log plots: proportional growth is a straight line of slope one decade per decade.
std::string growth_svg(const std::vector<Growth>& all);

}  // namespace tessera::bench
