// The built-in teapot beside Mesa's llvmpipe, in one process and interleaved; and one thread beside two.
//
//   build/release/bin/teapot_bench
//
// Pictures are compared before anything is timed. Repetitions of all rows run in random order; what counts is
// the ratio of medians, printed at the end with the quartiles. Both sides end with the picture in the
// caller's memory.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "engine/scene/builtin_mesh.h"
#include "engine/scene/scene.h"
#include "perf/rivals/mesa_teapot.h"
#include "perf/rows.h"

namespace tessera {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;
constexpr const char* kShadingNames[] = {"flat", "gouraud", "phong"};

Scene teapot_scene(int detail, Shading shading, int width, int height) {
  Scene scene = builtin_scene();
  scene.meshes.at(0) = builtin_mesh("teapot", detail);
  apply({.width = width, .height = height, .shading = shading}, scene);
  return scene;
}

/// Our side: everything from recording to the picture in memory.
class Ours {
 public:
  Ours(int detail, Shading shading, int width, int height, const RendererOptions& options)
      : scene_(teapot_scene(detail, shading, width, height)),
        buffer_(scene_.framebuffer),
        renderer_(options),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        target_{pixels_.data(), width, height, 4 * width, PixelOrder::rgba8} {}
  void draw() {
    Frame frame(buffer_);
    record(scene_, frame);
    renderer_.finish(frame, target_);
  }
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  FrameBuffer buffer_;
  Renderer renderer_;
  std::vector<std::uint32_t> pixels_;
  ImageTarget target_;
};

/// Share of pixels with a component more than 2 levels apart; Mesa's rows start at the bottom.
double share_that_differs(const std::vector<std::uint32_t>& ours, const std::vector<std::uint32_t>& mesa,
                          int width, int height) {
  std::size_t differing = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint32_t a =
          ours[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      const std::uint32_t b =
          mesa[static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)];
      for (int shift = 0; shift < 24; shift += 8)
        if (std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)) > 2) {
          ++differing;
          break;
        }
    }
  }
  return static_cast<double>(differing) / (static_cast<double>(width) * height);
}

int run(int argc, char** argv) {
  const RendererOptions options = initialize_rows(argc, argv);
  for (int s = 0; s < 3; ++s) {
    const auto shading = static_cast<Shading>(s);
    auto ours = std::make_shared<Ours>(12, shading, kWidth, kHeight, options);
    auto mesa =
        std::make_shared<rivals::MesaTeapot>(ours->scene(), shading, kWidth, kHeight, options.threads);
    ours->draw();
    mesa->draw();
    const double differing = share_that_differs(ours->pixels(), mesa->pixels(), kWidth, kHeight);
    std::printf("%s: %.4f %% of the pixels are more than 2 levels from Mesa's\n", kShadingNames[s],
                100 * differing);
    if (differing > 0.005) {
      std::fprintf(stderr, "the pictures differ: nothing is timed\n");
      return 1;
    }
    register_row(std::string("tessera_") + kShadingNames[s], ours);
    register_row(std::string("mesa_") + kShadingNames[s], mesa);
  }
  for (const int n : {1, 2})
    register_row(
        "phong_detail_40_4k_threads_" + std::to_string(n),
        std::make_shared<Ours>(40, Shading::phong, 3840, 2160,
                               RendererOptions{.threads = n, .instruction_set = options.instruction_set}));

  const RatioReporter reporter = run_rows(options, "Mesa", "Tessera");
  for (int s = 0; s < 3; ++s)
    print_ratio(reporter, std::string("teapot 1920x1080 ") + kShadingNames[s],
                std::string("mesa_") + kShadingNames[s], std::string("tessera_") + kShadingNames[s]);
  std::printf("%-34s %-32s %-32s\n", "", "1 thread", "2 threads");
  print_ratio(reporter, "teapot x40 3840x2160 phong", "phong_detail_40_4k_threads_1",
              "phong_detail_40_4k_threads_2");
  return 0;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) { return tessera::run_benchmark("teapot_bench", tessera::run, argc, argv); }
