// Sixteen textured layers over the whole picture beside Mesa's llvmpipe, in one process and interleaved.
//
//   build/release/bin/textures_bench
//
// Pictures are compared before anything is timed, and every layer has to be shaded: no deferred shading, no
// depth test. What counts is the ratio of medians, printed at the end with the quartiles. Both sides begin
// with vertices and a texture in memory and end with the picture there.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/rivals/mesa_textures.h"
#include "perf/rows.h"

namespace tessera {
namespace {

using rivals::TexturedVertex;

constexpr int kWidth = 1920, kHeight = 1080, kLayers = 16, kSide = 512;
constexpr std::uint64_t kArea = std::uint64_t{kWidth} * kHeight;

/// A layer as a plane seen in perspective: 1/w falls by these from the left to the right edge and from the
/// bottom to the top.
struct Plane {
  double fall_x = 0, fall_y = 0;
  double repeats_s, repeats_t;  // of the texture over the picture, if 1/w were 1
};
constexpr Plane kFacing{.repeats_s = 2.718, .repeats_t = 1.859};  // magnified: 0.72 and 0.88 texels a pixel
constexpr Plane kTilted{.fall_x = 0.25,
                        .fall_y = 0.4,
                        .repeats_s = 4.013,
                        .repeats_t = 2.207};  // minified: 1.1 .. 7.1 texels a pixel

struct Kind {
  const char* name;
  Plane plane;
  TextureFilter mag, min;
  GLint gl_mag, gl_min;
  TextureEnv environment;
  GLint gl_environment;
  double alike;  // share of pixels that have to differ by no more than kLevels
};
constexpr int kLevels = 2;
// Mesa filters with weights of 8 bits, and may take one level of detail for several pixels.
constexpr Kind kKinds[] = {{"nearest", kFacing, TextureFilter::nearest, TextureFilter::nearest, GL_NEAREST,
                            GL_NEAREST, TextureEnv::replace, GL_REPLACE, 0.995},
                           {"bilinear", kFacing, TextureFilter::linear, TextureFilter::linear, GL_LINEAR,
                            GL_LINEAR, TextureEnv::replace, GL_REPLACE, 0.995},
                           {"bilinear_modulate", kFacing, TextureFilter::linear, TextureFilter::linear,
                            GL_LINEAR, GL_LINEAR, TextureEnv::modulate, GL_MODULATE, 0.995},
                           {"trilinear", kTilted, TextureFilter::linear, TextureFilter::linear_mipmap_linear,
                            GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, TextureEnv::replace, GL_REPLACE, 0.94}};

std::vector<TexturedVertex> layers(const Plane& plane) {
  std::vector<TexturedVertex> vertices;
  for (int layer = 0; layer < kLayers; ++layer) {
    const double shift = static_cast<double>(layer) / kLayers;  // each sees other texels than the one below
    const auto corner = [&](int x, int y) {
      const double w = 1 / (1 - plane.fall_x * x - plane.fall_y * y);
      const auto f = [](double v) { return static_cast<float>(v); };
      return TexturedVertex{
          .position = {f((2 * x - 1) * w), f((2 * y - 1) * w), 0, f(w)},
          .texcoord = {f(plane.repeats_s * (x - 0.5) * w + shift), f(plane.repeats_t * y * w + shift)},
          .color = {static_cast<std::uint8_t>(x != 0 ? 255 : 96),
                    static_cast<std::uint8_t>(y != 0 ? 255 : 128), 224, 255}};
    };
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
      vertices.push_back(corner(x, y));
  }
  return vertices;
}

using Levels = std::vector<std::vector<std::uint32_t>>;

/// Waves, long and short, with a chequer over them, and the means of four texels each, rounded, down to a
/// single one.
Levels texture_levels() {
  Levels levels(1);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double turn = 2 * 3.14159265358979 / kSide, square = ((x ^ y) & 64) != 0 ? 24 : 0;
      const double ripple = 16 * std::sin(60 * turn * x) * std::sin(50 * turn * y);
      const auto level = [&](double wave) {
        return static_cast<std::uint32_t>(std::lround(112 + 90 * wave + ripple + square));
      };
      levels[0].push_back(level(std::sin(5 * turn * x)) | level(std::sin(4 * turn * (x + y))) << 8 |
                          level(std::cos(7 * turn * y)) << 16 | 0xff000000u);
    }
  for (std::size_t side = kSide / 2; side > 0; side /= 2) {
    const std::vector<std::uint32_t>& from = levels.back();
    std::vector<std::uint32_t> to(side * side);
    for (std::size_t i = 0; i < side * side; ++i)
      for (int c = 0; c < 32; c += 8) {
        const std::size_t first = i / side * 4 * side + i % side * 2;
        std::uint32_t sum = 2;
        for (const std::size_t at : {first, first + 1, first + 2 * side, first + 2 * side + 1})
          sum += from[at] >> c & 0xff;
        to[i] |= sum / 4 << c;
      }
    levels.push_back(std::move(to));
  }
  return levels;
}

/// Our side: everything from recording to the picture in memory, but for the texture's making.
class Ours {
 public:
  Ours(const Kind& kind, const std::vector<TexturedVertex>& vertices, const Levels& levels,
       const RendererOptions& options)
      : buffer_({.width = kWidth, .height = kHeight}),
        renderer_(options),
        texture_({.pixels = levels[0].data(), .width = kSide, .height = kSide, .bottom_row_first = true},
                 {.mag = kind.mag, .min = kind.min}),
        pixels_(kArea),
        target_{pixels_.data(), kWidth, kHeight, 4 * kWidth, PixelOrder::rgba8} {
    for (const TexturedVertex& v : vertices) {
      positions_.insert(positions_.end(), v.position, v.position + 4);
      texcoords_.insert(texcoords_.end(), v.texcoord, v.texcoord + 2);
      if (kind.environment != TextureEnv::replace) colors_.insert(colors_.end(), v.color, v.color + 4);
    }
    mesh_ = {.positions = positions_, .position_components = 4, .colors = colors_, .texcoords = texcoords_};
    state_.lighting = false;
    state_.texture = &texture_;
    state_.texture_env = kind.environment;
    state_.depth = {.enabled = false};
  }
  FrameStats draw() {
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}});
    frame.draw(mesh_, state_);
    return renderer_.finish(frame, target_);
  }
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  FrameBuffer buffer_;
  Renderer renderer_;
  Texture texture_;
  std::vector<float> positions_, texcoords_;
  std::vector<std::uint8_t> colors_;
  Mesh mesh_;
  DrawState state_;
  std::vector<std::uint32_t> pixels_;
  ImageTarget target_;
};

