// A million points and a million short lines beside Mesa's llvmpipe, in one process and interleaved.
//
//   build/release/bin/primitives_bench
//
// Pictures are compared before anything is timed: which pixels are covered. What counts is the ratio of
// medians, printed at the end with the quartiles. Both sides begin with vertices in memory and end with the
// picture there.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/rivals/mesa_arrays.h"
#include "perf/rows.h"

namespace tessera {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;
constexpr std::size_t kCount = 1'000'000;

struct Kind {
  const char* name;
  Primitive primitive;
  GLenum mode;
  std::size_t corners;
  float length;  // pixels
};
constexpr Kind kKinds[] = {{"points", Primitive::points, GL_POINTS, 1, 0},
                           {"lines_of_10_pixels", Primitive::lines, GL_LINES, 2, 10}};

struct Vertices {
  std::vector<float> positions;  // normalized device coordinates
  std::vector<std::uint8_t> colors;

  explicit Vertices(const Kind& kind) {
    std::mt19937 random(7);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    for (std::size_t i = 0; i < kCount; ++i) {
      const float x = unit() * kWidth, y = unit() * kHeight, turn = 6.2831853f * unit();
      for (std::size_t k = 0; k < kind.corners; ++k) {
        const float along = kind.length * static_cast<float>(k);
        for (const float p : {2 * (x + along * std::cos(turn)) / kWidth - 1,
                              2 * (y + along * std::sin(turn)) / kHeight - 1, 1.8f * unit() - 0.9f})
          positions.push_back(p);
        for (int c = 0; c < 4; ++c)
          colors.push_back(c == 3 ? 255 : static_cast<std::uint8_t>(64 + (random() >> 8) % 192));
      }
    }
  }
};

/// Our side: everything from recording to the picture in memory.
class Ours {
 public:
  Ours(const Kind& kind, const Vertices& vertices, const RendererOptions& options)
      : buffer_({.width = kWidth, .height = kHeight}),
        renderer_(options),
        pixels_(std::size_t{kWidth} * kHeight),
        target_{pixels_.data(), kWidth, kHeight, 4 * kWidth, PixelOrder::rgba8} {
    mesh_ = {.primitive = kind.primitive, .positions = vertices.positions, .colors = vertices.colors};
    state_.lighting = false;
  }
  void draw() {
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1});
    frame.draw(mesh_, state_);
    renderer_.finish(frame, target_);
  }
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  FrameBuffer buffer_;
  Renderer renderer_;
  Mesh mesh_;
  DrawState state_;
  std::vector<std::uint32_t> pixels_;
  ImageTarget target_;
};

// Share of pixels that one of the two covers alone; Mesa's rows start at the bottom, and its clear has no
// alpha.
double share_that_differs(const std::vector<std::uint32_t>& ours, const std::vector<std::uint32_t>& mesa) {
  std::size_t differing = 0;
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x)
      differing += ((ours[y * kWidth + x] & 0xffffff) != 0) !=
                   ((mesa[(kHeight - 1 - y) * kWidth + x] & 0xffffff) != 0);
  return static_cast<double>(differing) / (double{kWidth} * kHeight);
}

int run(int argc, char** argv) {
  const RendererOptions options = initialize_rows(argc, argv);
  std::vector<std::unique_ptr<Vertices>> kept;
  for (const Kind& kind : kKinds) {
    const Vertices& vertices = *kept.emplace_back(std::make_unique<Vertices>(kind));
    auto ours = std::make_shared<Ours>(kind, vertices, options);
    auto mesa = std::make_shared<rivals::MesaArrays>(kind.mode, vertices.positions, vertices.colors, kWidth,
                                                     kHeight, options.threads);
    ours->draw();
    mesa->draw();
    const double differing = share_that_differs(ours->pixels(), mesa->pixels());
    std::printf("%s: %.4f %% of the pixels are covered by one side alone\n", kind.name, 100 * differing);
    if (differing > 0.02) {
      std::fprintf(stderr, "the pictures differ: nothing is timed\n");
      return 1;
    }
    register_row(std::string("tessera_") + kind.name, ours);
    register_row(std::string("mesa_") + kind.name, mesa);
  }
  const RatioReporter reporter = run_rows(options, "Mesa", "Tessera");
  for (const Kind& kind : kKinds)
    print_ratio(reporter, std::string("1 M ") + kind.name, std::string("mesa_") + kind.name,
                std::string("tessera_") + kind.name);
  return 0;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) {
  return tessera::run_benchmark("primitives_bench", tessera::run, argc, argv);
}
