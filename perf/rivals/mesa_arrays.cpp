#include "perf/rivals/mesa_arrays.h"

#include "perf/rivals/osmesa.h"

namespace tessera::rivals {

MesaArrays::MesaArrays(GLenum mode, std::span<const float> positions, std::span<const std::uint8_t> colors,
                       int width, int height, int threads)
    : mode_(mode),
      width_(width),
      height_(height),
      count_(static_cast<int>(positions.size() / 3)),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  context_ = make_context(pixels_.data(), width, height, threads);
  use_program(
      "#version 330\nlayout(location = 0) in vec3 position;\nlayout(location = 1) in vec4 color;\nout vec4 "
      "c_;\nvoid main() { gl_Position = vec4(position, 1.0); c_ = color; }\n",
      "#version 330\nin vec4 c_;\nout vec4 color;\nvoid main() { color = c_; }\n");
  const auto enable = load<PFNGLENABLEVERTEXATTRIBARRAYPROC>("glEnableVertexAttribArray");
  const auto attribute = load<PFNGLVERTEXATTRIBPOINTERPROC>("glVertexAttribPointer");
  make_buffer(GL_ARRAY_BUFFER, positions.data(), positions.size_bytes());
  enable(0);
  attribute(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  make_buffer(GL_ARRAY_BUFFER, colors.data(), colors.size_bytes());
  enable(1);
  attribute(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("the rival's set-up ends in an OpenGL error");
}

MesaArrays::~MesaArrays() { OSMesaDestroyContext(context_); }

void MesaArrays::draw() {
  OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawArrays(mode_, 0, count_);
  glFinish();
}

}  // namespace tessera::rivals