// Share of pixels no component of which differs by more than kLevels; Mesa's rows start at the bottom.
double share_alike(const std::vector<std::uint32_t>& ours, const std::vector<std::uint32_t>& mesa) {
  std::uint64_t alike = 0;
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) {
      const std::uint32_t a = ours[y * kWidth + x], b = mesa[(kHeight - 1 - y) * kWidth + x];
      bool near = true;
      for (int c = 0; c < 24; c += 8)
        near &= std::abs(static_cast<int>(a >> c & 0xff) - static_cast<int>(b >> c & 0xff)) <= kLevels;
      alike += near;
    }
  return static_cast<double>(alike) / static_cast<double>(kArea);
}

int run(int argc, char** argv) {
  RendererOptions options = initialize_rows(argc, argv);
  options.defer_shading = false;
  const Levels levels = texture_levels();
  for (const Kind& kind : kKinds) {
    const std::vector<TexturedVertex> vertices = layers(kind.plane);
    auto ours = std::make_shared<Ours>(kind, vertices, levels, options);
    auto mesa =
        std::make_shared<rivals::MesaTextures>(rivals::TexturedTriangles{.vertices = vertices,
                                                                         .levels = levels,
                                                                         .side = kSide,
                                                                         .mag = kind.gl_mag,
                                                                         .min = kind.gl_min,
                                                                         .environment = kind.gl_environment},
                                               kWidth, kHeight, options.threads);
    const std::uint64_t shaded = ours->draw().shaded_pixels;
    mesa->draw();
    const double alike = share_alike(ours->pixels(), mesa->pixels());
    std::printf("%s: %.3f %% of the pixels within %d levels; %.3f layers shaded\n", kind.name, 100 * alike,
                kLevels, static_cast<double>(shaded) / static_cast<double>(kArea));
    if (shaded != kLayers * kArea || alike < kind.alike) {
      std::fprintf(stderr, "the pictures differ, or a layer was not shaded: nothing is timed\n");
      return 1;
    }
    register_row(std::string("tessera_") + kind.name, ours);
    register_row(std::string("mesa_") + kind.name, mesa);
  }
  const RatioReporter reporter = run_rows(options, "Mesa", "Tessera");
  for (const Kind& kind : kKinds)
    print_ratio(reporter, std::to_string(kLayers) + " layers " + kind.name, std::string("mesa_") + kind.name,
                std::string("tessera_") + kind.name);
  return 0;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) { return tessera::run_benchmark("textures_bench", tessera::run, argc, argv); }
