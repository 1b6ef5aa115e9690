// The recorded commands of a frame.
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

/// Camera, lights, light model and quality of one or more draws.
struct SceneState {
  Camera camera;
  std::vector<Light> lights{Light{}};
  LightModel light_model;
  Quality quality;
};

/// A bitmap or an image.
struct RecordedPixels {
  PixelRectangle rectangle;
  double depth = 0;
  Color color;  ///< bitmaps only
};

struct RecordedDraw {
  MeshArrays mesh;
  DrawState state;                          ///< with shading as capped
  bool shading_is_capped = false;           ///< the draw asked for a more accurate one than state.shading
  const SceneState* scene_state = nullptr;  ///< shared by the draws between two changes
  const TextureState* texture = nullptr;    ///< state of DrawState::texture; stays when the Texture is moved
  std::optional<RecordedPixels> pixels{};   ///< in place of the mesh, which is then empty
};

struct RecordedClear {
  Clear clear;
  std::size_t before_draw = 0;  ///< number of draws recorded earlier
};

struct RecordedAccum {
  Accum accum;
  std::size_t before_draw = 0;   ///< number of draws recorded earlier
  std::size_t after_clears = 0;  ///< number of clears recorded earlier
};

struct FrameRecording {
  FrameBufferState* target = nullptr;
  WorkerPool* workers = nullptr;  ///< validate large meshes in parallel; may be null
  std::vector<RecordedDraw> draws;
  std::vector<RecordedClear> clears;
  std::vector<RecordedAccum> accumulations;
  bool has_keep_list = false;  ///< Frame::keep() was called
  std::array<bool, 4> kept{};  ///< per Buffer, if has_keep_list
  Capture capture;

  /// State of the next draw.
  const SceneState& scene_state() const { return scene_states_[last_scene_state_]; }
  /// State of the next draw, for modification; recorded draws keep their state. Throws std::bad_alloc.
  SceneState& mutable_scene_state() {
    if (draws.empty() || draws.back().scene_state != &scene_state()) return scene_states_[last_scene_state_];
    if (last_scene_state_ + 1 == scene_states_.size()) scene_states_.emplace_back();
    scene_states_[last_scene_state_ + 1] = scene_states_[last_scene_state_];
    return scene_states_[++last_scene_state_];
  }
  /// Forgets the commands. Camera, lights, light model, quality and memory stay.
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
  std::deque<SceneState> scene_states_{1};  // one per change; a deque keeps addresses
  std::size_t last_scene_state_ = 0;
};

}  // namespace tessera::detail
