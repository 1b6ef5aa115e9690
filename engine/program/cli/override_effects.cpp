#include "engine/program/cli/override_effects.h"

#include <algorithm>
#include <variant>

#include "engine/program/scene/chosen_palette.h"

namespace tessera::program::cli {
namespace {

/// Returns whether any draw of the scene fulfils `condition`.
template <class Condition>
bool has_draw(const Scene& scene, const Condition& condition) {
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.value);
        draw != nullptr && condition(draw->state))
      return true;
  if (!scene.blended) return false;
  return std::ranges::any_of(scene.blended->draws,
                             [&](const DrawCommand& draw) { return condition(draw.state); });
}

/// Refuses a palette for commands that palette indices exclude, such as blending.
void check_palette(const GivenOptions& given, const Scene& scene) {
  if (!given.has("--palette") && !given.has("--mode")) return;
  try {
    if (scene.palette_source != PaletteSource::given) check_stores_colors(scene);
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
  } catch (const Error& error) {
    throw UsageError(error.code(), error.what());
  }
}

}  // namespace

void check_override_effects(const GivenOptions& given, const SceneInput& input) {
  const Scene& scene = input.scene();
  const bool has_models = input.has_models();
  const bool draws = has_draw(scene, [](const DrawState&) { return true; });
  const bool is_lit = has_draw(scene, [](const DrawState& state) { return state.lighting; });
  const FrameBufferFormat& stored = scene.reduced ? *scene.reduced : scene.framebuffer;
  const bool dithers = stored.dither != Dither::none;
  given.require({
      {"--import-memory", has_models, "limits reading a model, and the scene has none"},
      {"--import-seconds", has_models, "limits reading a model, and the scene has none"},
      {"--up", scene.is_model, "is for models, and the input is a scene"},
      {"--shading", draws, "needs a scene that draws a mesh"},
      {"--wireframe", draws, "needs a scene that draws a mesh"},
      {"--light", is_lit, "needs a draw with lighting, and the scene has none"},
      {"--dither-in", dithers, "needs a dither, and the frame buffer has none; name one with --dither"},
      {"--dither-gamma", dithers, "needs a dither, and the frame buffer has none; name one with --dither"},
      {"--dither-gamma", stored.dither_in == DitherSpace::light, "needs --dither-in light"},
  });
  check_palette(given, scene);
}

}  // namespace tessera::program::cli
