// Pictures on a simulated screen.
#pragma once

#include <string>
#include <vector>

#include "engine/program/cli/close_up.h"
#include "engine/program/cli/display_request.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/threads/loop_workers.h"
#include "engine/tessera/display_mode.hpp"

namespace tessera::program::cli {

/// Size and timing of a mode.
/// @throws Error for a mode of character cells
VideoMode video_mode(const DisplayMode& mode);

/// Shows pictures on a display, in order, and writes the images of its screen.
class ShownPictures {
 public:
  /// @param path     file of the images; .pfm receives linear light, all else sRGB
  /// @param threads  1 or more; 0: available_cores()
  /// @throws DisplayError for values that do not fit together, such as a part beyond the screen
  ShownPictures(const DisplayRequest& request, const VideoMode& mode, const std::string& path, int threads,
                InstructionSet instruction_set = InstructionSet::automatic);
  ShownPictures(const ShownPictures&) = delete;
  ShownPictures& operator=(const ShownPictures&) = delete;

  /// Prints what a user should know about the view, on stderr.
  void print_notes() const;
  /// Shows the next picture.
  void show(const Picture& picture);
  /// The image of the picture that was shown last.
  const Picture& image() const { return image_; }
  /// Its light, r g b per pixel; empty unless the file receives it.
  const std::vector<float>& light() const { return light_; }
  /// Writes that image, for .pfm its light.
  void write(const std::string& path, int compression) const;
  /// Mean light of a white picture in the image; see Screen::white_level().
  double white_level() const { return screen_.white_level(); }
  ScreenSize size() const { return {screen_.width_mm(), screen_.height_mm()}; }
  /// Time of the next picture.
  double next_ms() const { return start_ms_ + shown_ * frame_ms_; }

 private:
  LoopWorkers workers_;
  Screen screen_;
  double start_ms_, frame_ms_;
  int shown_ = 0;  ///< pictures
  Picture image_;
  std::vector<float> light_;  ///< empty unless it is written
};

}  // namespace tessera::program::cli
