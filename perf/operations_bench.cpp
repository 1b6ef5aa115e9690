// What each operation on fragments costs: the lit teapot with it beside the same teapot without, in one process.
//
//   build/release/bin/operations_bench
//
// Repetitions of all rows run in random order; what counts is the ratio of medians, printed at the end with the quartiles.
#include <functional>
#include <string_view>

#include "engine/parallel.h"
#include "engine/scene/scene.h"
#include "perf/rows.h"

namespace tessera {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

/// A scene from recording to the picture in memory.
class Drawn {
 public:
  explicit Drawn(Scene scene)
      : scene_(std::move(scene)), buffer_(scene_.framebuffer), renderer_({.threads = available_cores()}), pixels_(std::size_t{kWidth} * kHeight),
        target_{pixels_.data(), kWidth, kHeight, 4 * kWidth, PixelOrder::rgba8} {}
  void draw() {
    Frame frame(buffer_);
    record(scene_, frame);
    renderer_.finish(frame, target_);
  }

 private:
  Scene scene_;
  FrameBuffer buffer_;
  Renderer renderer_;
  std::vector<std::uint32_t> pixels_;
  ImageTarget target_;
};

Scene teapot(Shading shading, const std::function<void(FrameBufferFormat&, DrawState&)>& change) {
  Scene scene = builtin_scene();
  apply({.width = kWidth, .height = kHeight, .shading = shading}, scene);
  for (SceneCommand& command : scene.frame)
    if (auto* const draw = std::get_if<DrawCommand>(&command.what)) change(scene.framebuffer, draw->state);
  return scene;
}

struct Operation {
  const char* name;
  double goal;  ///< ratio; 0: none
  std::function<void(FrameBufferFormat&, DrawState&)> change;
};

const std::vector<Operation>& operations() {
  static const std::vector<Operation> kAll = {
      {"without", 0, [](FrameBufferFormat&, DrawState&) {}},
      {"again_without", 0, [](FrameBufferFormat&, DrawState&) {}},
      {"samples_4", 1.8, [](FrameBufferFormat& format, DrawState&) { format.samples = 4; }},
      {"samples_8", 0, [](FrameBufferFormat& format, DrawState&) { format.samples = 8; }},
      {"alpha_planes", 0, [](FrameBufferFormat& format, DrawState&) { format.alpha_bits = 8; }},
      {"alpha_test", 0, [](FrameBufferFormat&, DrawState& state) { state.alpha_test = AlphaTest{}; }},
      {"stencil", 0, [](FrameBufferFormat&, DrawState& state) { state.stencil = StencilState{.front = {.func = Compare::gequal, .ref = 1, .zpass = StencilOp::replace}}; }},
      {"polygon_offset", 0, [](FrameBufferFormat&, DrawState& state) { state.polygon_offset = {1, 1}; }},
      {"blend", 0, [](FrameBufferFormat&, DrawState& state) { state.blend = BlendState{}; }},
      {"dither_bayer8", 0, [](FrameBufferFormat& format, DrawState&) { format.dither = Dither::bayer8; }},
      {"logic_xor", 0, [](FrameBufferFormat&, DrawState& state) { state.logic_op = LogicOp::xor_; }},
      {"color_mask", 0, [](FrameBufferFormat&, DrawState& state) { state.color_mask = {true, false, true, true}; }},
  };
  return kAll;
}

int run(int argc, char** argv) {
  initialize_rows(argc, argv);
  constexpr std::pair<Shading, const char*> kShadings[] = {{Shading::phong, "phong"}, {Shading::gouraud, "gouraud"}, {Shading::flat, "flat"}};
  for (const auto& [shading, name] : kShadings)
    for (const Operation& operation : operations()) register_row(std::string(name) + "_" + operation.name, std::make_shared<Drawn>(teapot(shading, operation.change)));
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const auto& [shading, name] : kShadings)
    for (const Operation& operation : operations())
      if (operation.name != std::string_view("without"))
        print_ratio(reporter, std::string(name) + ", " + operation.name, std::string(name) + "_" + operation.name, std::string(name) + "_without", operation.goal);
  return 0;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) {
  try {
    return tessera::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "operations_bench: %s\n", error.what());
    return 1;
  }
}
