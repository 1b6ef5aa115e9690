// The rival: Mesa's llvmpipe through OSMesa, drawing coloured vertices that stand in the window already:
// vertex buffers, the smallest shaders there are, no state change inside a frame.
#pragma once

#include <GL/osmesa.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tessera::rivals {

class MesaArrays {
 public:
  /// @param mode       GL_POINTS, GL_LINES, ...
  /// @param positions  x y z in normalized device coordinates
  /// @param colors     r g b a for each
  /// @param threads    what llvmpipe may use; read by Mesa when its first context is made, so the same for
  /// all of a process.
  /// @throws std::runtime_error where OSMesa or a shader fails.
  MesaArrays(GLenum mode, std::span<const float> positions, std::span<const std::uint8_t> colors, int width,
             int height, int threads);
  ~MesaArrays();
  MesaArrays(const MesaArrays&) = delete;
  MesaArrays& operator=(const MesaArrays&) = delete;

  /// Clears, draws and waits until the picture stands in memory.
  void draw();
  /// RGBA8, rows from the bottom, as OSMesa keeps them.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  GLenum mode_;
  int width_, height_, count_;
  std::vector<std::uint32_t> pixels_;
  OSMesaContext context_ = nullptr;
};

}  // namespace tessera::rivals
