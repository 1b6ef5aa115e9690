// Files of a run: tables and pictures.
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "perf/accuracy/results.h"

namespace tessera::accuracy {

/// One line per scene, setting and number of threads. Columns up to `area_flip_p99` are the same bytes in
/// every run; the others are times.
std::string results_csv(const RunResult& run);

/// The same and how it was measured. Numbers of errors are the texts of results.csv.
nlohmann::ordered_json results_json(const RunResult& run);

/// A difference of pictures, amplified for the eye.
struct AmplifiedDifference {
  program::Picture picture;
  int gain = 1;  ///< absolute differences were multiplied by this power of two, 1 to 64
};
/// The largest gain that no difference exceeds 255 with.
AmplifiedDifference amplified_difference(const program::Picture& result, const program::Picture& reference);

/// Writes results and references of all scenes, and differences from both references:
///   pictures/SCENE/reference_point.png, reference_area.png
///   pictures/SCENE/SETTING.result.png, SETTING.difference_point_x16.png, SETTING.difference_area_x4.png
/// - The number after x is the gain of the difference.
/// @param progress  called with the done share, 0 to 1; false cancels
/// @throws Cancelled if `progress` returns false
void write_pictures(const RunResult& run, const std::string& folder, int threads,
                    const std::function<bool(double)>& progress);

}  // namespace tessera::accuracy
