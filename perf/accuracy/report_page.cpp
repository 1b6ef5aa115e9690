#include "perf/accuracy/report_page.h"

#include <cmath>
#include <iterator>
#include <map>
#include <mutex>

#include "engine/program/threads/parallel_for.h"
#include "perf/accuracy/png_bytes.h"
#include "perf/accuracy/report_files.h"
#include "perf/accuracy/result_files.h"
#include "perf/bench/text.h"

namespace tessera::accuracy {
namespace {

using bench::formatted;
using Json = nlohmann::ordered_json;

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

/// JSON inside a script element: a "<" in a text could end the element.
std::string script_json(const Json& json) {
  std::string result;
  for (const char c : json.dump())
    if (c == '<') result += "\\u003c";
    else result += c;
  return result;
}

/// Replaces each {{key}} of a template. Values are not searched for keys.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& values) {
  std::string result;
  while (true) {
    const std::size_t begin = page.find("{{");
    if (begin == std::string_view::npos) return result.append(page);
    const std::size_t end = page.find("}}", begin);
    result.append(page.substr(0, begin)).append(values.find(page.substr(begin + 2, end - begin - 2))->second);
    page.remove_prefix(end + 2);
  }
}

/// (a - b) modulo 256 for red, green and blue.
program::Picture wrapped_difference(const program::Picture& a, const program::Picture& b) {
  program::Picture result(a.width, a.height);
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    result.rgba[i] = static_cast<std::uint8_t>(a.rgba[i] - b.rgba[i]);
  return result;
}

/// A picture of the page.
struct PageImage {
  std::size_t scene;
  std::string name;
  const program::Picture* picture;
  const program::Picture* base = nullptr;  ///< absent: not stored as a difference
};

/// The smaller one of the picture and, after a "~", the difference.
std::string image_text(const PageImage& image) {
  const std::string whole = png_bytes(*image.picture, PngEffort::small);
  if (image.base == nullptr) return base64(whole);
  const std::string difference = png_bytes(wrapped_difference(*image.picture, *image.base), PngEffort::small);
  return difference.size() < whole.size() ? "~" + base64(difference) : base64(whole);
}

Json page_images(const RunResult& run, int threads, const std::function<bool(double)>& progress) {
  std::vector<PageImage> images;
  for (std::size_t s = 0; s < run.scenes.size(); ++s) {
    const SceneResult& scene = run.scenes[s];
    for (const JudgedBy& judge : {kPointReference, kAreaReference})
      images.push_back(
          {s, std::string("reference_") + judge.name, &(scene.references.*judge.picture).stored});
    const program::Picture& base = scene.settings.front().picture;
    for (const SettingResult& result : scene.settings)
      images.push_back(
          {s, result.setting.name, &result.picture, &result == &scene.settings.front() ? nullptr : &base});
  }
  std::vector<std::string> texts(images.size());
  std::mutex mutex;
  std::size_t done = 0;
  const auto encode = [&](int number) {
    const auto index = static_cast<std::size_t>(number);
    const PageImage& image = images[index];
    texts[index] = image_text(image);
    const std::lock_guard lock(mutex);
    if (!progress(static_cast<double>(++done) / static_cast<double>(images.size())))
      throw Cancelled("interrupted");
  };
  program::parallel_for(static_cast<int>(images.size()), threads, [&] { return encode; });
  Json json = Json::object();
  for (std::size_t i = 0; i < images.size(); ++i)
    json[run.scenes[images[i].scene].name][images[i].name] = texts[i];
  return json;
}

/// A column of the table: heading, and the text of a row.
struct TableColumn {
  const char* heading;
  const char* hint;
};
constexpr TableColumn kTableColumns[] = {
    {"scene", "scene"},
    {"setting", "setting"},
    {"threads", "threads of the renderer"},
    {"time", "median over the rounds of time / mean of the round's two defaults"},
    {"interval", "ranks that hold the true median with about 97 %"},
    {"processes", "smallest and largest median of a single process"},
    {"ms", "median time of a frame"},
    {"CPU ms", "processor time of all threads, median"},
    {"Mcycles", "cycles of all threads, median, millions"},
    {"front", "on the Pareto front of RMS and time against one sample (1) or 16x16 samples (16)"}};
constexpr TableColumn kErrorColumns[] = {{"RMS", "against unrounded colours, levels"},
                                         {"largest", "levels"},
                                         {"PSNR", "dB"},
                                         {"> 1", "percent of pixels more than one level off"},
                                         {"> 2", "percent of pixels more than two levels off"},
                                         {"FLIP", "mean"},
                                         {"FLIP 99 %", "99th percentile"}};

std::string error_cells(const SettingErrors& errors) {
  const auto cell = [](const std::string& text) { return "<td>" + text + "</td>"; };
  return cell(formatted("%.4f", errors.unrounded_rms)) + cell(formatted("%d", errors.largest)) +
         cell(std::isinf(errors.psnr_db) ? "inf" : formatted("%.2f", errors.psnr_db)) +
         cell(formatted("%.2f", 100 * errors.share_over_1)) +
         cell(formatted("%.2f", 100 * errors.share_over_2)) + cell(formatted("%.4f", errors.flip_mean)) +
         cell(formatted("%.3f", errors.flip_percentile_99));
}

std::string table_row(const SceneResult& scene, const ThreadResult& threads, std::size_t k) {
  const SettingResult& result = scene.settings[k];
  const TimeFigures& times = threads.times[k];
  const bool on_point = threads.dominated_by_point[k] == k, on_area = threads.dominated_by_area[k] == k;
  const std::string front =
      std::string(on_point ? "1" : "") + (on_point && on_area ? " " : "") + (on_area ? "16" : "");
  const std::string apart =
      threads.differs_in_time(k) ? "" : " class=\"same\" title=\"not told apart from the default\"";
  const auto ranges = [](double median, double low, double high) {
    return formatted("<td data-value=\"%.4f\">%.3f to %.3f</td>", median, low, high);
  };
  return "<tr data-scene=\"" + scene.name + "\" data-setting=\"" + result.setting.name + "\"><td>" +
         scene.name + "</td><td title=\"" + escaped(result.setting.text) + "\">" + result.setting.name +
         "</td>" +
         formatted("<td>%d</td><td%s>%.4f</td>", threads.threads, apart.c_str(), times.ratio.median) +
         ranges(times.ratio.high - times.ratio.low, times.ratio.low, times.ratio.high) +
         ranges(times.process_high - times.process_low, times.process_low, times.process_high) +
         formatted("<td>%.3f</td><td>%.3f</td><td>%.3f</td><td>%s</td>", times.ms.median, times.cpu_ms,
                   times.million_cycles, front.c_str()) +
         error_cells(result.errors.point) + error_cells(result.errors.area) + "</tr>\n";
}

std::string table(const RunResult& run) {
  constexpr int kErrors = std::size(kErrorColumns);
  std::string text = "<table id=\"table\"><thead><tr><th></th><th></th>" +
                     formatted("<th colspan=\"%d\">time, relative to the default and absolute</th>",
                               static_cast<int>(std::size(kTableColumns)) - 2) +
                     formatted(
                         "<th colspan=\"%d\">errors against one sample per pixel</th><th "
                         "colspan=\"%d\">errors against 16×16 samples per pixel</th>",
                         kErrors, kErrors) +
                     "</tr>\n<tr>";
  int number = 0;
  const auto add = [&](const TableColumn& column) {
    text += formatted("<th data-column=\"%d\" title=\"%s\" scope=\"col\">%s</th>", number++, column.hint,
                      escaped(column.heading).c_str());
  };
  for (const TableColumn& column : kTableColumns) add(column);
  for (int reference = 0; reference < 2; ++reference)
    for (const TableColumn& column : kErrorColumns) add(column);
  text += "</tr></thead>\n<tbody>\n";
  for (const SceneResult& scene : run.scenes)
    for (const ThreadResult& threads : scene.threads)
      for (std::size_t k = 0; k < scene.settings.size(); ++k) text += table_row(scene, threads, k);
  return text + "</tbody></table>";
}

/// Why the default is off a front, for readers without scripts, too.
std::string off_front_list(const RunResult& run) {
  std::string text;
  for (const SceneResult& scene : run.scenes)
    for (const ThreadResult& threads : scene.threads)
      for (const JudgedBy& judge : {kPointReference, kAreaReference})
        if (const std::string reason = reason_off_front(scene, threads, judge); !reason.empty())
          text += formatted("<li><b>%s</b>, %d thread%s, against %s per pixel: ", scene.name.c_str(),
                            threads.threads, threads.threads == 1 ? "" : "s",
                            judge.name == std::string_view("area") ? "16×16 samples" : "one sample") +
                  escaped(reason) + "</li>\n";
  return text.empty() ? "<p>The default is on every front.</p>" : "<ul>" + text + "</ul>";
}

std::string rounding_list(const RunResult& run) {
  std::string text;
  for (const SceneResult& scene : run.scenes)
    text += formatted("%s%s %.3f", text.empty() ? "" : ", ", scene.name.c_str(), scene.point_rounding_rms);
  return text;
}

std::string notes(const RunResult& run) {
  double low = 1, high = 1;
  for (const SceneResult& scene : run.scenes)
    for (const ThreadResult& threads : scene.threads) {
      low = std::min(low, threads.times.front().ratio.low);
      high = std::max(high, threads.times.front().ratio.high);
    }
  return "<ul>\n<li><b>Errors</b> are in levels of 8 bits, against a reference renderer in double precision "
         "that shares no code with Tessera. "
         "RMS errors are against its <i>unrounded</i> colours, the others against its picture of 8 bits. "
         "Rounding alone is 1/√12 = 0.289 levels RMS where colours vary "
         "smoothly; no picture of 8 bits can be better. In these scenes the reference's own rounded pictures "
         "have: " +
         rounding_list(run) +
         ".</li>\n"
         "<li><b>References.</b> One sample per pixel, at its centre, is what the default is asked for: "
         "shading, interpolation, depth and colours are judged by it. "
         "The mean of 16×16 samples per pixel is what an ideal anti-aliased picture shows: samples, jittered "
         "passes and resolution are judged by it.</li>\n" +
         formatted(
             "<li><b>Times.</b> Settings take turns, one frame each, in a random order in each of %d rounds "
             "in %d processes; the default opens and closes each round. "
             "A time is the median over the rounds of time / mean of the round's two defaults, with the "
             "interval of ranks around it. Frames below 2 ms are repeated "
             "within their turn. Lower resolutions include the enlargement.</li>\n",
             run.rounds, run.processes) +
         formatted(
             "<li><b>Noise.</b> The default also takes a turn as a setting; its row is the noise. Over all "
             "scenes its intervals lie within %.3f to %.3f. Times whose interval "
             "overlaps that row are <i>not told apart</i> from the default. While times were measured, the "
             "system interrupted the processes %lld times, and %.0f ms were "
             "stolen from the machine; nothing was dropped.</li>\n",
             low, high, static_cast<long long>(run.disturbance.involuntary_switches),
             run.disturbance.stolen_ms) +
         "<li><b>Cycles</b> are those of all threads: " +
         (run.has_counters ? "from hardware counters"
                           : "processor time times the clock, which a chain of 100,000 dependent additions "
                             "gives before each turn") +
         ".</li>\n"
         "<li><b>Pareto front.</b> A point is off the front only if another has no larger error and its "
         "interval lies wholly below.</li>\n"
         "<li><b>FLIP</b> [Andersson and others, HPG 2020] estimates the difference that a viewer sees when "
         "the two pictures alternate, at 67 pixels per degree.</li>\n"
         "<li><b>Charts and pictures</b> are drawn by <a href=\"https://observablehq.com/plot/\">Observable "
         "Plot</a> and <a href=\"https://d3js.org\">D3</a> (ISC licence), which this page "
         "contains.</li>\n</ul>\n"
         "<h3>Where the default is off a front</h3>\n" +
         off_front_list(run);
}

std::string summary(const RunResult& run) {
  std::size_t settings = 0;
  for (const SceneResult& scene : run.scenes) settings += scene.settings.size();
  std::string threads;
  for (const ThreadResult& result : run.scenes.front().threads)
    threads += (threads.empty() ? "" : " and ") + std::to_string(result.threads);
  return formatted("%s UTC · %zu scenes, %zu pictures · %s thread%s · %s · %d rounds%s", run.date.c_str(),
                   run.scenes.size(), settings, threads.c_str(), threads == "1" ? "" : "s",
                   run.instruction_set.c_str(), run.rounds, run.is_quick ? " (--quick)" : "");
}

}  // namespace

std::string report_page(const RunResult& run, int threads, const std::function<bool(double)>& progress) {
  return filled(kReportPage, {{"style", std::string(kReportStyle)},
                              {"summary", escaped(summary(run))},
                              {"machine", escaped(run.machine)},
                              {"table", table(run)},
                              {"notes", notes(run)},
                              {"rows", results_csv(run)},
                              {"scenes", script_json(results_json(run)["scenes"])},
                              {"pictures", script_json(page_images(run, threads, progress))},
                              {"d3", std::string(kD3Script)},
                              {"plot", std::string(kPlotScript)},
                              {"script", std::string(kReportScript)}});
}

}  // namespace tessera::accuracy
