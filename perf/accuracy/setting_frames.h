// Frames of a scene under one setting.
#pragma once

#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/scene.h"
#include "perf/accuracy/settings.h"

namespace tessera::accuracy {

/// Draws the same frame repeatedly, from recording to the picture in memory, enlarged if need be.
/// - Scene and renderer are the caller's, so that the settings of a scene share its meshes and the threads.
/// - The scene is changed within draw() only.
class SettingFrames {
 public:
  SettingFrames(program::Scene& scene, const Variation& variation, Renderer& renderer);

  void draw();
  /// The picture of the last frame.
  const program::Picture& picture() const { return picture_; }

 private:
  void exchange();

  program::Scene& scene_;
  // The parts of a scene that a variation changes.
  FrameBufferFormat format_;
  Quality quality_;
  std::vector<program::SceneCommand> commands_;
  int divisor_;
  FrameBuffer buffer_;
  Frame frame_;
  Renderer& renderer_;
  program::Picture small_;    // size of the frame buffer; unused without enlarging
  program::Picture picture_;  // size of the scene's frames
};

}  // namespace tessera::accuracy
