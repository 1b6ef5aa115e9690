#include "engine/program/cli/stats_text.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>

namespace tessera::program::cli {
namespace {

// Formats 1234567 as 1,234,567.
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string row(const std::string& label, const std::string& value) {
  char line[160];
  std::snprintf(line, sizeof line, "  %-34s %16s\n", label.c_str(), value.c_str());
  return line;
}

std::string milliseconds(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f ms", ms);
  return text;
}

struct Count {
  const char* label;
  const char* key;
  std::uint64_t value;
};
std::vector<Count> counts_of(const FrameStats& s) {
  return {{"vertices", "vertices", s.vertices},
          {"triangles", "triangles_in", s.triangles_in},
          {"  dropped: not finite", "dropped_non_finite", s.dropped_non_finite},
          {"  dropped: trivially rejected", "trivially_rejected", s.trivially_rejected},
          {"  dropped: culled by facing", "culled", s.culled},
          {"  dropped: no area", "zero_area", s.zero_area},
          {"  clipped", "clipped", s.clipped},
          {"  binned, with derived primitives", "binned", s.binned},
          {"triangles, summed over tiles", "bin_entries", s.bin_entries},
          {"binning passes", "bin_passes", s.bin_passes},
          {"tiles", "tiles", s.tiles},
          {"tiles rendered", "tiles_rendered", s.tiles_rendered},
          {"tiles touched", "tiles_touched", s.tiles_touched},
          {"fragments", "fragments", s.fragments},
          {"pixels shaded", "shaded_pixels", s.shaded_pixels},
          {"triangles hidden, summed over tiles", "hidden_triangles", s.hidden_triangles}};
}
std::vector<std::pair<const char*, double>> stages_of(const FrameStats& s) {
  return {{"planning", s.plan_seconds},
          {"vertices", s.vertex_seconds},
          {"binning", s.binning_seconds},
          {"tiles", s.tile_seconds}};
}
constexpr const char* kBufferNames[] = {"colour", "depth", "stencil", "accumulation"};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

std::string stats_text(const RunStats& stats) {
  const int threads = stats.options.threads;
  std::string text = "rendered with " + std::to_string(threads) +
                     (threads == 1 ? " thread, " : " threads, ") +
                     std::string(name(stats.options.instruction_set)) + ", tiles of " +
                     std::to_string(stats.frame.tile_size) + " pixels\n";
  text += row("loading", milliseconds(stats.load_ms));
  const auto [fastest, slowest] = std::minmax_element(stats.render_ms.begin(), stats.render_ms.end());
  if (stats.render_ms.size() == 1) {
    text += row("rendering", milliseconds(*fastest));
  } else {
    text += row("rendering, median of " + std::to_string(stats.render_ms.size()),
                milliseconds(median(stats.render_ms)));
    text += row("  fastest", milliseconds(*fastest)) + row("  slowest", milliseconds(*slowest));
  }
  for (const auto& [stage, seconds] : stages_of(stats.frame))
    text += row(std::string("  ") + stage + (stats.render_ms.size() > 1 ? ", last rendering" : ""),
                milliseconds(1e3 * seconds));
  text += row("writing files", milliseconds(stats.write_ms));
  for (const Count& count : counts_of(stats.frame)) text += row(count.label, grouped(count.value));
  for (std::size_t i = 0; i < stats.buffer_bytes.size(); ++i)
    text += row(std::string("bytes of ") + kBufferNames[i] + " planes", grouped(stats.buffer_bytes[i]));
  return text;
}

std::string stats_json(const RunStats& stats) {
  nlohmann::ordered_json json;
  json["threads"] = stats.options.threads;
  json["instruction_set"] = std::string(name(stats.options.instruction_set));
  json["tile_size"] = stats.frame.tile_size;
  json["load_ms"] = stats.load_ms;
  json["render_ms"] = stats.render_ms;
  json["render_ms_median"] = median(stats.render_ms);
  for (const auto& [stage, seconds] : stages_of(stats.frame)) json["stages_ms"][stage] = 1e3 * seconds;
  json["write_ms"] = stats.write_ms;
  for (const Count& count : counts_of(stats.frame)) json["counts"][count.key] = count.value;
  constexpr const char* kKeys[] = {"color", "depth", "stencil", "accumulation"};
  for (std::size_t i = 0; i < stats.buffer_bytes.size(); ++i)
    json["buffer_bytes"][kKeys[i]] = stats.buffer_bytes[i];
  return json.dump(2) + "\n";
}

}  // namespace tessera::program::cli
