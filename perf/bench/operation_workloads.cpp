// The lit teapot of the built-in scene, Phong-shaded, with one fragment operation added per workload.
#include "perf/bench/operation_workloads.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "engine/program/scene/scene.h"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench {
namespace {

constexpr const char* kBaseline = "operation-none";

/// Expected difference from the picture without the operation.
enum class Effect {
  unchanged,            ///< no pixel differs
  changes_picture,      ///< some pixels differ
  moves_intersections,  ///< the same pixels are covered; which surface is nearest may differ
  masks_green           ///< red and blue are equal; green is the clear colour's
};

struct Operation {
  const char* name;
  const char* description;
  Effect effect;
  std::function<void(FrameBufferFormat&, DrawState&)> change;
};

// Material and background are opaque, so the alpha test passes and blending by alpha replaces.
std::vector<Operation> operations() {
  return {
      {"none", "no further operation", Effect::unchanged, [](FrameBufferFormat&, DrawState&) {}},
      {"samples-4", "4 samples per pixel", Effect::changes_picture,
       [](FrameBufferFormat& format, DrawState&) { format.samples = 4; }},
      {"samples-8", "8 samples per pixel", Effect::changes_picture,
       [](FrameBufferFormat& format, DrawState&) { format.samples = 8; }},
      {"alpha-planes", "8 alpha planes", Effect::unchanged,
       [](FrameBufferFormat& format, DrawState&) { format.alpha_bits = 8; }},
      {"alpha-test", "alpha test", Effect::unchanged,
       [](FrameBufferFormat&, DrawState& state) { state.alpha_test = AlphaTest{}; }},
      {"stencil", "stencil test (gequal 1), replaced where it passes", Effect::unchanged,
       [](FrameBufferFormat&, DrawState& state) {
         state.stencil =
             StencilState{.front = {.func = Compare::gequal, .ref = 1, .zpass = StencilOp::replace}};
       }},
      {"offset", "polygon offset, factor 1 and units 1", Effect::moves_intersections,
       [](FrameBufferFormat&, DrawState& state) { state.polygon_offset = {.factor = 1, .units = 1}; }},
      {"blend", "blending by source alpha", Effect::unchanged,
       [](FrameBufferFormat&, DrawState& state) { state.blend = BlendState{}; }},
      {"dither", "ordered dither, 8x8 Bayer matrix", Effect::changes_picture,
       [](FrameBufferFormat& format, DrawState&) { format.dither = Dither::bayer8; }},
      {"xor", "logic operation XOR", Effect::changes_picture,
       [](FrameBufferFormat&, DrawState& state) { state.logic_op = LogicOp::bit_xor; }},
      {"color-mask", "colour mask without green", Effect::masks_green,
       [](FrameBufferFormat&, DrawState& state) {
         state.color_mask = {true, false, true, true};
       }},
  };
}

Scene teapot(int width, int height, const Operation& operation) {
  Scene scene = builtin_scene();
  apply({.width = width, .height = height, .shading = Shading::phong}, scene);
  for (SceneCommand& command : scene.frame)
    if (auto* const draw = std::get_if<DrawCommand>(&command.value))
      operation.change(scene.framebuffer, draw->state);
  return scene;
}

Picture picture_of(const Scene& scene) {
  Picture picture(scene.framebuffer.width, scene.framebuffer.height);
  Renderer renderer;
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  renderer.finish(frame, picture.target());
  return picture;
}

Picture background_picture(Scene scene) {
  std::erase_if(scene.frame, [](const SceneCommand& command) {
    return std::holds_alternative<DrawCommand>(command.value);
  });
  return picture_of(scene);
}

/// Whether two pictures have the same pixel at byte `i`.
bool has_equal_pixel(const Picture& a, const Picture& b, std::size_t i) {
  return std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]);
}

std::string unexpected_effect(const Picture& picture, Effect effect) {
  const Scene scene = teapot(picture.width, picture.height, operations().front());
  const Picture without = picture_of(scene);
  const Picture background = background_picture(scene);
  const bool is_equal = picture.rgba == without.rgba;
  switch (effect) {
    case Effect::unchanged: return is_equal ? "" : "the operation changes the picture, expected no change";
    case Effect::changes_picture: {
      constexpr int kMinSide = 32;  // the teapot has to have pixels on which the operation acts
      const bool may_be_equal = picture.width < kMinSide || picture.height < kMinSide;
      return is_equal && !may_be_equal ? "the operation changes no pixel, expected some" : "";
    }
    case Effect::moves_intersections:
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        if (has_equal_pixel(picture, background, i) != has_equal_pixel(without, background, i))
          return "the operation changes which pixels are covered";
      return "";
    case Effect::masks_green:
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const bool is_red_equal = picture.rgba[i] == without.rgba[i];
        const bool is_green_masked = picture.rgba[i + 1] == background.rgba[i + 1];
        const bool is_blue_equal = picture.rgba[i + 2] == without.rgba[i + 2];
        if (!is_red_equal || !is_green_masked || !is_blue_equal)
          return "a pixel has a green level that the mask excludes, or another red or blue";
      }
      return "";
  }
  return "";
}

Drawing operation_drawing(int width, int height, const Operation& operation) {
  const auto scene = std::make_shared<const Scene>(teapot(width, height, operation));
  Drawing drawing;
  drawing.format = scene->framebuffer;
  drawing.meshes = scene->meshes;
  drawing.runs_in_full = true;  // alpha is 1: the operations change nothing, but are to be timed
  drawing.record = [scene](const Drawing&, Frame& frame) { record(*scene, frame); };
  drawing.fault = [effect = operation.effect](const Picture& picture) {
    return unexpected_effect(picture, effect);
  };
  return drawing;
}

}  // namespace

std::vector<WorkloadEntry> operation_workloads() {
  std::vector<WorkloadEntry> list;
  for (const Operation& operation : operations()) {
    WorkloadEntry entry = drawn_outside_mean(std::string("operation-") + operation.name,
                                             std::string("the lit teapot, ") + operation.description,
                                             [operation](int width, int height, std::uint32_t) {
                                               return operation_drawing(width, height, operation);
                                             });
    if (entry.name != kBaseline) entry.baseline = kBaseline;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace tessera::bench
