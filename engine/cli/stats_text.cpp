#include "engine/cli/stats_text.h"

#include <cstdio>
#include <utility>

namespace tessera::cli {
namespace {

// 1234567 as 1,234,567.
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string row(const char* label, const std::string& value) {
  char line[160];
  std::snprintf(line, sizeof line, "  %-34s %14s\n", label, value.c_str());
  return line;
}

std::string milliseconds(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f ms", ms);
  return text;
}

}  // namespace

std::string stats_text(const FrameStats& stats, const RendererOptions& options, const Times& times) {
  std::string text = "rendered with " + std::to_string(options.threads) + (options.threads == 1 ? " thread, " : " threads, ") +
                     std::string(name(options.instruction_set)) +
                     (stats.tile_size > 0 ? ", tiles of " + std::to_string(stats.tile_size) + " pixels\n" : "\n");
  text += row("reading and setting up", milliseconds(times.load_ms));
  text += row("rendering", milliseconds(times.render_ms));
  text += row("writing files", milliseconds(times.write_ms));
  const std::pair<const char*, std::uint64_t> counts[] = {
      {"vertices", stats.vertices},
      {"triangles", stats.triangles_in},
      {"  dropped: not finite", stats.dropped_non_finite},
      {"  dropped: outside", stats.outside},
      {"  dropped: culled by facing", stats.culled},
      {"  dropped: no area", stats.zero_area},
      {"  clipped", stats.clipped},
      {"  drawn (pieces counted singly)", stats.binned},
      {"triangles summed over tiles", stats.bin_entries},
      {"tiles", stats.tiles},
      {"tiles touched", stats.tiles_touched},
      {"pixels shaded", stats.shaded_pixels},
  };
  for (const auto& [label, count] : counts) text += row(label, grouped(count));
  return text;
}

}  // namespace tessera::cli
