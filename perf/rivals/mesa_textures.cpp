#include "perf/rivals/mesa_textures.h"

#include "perf/rivals/osmesa.h"

namespace tessera::rivals {
namespace {

void make_texture(const TexturedTriangles& triangles) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, triangles.mag);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, triangles.min);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  for (GLint level = 0, side = triangles.side; side > 0; ++level, side /= 2)
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 triangles.levels[static_cast<std::size_t>(level)].data());
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, triangles.environment);
  glEnable(GL_TEXTURE_2D);
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

MesaTextures::MesaTextures(const TexturedTriangles& triangles, int width, int height, int threads)
    : width_(width),
      height_(height),
      count_(static_cast<int>(triangles.vertices.size())),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  context_ = make_context(pixels_.data(), width, height, threads);
  make_buffer(GL_ARRAY_BUFFER, triangles.vertices.data(), triangles.vertices.size_bytes());
  glVertexPointer(4, GL_FLOAT, sizeof(TexturedVertex), offset(offsetof(TexturedVertex, position)));
  glEnableClientState(GL_VERTEX_ARRAY);
  glTexCoordPointer(2, GL_FLOAT, sizeof(TexturedVertex), offset(offsetof(TexturedVertex, texcoord)));
  glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  if (triangles.environment != GL_REPLACE) {
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(TexturedVertex), offset(offsetof(TexturedVertex, color)));
    glEnableClientState(GL_COLOR_ARRAY);
  }
  make_texture(triangles);
  // The depth buffer stays, unused: without one llvmpipe drops what a triangle covers whole tiles of, and
  // layers below would not be drawn.
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("the rival's set-up ends in an OpenGL error");
}

MesaTextures::~MesaTextures() { OSMesaDestroyContext(context_); }

void MesaTextures::draw() {
  OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_);
  glDrawArrays(GL_TRIANGLES, 0, count_);
  glFinish();
}

}  // namespace tessera::rivals
