// What a frame has recorded.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "engine/frame_buffer_state.h"
#include "engine/mesh_arrays.h"
#include "engine/texture_state.h"
#include "raster/pixel_rectangle.h"

namespace tessera {

/// Camera, lights and light model as they were when a draw was recorded; shared by the draws between two changes.
struct Surroundings {
  Camera camera;
  std::vector<Light> lights{Light{}};
  LightModel light_model;
};

/// A bitmap or an image.
struct RecordedPixels {
  PixelRectangle texels;
  double depth = 0;
  Color color;                             ///< of a bitmap
};

struct RecordedDraw {
  MeshArrays mesh;
  DrawState state;
  std::shared_ptr<const Surroundings> surroundings;
  const TextureState* texture = nullptr;  ///< of the state's, wherever that moves
  std::optional<RecordedPixels> pixels{};  ///< in place of the mesh, which is empty then
};
struct RecordedClear {
  Clear clear;
  std::size_t before_draw = 0;
};

struct RecordedAccum {
  Accum accum;
  std::size_t before_draw = 0, after_clears = 0;
};

struct FrameRecording {
  FrameBufferState* target = nullptr;
  std::shared_ptr<const Surroundings> surroundings = std::make_shared<Surroundings>();
  std::vector<RecordedDraw> draws;
  std::vector<RecordedClear> clears;
  std::vector<RecordedAccum> accums;
  std::optional<std::vector<Buffer>> keep;
  Capture capture;

  /// Camera, lights and light model stay.
  void clear() noexcept {
    draws.clear();
    clears.clear();
    accums.clear();
    keep.reset();
    capture = {};
  }
};

}  // namespace tessera
