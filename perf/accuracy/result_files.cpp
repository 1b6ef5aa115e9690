#include "perf/accuracy/result_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/threads/parallel_for.h"
#include "perf/accuracy/png_bytes.h"
#include "perf/bench/text.h"

namespace tessera::accuracy {
namespace {

using bench::formatted;
using Json = nlohmann::ordered_json;

/// A column of results.csv.
struct Column {
  const char* name;
  std::string text;
};

std::string decibels(double psnr_db) { return std::isinf(psnr_db) ? "inf" : formatted("%.3f", psnr_db); }

void add_error_columns(const JudgedBy& judge, const SettingErrors& errors, std::vector<Column>& columns) {
  const bool is_point = judge.name == kPointReference.name;
  const auto add = [&](const char* point_name, const char* area_name, std::string text) {
    columns.push_back({is_point ? point_name : area_name, std::move(text)});
  };
  add("point_rms_unrounded", "area_rms_unrounded", formatted("%.4f", errors.unrounded_rms));
  add("point_max_unrounded", "area_max_unrounded", formatted("%.3f", errors.unrounded_largest));
  add("point_max", "area_max", formatted("%d", errors.largest));
  add("point_rms", "area_rms", formatted("%.4f", errors.rms));
  add("point_psnr", "area_psnr", decibels(errors.psnr_db));
  add("point_share_over_1", "area_share_over_1", formatted("%.6f", errors.share_over_1));
  add("point_share_over_2", "area_share_over_2", formatted("%.6f", errors.share_over_2));
  add("point_flip", "area_flip", formatted("%.5f", errors.flip_mean));
  add("point_flip_p99", "area_flip_p99", formatted("%.5f", errors.flip_percentile_99));
}

void add_time_columns(const ThreadResult& threads, std::size_t setting, std::vector<Column>& columns) {
  const TimeFigures& times = threads.times[setting];
  const auto ratio = [](double value) { return formatted("%.4f", value); };
  columns.insert(columns.end(), {{"time", ratio(times.ratio.median)},
                                 {"time_low", ratio(times.ratio.low)},
                                 {"time_high", ratio(times.ratio.high)},
                                 {"told_apart", threads.differs_in_time(setting) ? "1" : "0"},
                                 {"process_low", ratio(times.process_low)},
                                 {"process_high", ratio(times.process_high)},
                                 {"ms", formatted("%.4f", times.ms.median)},
                                 {"ms_low", formatted("%.4f", times.ms.low)},
                                 {"ms_high", formatted("%.4f", times.ms.high)},
                                 {"cpu_ms", formatted("%.4f", times.cpu_ms)},
                                 {"million_cycles", formatted("%.3f", times.million_cycles)},
                                 {"front_point", threads.dominated_by_point[setting] == setting ? "1" : "0"},
                                 {"front_area", threads.dominated_by_area[setting] == setting ? "1" : "0"}});
}

std::vector<Column> columns_of(const SceneResult& scene, const ThreadResult& threads, std::size_t setting) {
  const SettingResult& result = scene.settings[setting];
  std::vector<Column> columns{{"scene", scene.name},
                              {"setting", result.setting.name},
                              {"group", result.setting.group},
                              {"threads", formatted("%d", threads.threads)}};
  for (const JudgedBy& judge : {kPointReference, kAreaReference})
    add_error_columns(judge, result.errors.*judge.errors, columns);
  add_time_columns(threads, setting, columns);
  return columns;
}

/// Calls take(scene, threads, setting) for every row.
template <class Take>
void for_each_row(const RunResult& run, const Take& take) {
  for (const SceneResult& scene : run.scenes)
    for (const ThreadResult& threads : scene.threads)
      for (std::size_t k = 0; k < scene.settings.size(); ++k) take(scene, threads, k);
}

Json scene_json(const SceneResult& scene) {
  Json json{{"name", scene.name},
            {"title", scene.title},
            {"rounding_rms",
             {{"point", formatted("%.4f", scene.point_rounding_rms)},
              {"area", formatted("%.4f", scene.area_rounding_rms)}}},
            {"settings", Json::array()},
            {"default_off_front", Json::array()}};
  for (const SettingResult& result : scene.settings)
    json["settings"].push_back({{"name", result.setting.name},
                                {"label", result.setting.label},
                                {"group", result.setting.group},
                                {"text", result.setting.text}});
  for (const ThreadResult& threads : scene.threads)
    for (const JudgedBy& judge : {kPointReference, kAreaReference})
      if (const std::string reason = reason_off_front(scene, threads, judge); !reason.empty())
        json["default_off_front"].push_back(
            {{"threads", threads.threads}, {"reference", judge.name}, {"reason", reason}});
  return json;
}

/// Path below the output folder, without gain and extension.
std::string picture_path(const SceneResult& scene, const SettingResult* setting, const std::string& kind) {
  return "pictures/" + scene.name + "/" + (setting == nullptr ? "" : setting->setting.name + ".") + kind;
}

/// A file to write: a picture of a scene.
struct PictureTask {
  std::string path;
  const program::Picture* picture;
  const program::Picture* reference = nullptr;  ///< absent: the picture itself, else the difference
};

std::vector<PictureTask> picture_tasks(const RunResult& run) {
  std::vector<PictureTask> tasks;
  for (const SceneResult& scene : run.scenes)
    for (const JudgedBy& judge : {kPointReference, kAreaReference}) {
      const std::string name = judge.name;
      const program::Picture& reference = (scene.references.*judge.picture).stored;
      tasks.push_back({picture_path(scene, nullptr, "reference_" + name), &reference});
      for (const SettingResult& result : scene.settings)
        tasks.push_back({picture_path(scene, &result, "difference_" + name), &result.picture, &reference});
    }
  for (const SceneResult& scene : run.scenes)
    for (const SettingResult& result : scene.settings)
      tasks.push_back({picture_path(scene, &result, "result"), &result.picture});
  return tasks;
}

void write_picture_of(const PictureTask& task, const std::string& folder) {
  std::string path = folder + "/" + task.path;
  if (task.reference == nullptr)
    return program::write_file_atomically(path + ".png", png_bytes(*task.picture, PngEffort::fast));
  const AmplifiedDifference difference = amplified_difference(*task.picture, *task.reference);
  path += "_x" + std::to_string(difference.gain) + ".png";
  program::write_file_atomically(path, png_bytes(difference.picture, PngEffort::fast));
}

}  // namespace

std::string results_csv(const RunResult& run) {
  std::string text;
  for_each_row(run, [&](const SceneResult& scene, const ThreadResult& threads, std::size_t setting) {
    const std::vector<Column> columns = columns_of(scene, threads, setting);
    const auto append_line = [&](const auto& field) {
      for (const Column& column : columns)
        text.append(&column == columns.data() ? "" : ",").append(field(column));
      text += "\n";
    };
    if (text.empty()) append_line([](const Column& column) { return column.name; });
    append_line([](const Column& column) { return column.text; });
  });
  return text;
}

Json results_json(const RunResult& run) {
  Json json{{"date", run.date},
            {"machine", run.machine},
            {"instruction_set", run.instruction_set},
            {"quick", run.is_quick},
            {"rounds", run.rounds},
            {"processes", run.processes},
            {"cycles_from",
             run.has_counters ? "hardware counters" : "processor time and the clock of 100,000 additions"},
            {"involuntary_context_switches", run.disturbance.involuntary_switches},
            {"stolen_ms", run.disturbance.stolen_ms},
            {"scenes", Json::array()},
            {"rows", Json::array()}};
  for (const SceneResult& scene : run.scenes) json["scenes"].push_back(scene_json(scene));
  for_each_row(run, [&](const SceneResult& scene, const ThreadResult& threads, std::size_t setting) {
    Json& row = json["rows"].emplace_back(Json::object());
    for (const Column& column : columns_of(scene, threads, setting)) row[column.name] = column.text;
    row["difference_gain_point"] =
        amplified_difference(scene.settings[setting].picture, scene.references.point.stored).gain;
    row["difference_gain_area"] =
        amplified_difference(scene.settings[setting].picture, scene.references.area.stored).gain;
  });
  return json;
}

AmplifiedDifference amplified_difference(const program::Picture& result, const program::Picture& reference) {
  AmplifiedDifference difference{program::Picture(result.width, result.height)};
  std::vector<std::uint8_t>& rgba = difference.picture.rgba;
  int largest = 0;
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    const int error = i % 4 == 3 ? 0 : std::abs(result.rgba[i] - reference.rgba[i]);
    largest = std::max(largest, error);
    rgba[i] = static_cast<std::uint8_t>(error);
  }
  constexpr int kMaxGain = 64;
  while (difference.gain < kMaxGain && 2 * difference.gain * largest <= 255) difference.gain *= 2;
  for (std::size_t i = 0; i < rgba.size(); ++i)
    rgba[i] = i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(rgba[i] * difference.gain);
  return difference;
}

void write_pictures(const RunResult& run, const std::string& folder, int threads,
                    const std::function<bool(double)>& progress) {
  for (const SceneResult& scene : run.scenes)
    std::filesystem::create_directories(folder + "/pictures/" + scene.name);
  const std::vector<PictureTask> tasks = picture_tasks(run);
  std::mutex mutex;
  std::size_t done = 0;
  const auto write = [&](int number) {
    write_picture_of(tasks[static_cast<std::size_t>(number)], folder);
    const std::lock_guard lock(mutex);
    if (!progress(static_cast<double>(++done) / static_cast<double>(tasks.size())))
      throw Cancelled("interrupted");
  };
  program::parallel_for(static_cast<int>(tasks.size()), threads, [&] { return write; });
}

}  // namespace tessera::accuracy
