// The built-in scenes of `tessera accuracy`, as scene files.
#pragma once

#include <string>
#include <vector>

namespace tessera::accuracy {

/// Settings that a scene is measured with.
enum class SettingChoice {
  all,
  steps,   ///< all but the combinations: for scenes whose frames and references take long
  shading  ///< the default and the steps of the dial that change shading
};

/// A scene as text, which the renderer and the reference parse independently.
struct SceneText {
  std::string name;   ///< letters, digits and hyphens: part of file names and links
  std::string title;  ///< one line for the report
  std::string json;
  std::string folder{};  ///< base of relative paths in the scene
  SettingChoice settings = SettingChoice::all;
  bool in_quick_run = false;
};

/// Pixels per frame of the built-in scenes.
inline constexpr int kSceneWidth = 320, kSceneHeight = 240;

/// Quads per side of the walls.
inline constexpr int kWallQuads[] = {1, 2, 4, 8, 16, 32, 64};

/// Name of the wall with this many quads per side.
std::string wall_name(int quads);

/// All scenes whose files exist, in the order of the report. The scene of a model needs a Debian package.
std::vector<SceneText> scene_list();

}  // namespace tessera::accuracy
