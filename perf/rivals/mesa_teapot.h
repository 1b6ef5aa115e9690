// The rival: Mesa's llvmpipe through OSMesa, drawing the built-in teapot in its best form: vertex buffers,
// every constant (matrices, material, light) a literal in its shaders, no state change inside a frame.
#pragma once

#include <GL/osmesa.h>

#include <cstdint>
#include <vector>

#include "engine/scene/scene.h"

namespace tessera::rivals {

class MesaTeapot {
 public:
  /// @param threads  what llvmpipe may use; read by Mesa when its first context is made, so the same for all
  /// of a process.
  /// @throws std::runtime_error where OSMesa or a shader fails.
  MesaTeapot(const Scene& scene, Shading shading, int width, int height, int threads);
  ~MesaTeapot();
  MesaTeapot(const MesaTeapot&) = delete;
  MesaTeapot& operator=(const MesaTeapot&) = delete;

  /// Clears, draws and waits until the picture stands in memory.
  void draw();
  /// RGBA8, rows from the bottom, as OSMesa keeps them.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  int width_, height_, index_count_ = 0;
  std::vector<std::uint32_t> pixels_;
  OSMesaContext context_ = nullptr;
};

}  // namespace tessera::rivals
