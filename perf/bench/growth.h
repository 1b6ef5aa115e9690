// How time and memory grow with what is in a frame: measured, as a table and as a plot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "perf/bench/measure.h"

namespace tessera::bench {

struct GrowthPoint {
  double count = 0;  ///< of triangles, pixels, lights or draws
  double ms = 0;
  double megabytes = 0;  ///< at the first frame's peak, with meshes, planes and the image
};

/// All else is the same.
struct Growth {
  std::string of;    ///< "triangles", ...
  std::string what;  ///< the frame, in one line
  std::vector<GrowthPoint> points;
};

/// Triangles from 10 k to 20 M, pixels from 64 k to 33 M, lights from 1 to 32, draws from 10 to 10,000.
/// Throws Error where a picture is wrong.
std::vector<Growth> measure_growth(const WorkloadSetup& setup, const MeasureOptions& options,
                                   const HardwareCounters& counters);

std::string growth_table(const std::vector<Growth>& all);
/// Both axes are logarithmic: a straight line that rises by a decade for each is proportional.
std::string growth_svg(const std::vector<Growth>& all);

}  // namespace tessera::bench
