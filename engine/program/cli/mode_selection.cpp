#include "engine/program/cli/mode_selection.h"

#include <algorithm>
#include <sstream>

#include "engine/program/compare/flip.h"
#include "engine/program/scene/dither_names.h"
#include "engine/program/scene/scene_mode.h"

namespace tessera::program::cli {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text.empty() || text.ends_with(',') ? text + "," : text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

/// "intensity=low" continues the parameters of the mode before it.
bool is_parameter(const std::string& part) { return part.find('=') < part.find(':'); }

bool same_color(const Color& a, const Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

bool same_aspect(AspectRatio a, AspectRatio b) {
  return a.numerator == b.numerator && a.denominator == b.denominator;
}

bool same_picture(const DisplayMode& a, const DisplayMode& b) {
  const bool same_shape =
      a.width == b.width && a.height == b.height && same_aspect(a.pixel_aspect, b.pixel_aspect);
  const bool same_bits = a.color_mode == b.color_mode && a.color_bits == b.color_bits;
  return same_shape && same_bits && a.palette_component_bits == b.palette_component_bits &&
         std::ranges::equal(a.palette, b.palette, same_color);
}

}  // namespace

bool has_pixels(const DisplayMode& mode) { return mode.layout != MemoryLayout::character_cells; }

std::vector<DisplayMode> modes_with_pixels() {
  std::vector<DisplayMode> modes;
  std::ranges::copy_if(display_modes(), std::back_inserter(modes), has_pixels);
  return modes;
}

std::vector<DisplayMode> parse_modes(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string& part : split(text)) {
    if (is_parameter(part) && !names.empty()) names.back() += "," + part;
    else names.push_back(part);
  }
  std::vector<DisplayMode> modes;
  for (const std::string& name : names) {
    modes.push_back(named_display_mode(name));
    if (!has_pixels(modes.back()))
      throw Error("mode \"" + name + "\" has character cells, expected modes with pixels");
  }
  return modes;
}

std::vector<Dither> parse_dithers(const std::string& text) {
  std::vector<Dither> dithers;
  for (const std::string& name : split(text)) {
    const Dither dither = named_dither(name);
    if (std::ranges::find(dithers, dither) == dithers.end()) dithers.push_back(dither);
  }
  return dithers;
}

std::vector<Dither> all_dithers() {
  std::vector<Dither> dithers;
  for (const auto& [name, dither] : kDithers) dithers.push_back(dither);
  return dithers;
}

std::vector<ModeGroup> grouped(std::span<const DisplayMode> modes) {
  std::vector<ModeGroup> groups;
  for (const DisplayMode& mode : modes) {
    const auto group = std::ranges::find_if(groups, [&](const ModeGroup& other) {
      return same_picture(other.mode, mode) && memory_bytes(other.mode) == memory_bytes(mode);
    });
    if (group == groups.end()) groups.push_back({.mode = mode, .names = {mode.name}});
    else if (std::ranges::find(group->names, mode.name) == group->names.end())
      group->names.push_back(mode.name);
  }
  return groups;
}

std::string names_of(const ModeGroup& group) {
  std::string text;
  for (const std::string& name : group.names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

double own_pixels_per_degree(const DisplayMode& mode) {
  constexpr double kScreenWidth = 14 * 25.4 * 0.8, kScreenHeight = 14 * 25.4 * 0.6;  // mm
  constexpr double kDistance = 500;                                                  // mm
  constexpr double kTanDegree = 0.017455064928217585;                                // tan(1 degree)
  const double picture_width = std::min(kScreenWidth, kScreenHeight * mode.screen_aspect());
  return std::max(kDistance * kTanDegree / (picture_width / mode.width), kMinPixelsPerDegree);
}

}  // namespace tessera::program::cli
