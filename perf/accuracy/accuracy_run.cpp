#include "perf/accuracy/accuracy_run.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <mutex>

#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/progress.h"
#include "engine/program/compare/picture_errors.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/threads/parallel_for.h"
#include "engine/program/threads/thread_limit.h"
#include "perf/accuracy/accuracy_input.h"
#include "perf/accuracy/report_page.h"
#include "perf/accuracy/result_files.h"
#include "perf/accuracy/setting_frames.h"
#include "perf/accuracy/timing_processes.h"
#include "perf/bench/text.h"

namespace tessera::accuracy {
namespace {

using bench::formatted;

constexpr int kRounds = 31, kQuickRounds = 9;

TimingPlan plan_of(const AccuracyOptions& options) {
  TimingPlan plan{.threads = {1}, .instruction_set = options.instruction_set, .rounds = options.rounds};
  const int threads = options.threads > 0 ? options.threads : std::min(program::available_cores(), 2);
  if (threads != 1) plan.threads.push_back(threads);
  if (plan.rounds == 0) plan.rounds = options.is_quick ? kQuickRounds : kRounds;
  return plan;
}

std::vector<TimedScene> timed_scenes(std::vector<AccuracyInput> inputs) {
  std::vector<TimedScene> scenes;
  for (AccuracyInput& input : inputs) {
    std::vector<Setting> settings = settings_for(input.scene, input.settings);
    scenes.push_back({std::move(input.scene), std::move(settings)});
  }
  return scenes;
}

/// Progress over stages, each of which is estimated to take some seconds.
class Stages {
 public:
  explicit Stages(double total_seconds) : total_(total_seconds) {}

  /// Shows the done share of the current stage. Returns false after Ctrl-C.
  bool show(double share, double stage_seconds, const std::string& label) {
    progress_.show((done_ + share * stage_seconds) / total_, label);
    return !program::cli::Interrupt::pressed();
  }
  void end_stage(double stage_seconds) { done_ += stage_seconds; }
  void clear() { progress_.clear(); }

 private:
  program::cli::Progress progress_{program::cli::ShowProgress::automatic};
  double total_;
  double done_ = 0;
};

/// Estimated seconds of the stages of a scene, for the progress bar.
struct StageSeconds {
  double references, errors, times;
};
StageSeconds estimate(const AccuracyInput& input, std::size_t settings, const TimingPlan& plan, int threads) {
  const double pixels = static_cast<double>(input.scene.framebuffer.width) * input.scene.framebuffer.height;
  const double sample_us = 0.7 + 0.07 * static_cast<double>(input.scene.lights.size());
  const double turns = static_cast<double>(settings * plan.threads.size()) * plan.rounds;
  return {1e-6 * 256 * pixels * sample_us / threads,
          1e-6 * 1.5 * pixels * static_cast<double>(settings) / threads,
          turns * (0.002 + 1e-8 * pixels * static_cast<double>(input.scene.lights.size()))};
}

double rounding_rms(const ReferencePicture& reference) {
  return program::unrounded_errors(program::pixels_of(reference.stored), reference.unrounded).rms;
}

/// For each result: index of the first with the same picture.
std::vector<std::size_t> first_equal_pictures(const std::vector<SettingResult>& results) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::size_t k = 0;
    while (results[k].picture.rgba != results[i].picture.rgba) ++k;
    first.push_back(k);
  }
  return first;
}

/// Draws each setting once and compares the pictures with the references.
/// @param progress  as for render_references()
std::vector<SettingResult> setting_results(AccuracyInput& input, const References& references,
                                           Renderer& renderer, int threads,
                                           const std::function<bool(double)>& progress) {
  std::vector<SettingResult> results;
  for (const Setting& setting : settings_for(input.scene, input.settings)) {
    SettingFrames frames(input.scene, setting.variation, renderer);
    frames.draw();
    results.push_back({setting, {}, frames.picture()});
  }
  // Many settings draw the same picture: its errors are found once.
  const std::vector<std::size_t> first = first_equal_pictures(results);
  std::mutex mutex;
  std::size_t done = 0;
  const auto compare = [&](int number) {
    const auto index = static_cast<std::size_t>(number);
    SettingResult& result = results[index];
    if (first[index] == index)
      result.errors = {setting_errors(result.picture, references.point),
                       setting_errors(result.picture, references.area)};
    const std::lock_guard lock(mutex);
    if (!progress(static_cast<double>(++done) / static_cast<double>(results.size())))
      throw Cancelled("interrupted");
  };
  program::parallel_for(static_cast<int>(results.size()), threads, [&] { return compare; });
  for (std::size_t i = 0; i < results.size(); ++i) results[i].errors = results[first[i]].errors;
  return results;
}

/// References and errors of one scene.
SceneResult scene_result(AccuracyInput& input, Renderer& renderer, int threads, const StageSeconds& seconds,
                         Stages& stages) {
  ReferencePicture area = render_area_reference(input.reference, threads, [&](double share) {
    return stages.show(share, seconds.references, input.name + ": reference");
  });
  stages.end_stage(seconds.references);
  SceneResult scene{.name = input.name,
                    .title = input.title,
                    .references = {render_point_reference(input.reference), std::move(area)}};
  scene.point_rounding_rms = rounding_rms(scene.references.point);
  scene.area_rounding_rms = rounding_rms(scene.references.area);
  scene.settings = setting_results(input, scene.references, renderer, threads, [&](double share) {
    return stages.show(share, seconds.errors, input.name + ": errors");
  });
  stages.end_stage(seconds.errors);
  return scene;
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm time{};
  ::gmtime_r(&now, &time);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &time)};
}

