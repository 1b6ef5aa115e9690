// Draws scenes in display modes, for their comparison.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "engine/program/cli/scene_input.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

/// A scene or a model, read once per shape of the screen: a model is framed for that shape.
class ModeScenes {
 public:
  /// @param input  empty: the built-in scene
  explicit ModeScenes(std::string input, const ImportRequest& import = {})
      : input_(std::move(input)), import_(import) {}
  /// Returns the scene in a mode, with an adaptive palette if the mode's can be chosen. Prints its warnings
  /// on stderr when it is read first.
  /// @throws Error for a file that cannot be read
  Scene in_mode(const DisplayMode& mode, Dither dither, DitherSpace dither_in);

 private:
  std::string input_;
  ImportRequest import_;
  std::map<double, Scene> scenes_;  ///< by width to height of the screen
};

/// A picture in a display mode, and what it took.
struct ModePicture {
  Picture picture;                        ///< as the display shows it
  std::optional<IndexedPicture> indexed;  ///< the same, if it has few bits per pixel
  bool reduced = false;                   ///< drawn at 24 bits and then reduced to the mode's colours
  std::size_t buffer_bytes = 0;           ///< FrameBuffer::memory_bytes() of all frame buffers
  double frame_ms = 0;  ///< median of several frames, recording and reduction included; 0: none
};

/// Whether draw_in_mode() draws further frames to time them.
enum class FrameTimes { measured, none };

/// Draws a scene in its mode. A palette is chosen before, unless the scene stores indices. Scenes that an
/// index buffer refuses, because they blend for example, are reduced.
/// @throws Error      if the scene cannot be drawn either way
/// @throws Cancelled  if the renderer's progress callback stops it
ModePicture draw_in_mode(Scene scene, Renderer& renderer, FrameTimes times = FrameTimes::measured);

/// The same picture at 24 bits, without dither, to compare with.
DisplayMode reference_mode(const DisplayMode& mode);

}  // namespace tessera::program::cli
