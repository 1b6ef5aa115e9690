// What a frame has recorded.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "engine/frame_buffer_state.h"
#include "engine/mesh_arrays.h"
#include "engine/texture_state.h"
#include "raster/pixel_rectangle.h"

namespace tessera {

class Parallel;

/// Camera, lights and light model as they were when a draw was recorded.
struct Surroundings {
  Camera camera;
  std::vector<Light> lights{Light{}};
  LightModel light_model;
};

/// A bitmap or an image.
struct RecordedPixels {
  PixelRectangle texels;
  double depth = 0;
  Color color;  ///< of a bitmap
};

struct RecordedDraw {
  MeshArrays mesh;
  DrawState state;
  const Surroundings* surroundings = nullptr;  ///< the draws' between two changes
  const TextureState* texture = nullptr;       ///< of the state's, wherever that moves
  std::optional<RecordedPixels> pixels{};      ///< in place of the mesh, which is empty then
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
  Parallel* workers = nullptr;  ///< of a renderer that helps to record, if there is one
  std::vector<RecordedDraw> draws;
  std::vector<RecordedClear> clears;
  std::vector<RecordedAccum> accums;
  bool keeps_chosen = false;   ///< else by what the frame changes
  std::array<bool, 4> kept{};  ///< if it is chosen: of each Buffer
  Capture capture;

  /// Of what is drawn next.
  const Surroundings& surroundings() const { return surroundings_[last_surroundings_]; }
  /// The same, to be changed: what is recorded already keeps its own. Throws std::bad_alloc.
  Surroundings& changeable_surroundings() {
    if (draws.empty() || draws.back().surroundings != &surroundings())
      return surroundings_[last_surroundings_];
    if (last_surroundings_ + 1 == surroundings_.size()) surroundings_.emplace_back();
    surroundings_[last_surroundings_ + 1] = surroundings_[last_surroundings_];
    return surroundings_[++last_surroundings_];
  }
  /// Camera, lights and light model stay, and so does the memory.
  void clear() noexcept {
    draws.clear();
    clears.clear();
    accums.clear();
    std::swap(surroundings_.front(), surroundings_[last_surroundings_]);
    last_surroundings_ = 0;
    keeps_chosen = false;
    capture = {};
  }

 private:
  std::deque<Surroundings> surroundings_{1};  // from one change to the next; they stay where they are
  std::size_t last_surroundings_ = 0;
};

}  // namespace tessera
