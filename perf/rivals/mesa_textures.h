// The rival: Mesa's llvmpipe through OSMesa, drawing textured triangles that stand in clip space already:
// OpenGL's fixed functions, one vertex buffer, the texture with all its levels handed over before the first
// picture, no state change inside a frame.
#pragma once

#include <GL/osmesa.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::rivals {

/// A vertex as OpenGL reads it.
struct TexturedVertex {
  float position[4];  // clip space
  float texcoord[2];
  std::uint8_t color[4];
};

struct TexturedTriangles {
  std::span<const TexturedVertex> vertices;
  std::span<const std::vector<std::uint32_t>>
      levels;    // RGBA8, rows from the bottom; each half as wide and high as the one before
  int side = 0;  // texels of the first level
  GLint mag = GL_LINEAR, min = GL_LINEAR, environment = GL_REPLACE;
};

class MesaTextures {
 public:
  /// @param threads  what llvmpipe may use; read by Mesa when its first context is made, so the same for all
  /// of a process.
  /// @throws std::runtime_error where OSMesa fails.
  MesaTextures(const TexturedTriangles& triangles, int width, int height, int threads);
  ~MesaTextures();
  MesaTextures(const MesaTextures&) = delete;
  MesaTextures& operator=(const MesaTextures&) = delete;

  /// Draws and waits until the picture stands in memory.
  void draw();
  /// RGBA8, rows from the bottom, as OSMesa keeps them.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  int width_, height_, count_;
  std::vector<std::uint32_t> pixels_;
  OSMesaContext context_ = nullptr;
};

}  // namespace tessera::rivals
