// What each operation on fragments costs: the lit teapot with it beside the same teapot without, in one
// process.
//
//   build/release/bin/operations_bench
//
// Repetitions of all rows run in random order; what counts is the ratio of medians, printed at the end with
// the quartiles.
#include <functional>
#include <string_view>

#include "engine/scene/scene.h"
#include "perf/rows.h"

namespace tessera {
namespace {

/// A scene from recording to the picture in memory.
class Drawn {
 public:
  Drawn(Scene scene, const RendererOptions& options)
      : scene_(std::move(scene)),
        buffer_(scene_.framebuffer),
        renderer_(options),
        pixels_(static_cast<std::size_t>(scene_.framebuffer.width) *
                static_cast<std::size_t>(scene_.framebuffer.height)),
        target_{pixels_.data(), scene_.framebuffer.width, scene_.framebuffer.height,
                4 * scene_.framebuffer.width, PixelOrder::rgba8} {}
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

Scene teapot(int width, int height, Shading shading,
             const std::function<void(FrameBufferFormat&, DrawState&)>& change) {
  Scene scene = builtin_scene();
  apply({.width = width, .height = height, .shading = shading}, scene);
  for (SceneCommand& command : scene.frame)
    if (auto* const draw = std::get_if<DrawCommand>(&command.what)) change(scene.framebuffer, draw->state);
  return scene;
}

struct Operation {
  const char* name;
  std::function<void(FrameBufferFormat&, DrawState&)> change;
};

const std::vector<Operation>& operations() {
  static const std::vector<Operation> kAll = {
      {"without", [](FrameBufferFormat&, DrawState&) {}},
      {"again_without", [](FrameBufferFormat&, DrawState&) {}},
      {"samples_4", [](FrameBufferFormat& format, DrawState&) { format.samples = 4; }},
      {"samples_8", [](FrameBufferFormat& format, DrawState&) { format.samples = 8; }},
      {"alpha_planes", [](FrameBufferFormat& format, DrawState&) { format.alpha_bits = 8; }},
      {"alpha_test", [](FrameBufferFormat&, DrawState& state) { state.alpha_test = AlphaTest{}; }},
      {"stencil",
       [](FrameBufferFormat&, DrawState& state) {
         state.stencil =
             StencilState{.front = {.func = Compare::gequal, .ref = 1, .zpass = StencilOp::replace}};
       }},
      {"polygon_offset",
       [](FrameBufferFormat&, DrawState& state) {
         state.polygon_offset = {1, 1};
       }},
      {"blend", [](FrameBufferFormat&, DrawState& state) { state.blend = BlendState{}; }},
      {"dither_bayer8", [](FrameBufferFormat& format, DrawState&) { format.dither = Dither::bayer8; }},
      {"logic_xor", [](FrameBufferFormat&, DrawState& state) { state.logic_op = LogicOp::xor_; }},
      {"color_mask",
       [](FrameBufferFormat&, DrawState& state) {
         state.color_mask = {true, false, true, true};
       }},
  };
  return kAll;
}

struct Picture {
  const char* name;
  int width, height;
  Shading shading;
};
/// The built-in scene as it is, and larger in each shading.
constexpr Picture kPictures[] = {{"640x480_phong", 640, 480, Shading::phong},
                                 {"1920x1080_phong", 1920, 1080, Shading::phong},
                                 {"1920x1080_gouraud", 1920, 1080, Shading::gouraud},
                                 {"1920x1080_flat", 1920, 1080, Shading::flat}};

std::string row_name(const Picture& picture, const Operation& operation) {
  return std::string(picture.name) + "_" + operation.name;
}

int run(int argc, char** argv) {
  const RendererOptions options = initialize_rows(argc, argv);
  for (const Picture& picture : kPictures)
    for (const Operation& operation : operations())
      register_row(row_name(picture, operation),
                   std::make_shared<Drawn>(
                       teapot(picture.width, picture.height, picture.shading, operation.change), options));
  const RatioReporter reporter = run_rows(options, "with", "without");
  for (const Picture& picture : kPictures)
    for (const Operation& operation : operations())
      if (operation.name != std::string_view("without"))
        print_ratio(reporter, row_name(picture, operation), row_name(picture, operation),
                    row_name(picture, operations().front()));
  return 0;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) {
  return tessera::run_benchmark("operations_bench", tessera::run, argc, argv);
}
