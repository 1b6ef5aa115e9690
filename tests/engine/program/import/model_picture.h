// Pictures of model files, drawn as `tessera render` draws them.
#pragma once

#include <array>
#include <string>

#include "engine/program/imageio/picture.h"
#include "engine/program/import/model.h"
#include "engine/program/scene/model_scene.h"

namespace tessera::model_picture {

inline const std::string kModels = TESSERA_SOURCE_DIR "/tests/models/";

inline program::Picture draw(const program::Scene& scene) {
  program::Picture picture(scene.framebuffer.width, scene.framebuffer.height);
  Renderer renderer;
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer, renderer);
  program::record(scene, frame);
  renderer.finish(frame, picture.target());
  return picture;
}

/// Draws a file of tests/models in 240x180 pixels.
inline program::Picture draw_model(const std::string& file) {
  const std::string path = kModels + file;
  return draw(program::model_scene(program::import_model(path, program::ModelUse::display), path, 240, 180));
}

using Pixel = std::array<int, 3>;

inline Pixel pixel(const program::Picture& picture, int x, int y) {
  const std::uint8_t* rgba =
      &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                         static_cast<std::size_t>(x))];
  return {rgba[0], rgba[1], rgba[2]};
}

/// Number of pixels for which a predicate of their colour holds.
template <class Predicate>
int count_pixels(const program::Picture& picture, const Predicate& predicate) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) count += predicate(pixel(picture, x, y)) ? 1 : 0;
  return count;
}

inline constexpr Pixel kBackground{46, 51, 64};

}  // namespace tessera::model_picture
