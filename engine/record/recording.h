// What a frame has recorded.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/record/mesh_arrays.h"
#include "engine/record/texture_state.h"
#include "raster/pixel_rectangle.h"

namespace tessera::detail {

class WorkerPool;

/// Camera, lights and light model as they were when a draw was recorded.
struct SceneState {
  Camera camera;
  std::vector<Light> lights{Light{}};
  LightModel light_model;
};

/// A bitmap or an image.
struct RecordedPixels {
  PixelRectangle rectangle;
  double depth = 0;
  Color color;  ///< of a bitmap
};

struct RecordedDraw {
  MeshArrays mesh;
  DrawState state;
  const SceneState* scene_state = nullptr;  ///< the draws' between two changes
  const TextureState* texture = nullptr;    ///< of the state's, wherever that moves
  std::optional<RecordedPixels> pixels{};   ///< in place of the mesh, which is empty then
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
  WorkerPool* workers = nullptr;  ///< of a renderer that helps to record, if there is one
  std::vector<RecordedDraw> draws;
  std::vector<RecordedClear> clears;
  std::vector<RecordedAccum> accumulations;
  bool has_keep_list = false;  ///< else by what the frame changes
  std::array<bool, 4> kept{};  ///< if it is chosen: of each Buffer
  Capture capture;

  /// Of what is drawn next.
  const SceneState& scene_state() const { return scene_states_[last_scene_state_]; }
  /// The same, to be changed: what is recorded already keeps its own. Throws std::bad_alloc.
  SceneState& mutable_scene_state() {
    if (draws.empty() || draws.back().scene_state != &scene_state()) return scene_states_[last_scene_state_];
    if (last_scene_state_ + 1 == scene_states_.size()) scene_states_.emplace_back();
    scene_states_[last_scene_state_ + 1] = scene_states_[last_scene_state_];
    return scene_states_[++last_scene_state_];
  }
  /// Camera, lights and light model stay, and so does the memory.
  void clear() noexcept {
    draws.clear();
    clears.clear();
    accumulations.clear();
    std::swap(scene_states_.front(), scene_states_[last_scene_state_]);
    last_scene_state_ = 0;
    has_keep_list = false;
    capture = {};
  }

 private:
  std::deque<SceneState> scene_states_{1};  // from one change to the next; they stay where they are
  std::size_t last_scene_state_ = 0;
};

}  // namespace tessera::detail
