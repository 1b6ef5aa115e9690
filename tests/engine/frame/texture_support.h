// Shared by tests of textures: images, and draws that show them.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test {

/// Random pixels, rows from the top.
struct Pixels {
  int width;
  int height;
  int channels;
  std::vector<std::uint8_t> bytes;

  Pixels(int w, int h, int c, std::uint64_t seed = 1) : width(w), height(h), channels(c) {
    Random random(seed);
    for (int i = 0; i < w * h * c; ++i) bytes.push_back(static_cast<std::uint8_t>(random.next()));
  }
  Pixels(int w, int h, std::initializer_list<std::uint8_t> pixel)
      : width(w), height(h), channels(static_cast<int>(pixel.size())) {
    for (int i = 0; i < w * h; ++i)
      for (const std::uint8_t component : pixel) bytes.push_back(component);
  }
  TextureImage image() const {
    return {.pixels = bytes.data(), .width = width, .height = height, .channels = channels};
  }
  std::uint8_t at(int x, int y_from_top, int c) const {
    return bytes[static_cast<std::size_t>((y_from_top * width + x) * channels + c)];
  }
};

/// Covers the window; texture coordinates run from 0 to (s1, t1).
inline MeshData textured_window(float s1 = 1, float t1 = 1, float z = 0) {
  MeshData mesh = whole_window(z);
  mesh.texcoords = {0, 0, s1, 0, s1, t1, 0, t1};
  return mesh;
}

/// An unlit state whose texture replaces the colour.
inline DrawState replacing(const Texture& texture) {
  DrawState state = unlit({1, 1, 1, 1});
  state.texture = &texture;
  state.texture_env = TextureEnv::replace;
  return state;
}

inline constexpr TextureSampler kNearest{.mag = TextureFilter::nearest, .min = TextureFilter::nearest};

/// Stored pixels of a draw that covers the window: packed A:R:G:B, rows from the top.
inline std::vector<std::uint32_t> drawn(const MeshData& mesh, const DrawState& state,
                                        FrameBufferFormat format,
                                        const RendererOptions& options = {.threads = 1}) {
  FrameBuffer buffer(std::move(format));
  Frame frame(buffer);
  frame.clear(
      {.color = Color{0.25f, 0.5f, 0.75f, buffer.format().alpha_bits > 0 ? 0.5f : 1.0f}, .depth = 1.0});
  frame.draw(mesh.view(), state);
  Renderer(options).finish(frame);
  return packed_colors(buffer);
}

/// Frame::explain() of the draw.
inline std::string explained(const MeshData& mesh, const DrawState& state,
                             const FrameBufferFormat& format = {.width = 16, .height = 16}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.draw(mesh.view(), state);
  return frame.explain(0);
}

}  // namespace tessera::test
