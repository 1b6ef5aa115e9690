// Shared by the tests of bitmaps and images: states for every operation, and buffers for them.
#pragma once

#include <algorithm>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

/// The colour whose packed 24-bit value is `word`.
inline Color color_of(std::uint32_t word) {
  return {static_cast<float>(word >> 16 & 255) / 255.0f, static_cast<float>(word >> 8 & 255) / 255.0f,
          static_cast<float>(word & 255) / 255.0f, 1};
}

inline Rect random_rect(Random& random) {
  const auto upto = [&](int n) { return static_cast<int>(below(random, n)); };
  const int x = upto(50), y = upto(30);
  return {x, y, 1 + upto(40), 1 + upto(30)};
}
inline Rect intersection(const Rect& a, const Rect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

inline std::vector<FrameBufferFormat> operation_formats() {
  const FrameBufferFormat base{.width = 70, .height = 50};
  std::vector<FrameBufferFormat> formats(9, base);
  formats[1].depth = DepthFormat::unorm16;
  formats[1].color_bits = 8;
  formats[1].dither = Dither::bayer4;
  formats[2].depth = DepthFormat::float32;
  formats[2].alpha_bits = 8;
  formats[3].depth = DepthFormat::unorm32;
  formats[3].color_mode = ColorMode::index;
  formats[3].color_bits = 4;
  formats[3].dither = Dither::bayer2;
  formats[4].samples = 4;
  formats[5].samples = 8;
  formats[5].depth = DepthFormat::float32;
  formats[5].color_bits = 15;
  formats[5].dither = Dither::bayer8;
  formats[6].color_bits = 2;
  formats[6].depth = DepthFormat::none;
  formats[6].stencil_bits = 0;
  formats[7].color_mode = ColorMode::index;
  formats[7].color_bits = 8;
  formats[8].color_bits = 1;
  formats[8].depth = DepthFormat::unorm32;
  formats[8].samples = 4;
  return formats;
}
inline std::string describe(const FrameBufferFormat& f) {
  return std::to_string(f.color_bits) +
         (f.color_mode == ColorMode::index ? " index bits, depth " : " bits, depth ") +
         std::to_string(static_cast<int>(f.depth)) + ", " + std::to_string(f.samples) + " samples";
}

/// A random state; every operation occurs.
inline FragmentState random_fragment_state(Random& random, const FrameBufferFormat& format, int turn) {
  const bool is_index = format.color_mode == ColorMode::index;
  const auto coin = [&] { return random.next() % 2 == 0; };
  FragmentState s;
  s.depth = {.enabled = turn % 6 != 0, .test = static_cast<Compare>(turn % 8), .write = turn % 3 != 0};
  if (turn % 4 == 1 && !is_index)
    s.alpha_test = AlphaTest{static_cast<Compare>(turn / 4 % 8), random.between(0, 1)};
  if (turn % 3 != 1 && format.stencil_bits > 0)
    s.stencil = StencilState{.front = {.func = static_cast<Compare>(turn % 2 == 0 ? 7 : turn / 2 % 8),
                                       .ref = random.next() % 256,
                                       .mask = random.next() % 256,
                                       .fail = static_cast<StencilOp>(turn % 8),
                                       .zfail = static_cast<StencilOp>((turn + 3) % 8),
                                       .zpass = static_cast<StencilOp>((turn + 5) % 8),
                                       .write_mask = coin() ? 255 : random.next() % 256}};
  if (turn % 2 == 0 && !is_index)
    s.blend = BlendState{.src = static_cast<BlendFactor>(turn / 2 % 15),
                         .dst = static_cast<BlendFactor>((turn + 7) % 15),
                         .equation = static_cast<BlendEquation>(turn % 5),
                         .color = {0.2f, 0.4f, 0.6f, 0.8f}};
  else if (turn % 4 == 3) s.logic_op = static_cast<LogicOp>(turn / 4 % 16);
  if (turn % 5 == 4) s.plane_mask = random.next();
  if (turn % 7 == 3) {
    const bool all = is_index || format.color_bits <= 2;
    const bool red = coin();
    s.color_mask = {red, all ? red : coin(), all ? red : coin(), coin()};
  }
  if (turn % 5 == 1) s.scissor = random_rect(random);
  return s;
}

/// Fills every buffer: colours and depths that vary over the window, stencil values in stripes. The meshes
/// are static.
inline void draw_background(Frame& frame, const FrameBufferFormat& format) {
  static const MeshData slope = [] {
    MeshData mesh = whole_window();
    constexpr float kDepths[] = {-1.0f, 0.1f, 0.9f, 0.1f};
    for (std::size_t v = 0; v < 4; ++v) mesh.positions[3 * v + 2] = kDepths[v];
    mesh.colors = {0.9f, 0.2f, 0.1f, 0.8f, 0.1f, 0.9f, 0.3f, 0.3f, 0.2f, 0.1f, 1, 1, 0.7f, 0.7f, 0, 0.1f};
    return mesh;
  }();
  Clear clear{.color = Color{0.1f, 0.2f, 0.3f, 0.4f}};
  if (format.depth != DepthFormat::none) clear.depth = 1.0;
  if (format.stencil_bits > 0) clear.stencil = 0;
  frame.clear(clear);
  DrawState state;
  state.lighting = false;
  frame.draw(slope.view(), state);
  for (int x = 0; x < format.width && format.stencil_bits > 0; x += 9)
    frame.clear(
        {.stencil = static_cast<std::uint32_t>(37 * x) & 255u, .scissor = Rect{x, 0, 5, format.height}});
}

}  // namespace tessera::test
