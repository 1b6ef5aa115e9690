// The settings that `tessera accuracy` measures: how a frame is drawn more cheaply or more smoothly than
// asked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/program/scene/scene.h"
#include "perf/accuracy/scene_list.h"

namespace tessera::accuracy {

/// Changes to what a scene asks for; absent values leave it as it is.
struct Variation {
  Quality quality{};
  std::optional<int> samples{};  ///< per pixel
  int passes = 1;                ///< frames at shifted positions whose mean is the picture: 1, 4, 8 or 16
  int divisor = 1;               ///< divides width and height: 1, 2 or 4; the picture is enlarged bilinearly
  std::optional<DepthFormat> depth{};
  std::optional<int> color_bits{};
  std::optional<Dither> dither{};
};

struct Setting {
  std::string name;   ///< unique; part of file names and links
  std::string label;  ///< short, for points of a chart
  std::string group;  ///< default, dial, samples, jitter, depth, color, resolution or combined
  std::string text;   ///< one line
  Variation variation;
};

inline constexpr const char* kDefaultSetting = "default";

/// The settings that may change the picture or the time of a scene; the first is the default, which changes
/// nothing.
/// - Steps that the scene cannot feel are left out: textures of a scene without any, lower resolution for
///   commands in units of pixels.
std::vector<Setting> settings_for(const program::Scene& scene, SettingChoice choice);

}  // namespace tessera::accuracy