/// Adds the times of all processes to the results.
void add_times(RunResult& run, const TimingPlan& plan, const std::vector<ProcessTimes>& processes) {
  for (std::size_t s = 0; s < run.scenes.size(); ++s)
    for (std::size_t t = 0; t < plan.threads.size(); ++t) {
      std::vector<ProcessRounds> rounds;
      for (const ProcessTimes& process : processes) rounds.push_back(process.rounds[t][s]);
      ThreadResult& result = run.scenes[s].threads.emplace_back();
      result.threads = plan.threads[t];
      result.times = time_figures(rounds);
      find_fronts(run.scenes[s].settings, result);
    }
  for (const ProcessTimes& process : processes) {
    run.disturbance += process.disturbance;
    run.has_counters = process.has_counters;
  }
}

std::string summary_text(const RunResult& run, const std::string& folder) {
  std::string text = formatted("%-14s %7s %9s %9s   %-23s %s\n", "scene", "settings", "RMS", "rounding",
                               "noise, 1 thread", "default");
  for (const SceneResult& scene : run.scenes) {
    const ThreadResult& threads = scene.threads.front();
    const Interval& noise = threads.times.front().ratio;
    const bool is_on = threads.dominated_by_point.front() == 0 && threads.dominated_by_area.front() == 0;
    text += formatted("%-14s %7zu %9.4f %9.4f   %.3f (%.3f to %.3f)   %s\n", scene.name.c_str(),
                      scene.settings.size(), scene.settings.front().errors.point.unrounded_rms,
                      scene.point_rounding_rms, noise.median, noise.low, noise.high,
                      is_on ? "on the front" : "off a front; the report says why");
  }
  return text + formatted(
                    "\n%lld involuntary context switches, %.0f ms stolen from the machine\n%s/report.html, "
                    "results.csv, results.json, pictures/\n",
                    static_cast<long long>(run.disturbance.involuntary_switches), run.disturbance.stolen_ms,
                    folder.c_str());
}

}  // namespace

std::string run_accuracy(const AccuracyOptions& options, const std::vector<std::string>& arguments) {
  const program::cli::Interrupt interrupt;
  const std::string folder = options.folder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot create the folder \"" + folder + "\": " + error.message());
  for (const char* file : {"report.html", "results.csv", "results.json"})
    program::require_writable(folder + "/" + file);

  std::vector<AccuracyInput> inputs = accuracy_inputs(options);
  const TimingPlan plan = plan_of(options);
  const int threads = plan.threads.back();
  const program::ThreadLimit limit(threads);
  Renderer renderer({.threads = threads, .instruction_set = options.instruction_set});
  RunResult run{.machine = program::cli::machine_text(),
                .instruction_set = std::string(name(renderer.options().instruction_set)),
                .date = date_now(),
                .is_quick = options.is_quick,
                .rounds = plan.rounds,
                .processes = kProcesses};
  std::vector<StageSeconds> seconds;
  double total = 0, times_seconds = 0, files_seconds = 0;
  for (const AccuracyInput& input : inputs) {
    const std::size_t settings = settings_for(input.scene, input.settings).size();
    seconds.push_back(estimate(input, settings, plan, threads));
    times_seconds += seconds.back().times;
    files_seconds += 0.05 * static_cast<double>(settings);
    total += seconds.back().references + seconds.back().errors;
  }
  Stages stages(total + times_seconds + files_seconds);

  for (std::size_t i = 0; i < inputs.size(); ++i)
    run.scenes.push_back(scene_result(inputs[i], renderer, threads, seconds[i], stages));

  const std::vector<TimedScene> scenes = timed_scenes(std::move(inputs));
  const double all_rounds =
      static_cast<double>(plan.rounds) * static_cast<double>(scenes.size() * plan.threads.size());
  std::vector<ProcessTimes> processes;
  double rounds_before = 0;
  for (int process = 0; process < kProcesses; ++process) {
    std::vector<std::string> child_arguments = arguments;
    child_arguments.push_back("--time-process=" + std::to_string(process));
    processes.push_back(times_of_process(child_arguments, scenes, plan, [&](int rounds) {
      return stages.show((rounds_before + rounds) / all_rounds, times_seconds,
                         "times, process " + std::to_string(process + 1) + " of 3");
    }));
    rounds_before +=
        rounds_of_process(plan.rounds, process) * static_cast<double>(scenes.size() * plan.threads.size());
  }
  stages.end_stage(times_seconds);
  add_times(run, plan, processes);

  const auto show_files = [&](double share) { return stages.show(share, files_seconds / 2, "pictures"); };
  const std::string page = report_page(run, threads, show_files);
  stages.end_stage(files_seconds / 2);
  write_pictures(run, folder, threads, show_files);
  program::write_file_atomically(folder + "/results.csv", results_csv(run));
  program::write_file_atomically(folder + "/results.json", results_json(run).dump(1) + "\n");
  program::write_file_atomically(folder + "/report.html", page);
  stages.clear();
  return summary_text(run, folder);
}

bool run_timing(const AccuracyOptions& options) {
  const program::cli::Interrupt interrupt;
  std::vector<TimedScene> scenes = timed_scenes(accuracy_inputs(options));
  return time_in_this_process(scenes, plan_of(options), options.time_process, stdout);
}

}  // namespace tessera::accuracy
