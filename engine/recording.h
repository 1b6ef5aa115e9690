// What a frame has recorded.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "engine/frame_buffer_state.h"
#include "engine/tessera.hpp"

namespace tessera {

/// Camera, lights and light model as they were when a draw was recorded; shared by the draws between two changes.
struct Surroundings {
  Camera camera;
  std::vector<Light> lights{Light{}};
  LightModel light_model;
};

struct RecordedDraw {
  Mesh mesh;
  DrawState state;
  std::shared_ptr<const Surroundings> surroundings;
};
struct RecordedClear {
  Clear clear;
  std::size_t before_draw = 0;
};

struct FrameRecording {
  FrameBufferState* target = nullptr;
  std::shared_ptr<const Surroundings> surroundings = std::make_shared<Surroundings>();
  std::vector<RecordedDraw> draws;
  std::vector<RecordedClear> clears;
  std::optional<std::vector<Buffer>> keep;
};

inline std::size_t vertex_count(const Mesh& mesh) { return mesh.positions.size() / static_cast<std::size_t>(mesh.position_components); }
inline std::size_t triangle_count(const Mesh& mesh) { return (mesh.indices.empty() ? vertex_count(mesh) : mesh.indices.size()) / 3; }

}  // namespace tessera
