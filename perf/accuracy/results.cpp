#include "perf/accuracy/results.h"

#include "perf/bench/text.h"

namespace tessera::accuracy {

void find_fronts(const std::vector<SettingResult>& settings, ThreadResult& threads) {
  for (const JudgedBy& judge : {kPointReference, kAreaReference}) {
    std::vector<CostPoint> points;
    for (std::size_t i = 0; i < settings.size(); ++i)
      points.push_back({(settings[i].errors.*judge.errors).unrounded_rms, threads.times[i].ratio});
    threads.*judge.dominated_by = dominating_points(points);
  }
}

std::string reason_off_front(const SceneResult& scene, const ThreadResult& threads, const JudgedBy& judge) {
  const std::size_t other = (threads.*judge.dominated_by).front();
  if (other == 0) return "";
  const SettingResult& better = scene.settings[other];
  const double own_error = (scene.settings.front().errors.*judge.errors).unrounded_rms;
  const double error = (better.errors.*judge.errors).unrounded_rms;
  const TimeFigures& times = threads.times[other];
  const std::string cost =
      bench::formatted("%s takes %.3f (%.3f to %.3f) of the time", better.setting.name.c_str(),
                       times.ratio.median, times.ratio.low, times.ratio.high);
  if (error == own_error)
    return cost + " for the same error, because what it leaves out does not show in this scene: " +
           better.setting.text + ".";
  return cost + bench::formatted(" for an error of %.4f instead of %.4f levels: ", error, own_error) +
         better.setting.text +
         (judge.name == std::string_view("area")
              ? ", which smooths edges that one sample per pixel leaves jagged."
              : ", and errors of rounding happen to be smaller.");
}

}  // namespace tessera::accuracy
