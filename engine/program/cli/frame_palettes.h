// Chosen palettes of the pictures of an animation.
#pragma once

#include <optional>
#include <vector>

#include "engine/program/cli/scene_input.h"
#include "engine/program/scene/scene.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

/// Returns whether all pictures of an animation have the same number of bits per pixel and the same palette.
/// @param input  moved to the time of each picture
bool frames_share_palette(SceneInput& input, int frames);

/// Chooses a palette for each picture, or one for all.
class FramePalettes {
 public:
  /// Chooses the palette of the whole animation, if there is to be one: all its pictures are drawn at 24
  /// bits, or the colours of all its materials and lights are gathered.
  /// @param input   moved to the time of each picture
  /// @param frames  number of pictures
  FramePalettes(SceneInput& input, int frames, Renderer& renderer);

  /// The palette of the next picture; nothing if the scene's own is to be used.
  std::optional<std::vector<Color>> next(const Scene& scene, Renderer& renderer);

 private:
  std::optional<std::vector<Color>> shared_;  ///< for all pictures
  std::optional<SmoothPalette> smooth_;
};

}  // namespace tessera::program::cli
