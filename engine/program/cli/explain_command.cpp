#include "engine/program/cli/explain_command.h"

#include <iostream>
#include <optional>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/program/cli/measured_scene.h"
#include "engine/program/cli/override_effects.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/scene_input.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kBufferNames[] = {"color", "depth", "stencil", "accumulation"};

/// A draw of the scene, in the order of Frame::effects.
struct NamedDraw {
  const char* kind;  ///< "mesh", "bitmap" or "image"
  std::string name;  ///< the mesh's name; empty for bitmaps and images
};
std::vector<NamedDraw> draws_of(const Scene& scene) {
  std::vector<NamedDraw> draws;
  for (const SceneCommand& command : scene.frame) {
    if (const auto* draw = std::get_if<DrawCommand>(&command.value))
      draws.push_back({"mesh", scene.meshes[draw->mesh].name});
    if (std::holds_alternative<BitmapCommand>(command.value)) draws.push_back({"bitmap", ""});
    if (std::holds_alternative<ImageCommand>(command.value)) draws.push_back({"image", ""});
  }
  return draws;
}

nlohmann::ordered_json json_of(const EffectExplanation& effect) {
  const EffectNote& note = effect.note;
  nlohmann::ordered_json json{{"effect", code(note.effect)},
                              {"active", note.active},
                              {"reason", code(note.reason)},
                              {"cause", effect.cause}};
  if (note.light >= 0) json["light"] = note.light;
  if (note.back_faces) json["back_faces"] = true;
  json["text"] = effect.text;
  return json;
}

/// @param measured  null: not measured
std::string explanation_json(const Scene& scene, const Frame& frame, const MeasuredScene* measured) {
  nlohmann::ordered_json json;
  json["draws"] = nlohmann::ordered_json::array();
  std::size_t index = 0;
  for (const NamedDraw& draw : draws_of(scene)) {
    const DrawExplanation explanation = frame.explanation(index);
    nlohmann::ordered_json entry{{"kind", draw.kind}};
    if (!draw.name.empty()) entry["mesh"] = draw.name;
    entry["effects"] = nlohmann::ordered_json::array();
    for (const EffectExplanation& effect : explanation.effects) entry["effects"].push_back(json_of(effect));
    entry["code_paths"] = explanation.code_paths;
    if (measured != nullptr) entry["measured"] = measured_json(measured->draws[index]);
    json["draws"].push_back(entry);
    ++index;
  }
  json["buffers"] = nlohmann::ordered_json::array();
  for (const BufferNote& note : frame.buffers())
    json["buffers"].push_back({{"buffer", kBufferNames[static_cast<std::size_t>(note.buffer)]},
                               {"in_tiles", note.in_tiles},
                               {"loaded", note.loaded},
                               {"stored", note.stored},
                               {"reason", code(note.reason)},
                               {"text", tessera::text(note)}});
  if (measured != nullptr) json["measured"] = measured_json(*measured);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string explanation_text(const Scene& scene, const Frame& frame, const MeasuredScene* measured) {
  std::string text;
  std::size_t index = 0;
  for (const NamedDraw& draw : draws_of(scene)) {
    const std::string name = draw.name.empty() ? draw.kind : "\"" + draw.name + "\"";
    text += "draw " + std::to_string(index) + ", " + name + ":\n" + frame.explain(index);
    if (measured != nullptr) text += measured_text(measured->draws[index]) + "\n";
    ++index;
  }
  return text;
}

std::string buffers_text(const Frame& frame) {
  std::string text = "buffers:\n";
  for (const BufferNote& note : frame.buffers()) text += "  " + tessera::text(note) + "\n";
  return text;
}

int explain(const ExplainRequest& request) {
  const Interrupt interrupt;
  const SceneInput input(request.input, request.overrides, request.import);
  check_override_effects(request.given, input);
  input.print_warnings();
  FrameBuffer buffer(input.scene().framebuffer);
  Frame frame(buffer);
  record(input.scene(), frame);
  std::optional<MeasuredScene> measured;
  if (request.measure) measured = measure(input.scene(), request.threads);
  const MeasuredScene* const measurements = measured ? &*measured : nullptr;
  if (request.json) {
    std::cout << explanation_json(input.scene(), frame, measurements);
    return 0;
  }
  std::cout << explanation_text(input.scene(), frame, measurements) << buffers_text(frame);
  if (measured) std::cout << measured_text(*measured);
  return 0;
}

}  // namespace tessera::program::cli
