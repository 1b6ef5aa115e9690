// The picture files of a run: one picture, numbered pictures, or an animation in one file.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/program/cli/output.h"
#include "engine/program/imageio/animated_png.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/imageio/screen_picture.h"
#include "engine/program/threads/task_queue.h"

namespace tessera::program::cli {

inline constexpr int kDefaultDelayMs = 40;

/// Returns whether the pictures become one animated PNG file: several frames, .png, no {frame}.
bool is_animated_png(const std::string& path, int frames);

/// The content of a file. It stays when frame buffers and screens change.
struct FinishedPicture {
  std::shared_ptr<Picture> picture;
  std::optional<IndexedPicture> indexed{};  ///< in its place for PNG
  std::optional<ScreenPicture> one_bit{};   ///< in its place for PBM
  std::vector<float> light{};               ///< in its place for PFM; r g b per pixel
};

/// Encodes and writes pictures in the background, while the next ones are drawn.
/// - At most threads + 1 pictures wait, and no more than take kMaxWaitingBytes, but at least one.
/// - One thread, streams, and formats of the image module: written before add() returns.
/// - Each file is complete or missing. A failure throws from a later add() or from finish().
class PictureOutput {
 public:
  static constexpr std::size_t kMaxWaitingBytes = std::size_t{256} << 20;

  /// @param request  its path is set
  /// @param pixels   of a picture
  /// @throws Error if an animation cannot be created
  PictureOutput(const OutputRequest& request, int frames, int threads, std::size_t pixels);

  /// A picture to draw into and to add. Its memory is that of a written one, if there is any.
  std::shared_ptr<Picture> spare_picture(int width, int height);

  /// @param last_step  called from add() or finish() when the picture is written, in order of the frames
  /// @throws Error
  void add(FinishedPicture picture, int frame, const std::function<void()>& last_step);
  /// Waits until everything is written.
  /// @throws Error
  void finish();

 private:
  void add_to_animation(const std::shared_ptr<const FinishedPicture>& finished,
                        const std::function<void()>& last_step);

  const OutputRequest request_;
  const int frames_;
  std::optional<AnimatedPng> animation_;
  std::vector<std::shared_ptr<Picture>> spare_;  ///< written
  TaskQueue queue_;                              // last: its threads end before the others' lifetime does
};

}  // namespace tessera::program::cli
