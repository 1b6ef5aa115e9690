// Everything that a run of `tessera accuracy` found out.
#pragma once

#include <string>
#include <vector>

#include "perf/accuracy/processor_clock.h"
#include "perf/accuracy/reference_pictures.h"
#include "perf/accuracy/setting_errors.h"
#include "perf/accuracy/settings.h"
#include "perf/accuracy/time_figures.h"

namespace tessera::accuracy {

/// A setting's picture and its errors; the same for any number of threads.
struct SettingResult {
  Setting setting;
  BothErrors errors;
  program::Picture picture;
};

/// Times of a scene's settings on one number of threads.
struct ThreadResult {
  int threads = 0;
  std::vector<TimeFigures> times;  ///< one per setting
  /// One per setting: index of the setting that proves it off the front, or its own (dominating_points()).
  /// Errors are RMS errors against the unrounded colours of a reference.
  std::vector<std::size_t> dominated_by_point, dominated_by_area;

  /// Whether the time of a setting differs from the default's beyond the noise: the row of the default
  /// itself.
  bool differs_in_time(std::size_t setting) const {
    return is_told_apart(times[setting].ratio, times.front().ratio);
  }
};

struct SceneResult {
  std::string name, title;
  References references;
  /// Errors of the references' own stored pictures against their unrounded colours: rounding alone.
  double point_rounding_rms = 0, area_rounding_rms = 0;
  std::vector<SettingResult> settings;  ///< the first is the default
  std::vector<ThreadResult> threads;
};

struct RunResult {
  std::string machine;  ///< lines of "property   value"
  std::string instruction_set;
  std::string date;  ///< start, UTC, YYYY-MM-DD HH:MM
  bool is_quick = false;
  bool has_counters = false;  ///< cycles are those of hardware counters
  int rounds = 0, processes = 0;
  Disturbance disturbance{};  ///< while times were measured
  std::vector<SceneResult> scenes;
};

/// One of the two references of a scene.
struct JudgedBy {
  const char* name;  ///< point or area
  const ReferencePicture References::*picture;
  SettingErrors BothErrors::*errors;
  std::vector<std::size_t> ThreadResult::*dominated_by;
};
inline constexpr JudgedBy kPointReference{"point", &References::point, &BothErrors::point,
                                          &ThreadResult::dominated_by_point};
inline constexpr JudgedBy kAreaReference{"area", &References::area, &BothErrors::area,
                                         &ThreadResult::dominated_by_area};

/// Sets both dominated_by lists from errors and times.
void find_fronts(const std::vector<SettingResult>& settings, ThreadResult& threads);

/// Why the default is off the front: a sentence that names a setting with no larger error that takes less
/// time, and what it changes. Empty if it is on the front.
std::string reason_off_front(const SceneResult& scene, const ThreadResult& threads, const JudgedBy& judge);

}  // namespace tessera::accuracy
