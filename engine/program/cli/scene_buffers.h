// The frame buffers of a scene.
#pragma once

#include <optional>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

/// The frame buffer that is drawn, and one of fewer colours if the picture is reduced.
struct SceneBuffers {
  explicit SceneBuffers(const Scene& scene) : drawn(scene.framebuffer) {
    if (scene.reduced) reduced.emplace(*scene.reduced);
  }
  /// Holds the colours of the picture.
  const FrameBuffer& shown() const { return reduced ? *reduced : drawn; }
  FrameBuffer& shown() { return reduced ? *reduced : drawn; }
  const FrameBuffer& holding(Buffer which) const { return which == Buffer::color ? shown() : drawn; }

  FrameBuffer drawn;
  std::optional<FrameBuffer> reduced;
};

}  // namespace tessera::program::cli
