// Measurements of a scene's draws for `tessera explain --measure`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

/// An effect that is left out for some draws, and what these draws take of the frame.
struct LeftOutEffect {
  Effect effect = Effect::draw;
  int light = -1;           ///< number of the light, from 0; -1: not about a light
  bool back_faces = false;  ///< two-sided lighting: about the back faces' material
  std::vector<EffectReason> reasons;
  std::size_t draw_count = 0;
  DrawMeasurement draws;  ///< sum of their measurements
};

struct MeasuredScene {
  int threads = 0;
  InstructionSet instruction_set = InstructionSet::automatic;
  double frame_seconds = 0;  ///< wall time of Renderer::finish
  std::vector<DrawMeasurement> draws;
  DrawMeasurement all_draws;  ///< sum of `draws`
  std::vector<LeftOutEffect> left_out;
};

/// Renders the scene three times: counts the pixels that draws cover, allocates memory, measures times.
/// @param threads  0: all cores
/// @throws Error
MeasuredScene measure(const Scene& scene, int threads);

/// A line about a draw, indented, without its end.
std::string measured_text(const DrawMeasurement& draw);
/// Lines about the frame, and about each effect that is left out.
std::string measured_text(const MeasuredScene& measured);

nlohmann::ordered_json measured_json(const DrawMeasurement& draw);
nlohmann::ordered_json measured_json(const MeasuredScene& measured);

}  // namespace tessera::program::cli
