#include "perf/rivals/mesa_teapot.h"

#include <stdexcept>

#include "perf/rivals/literal_shaders.h"
#include "perf/rivals/osmesa.h"

namespace tessera::rivals {
namespace {

const DrawCommand& only_draw(const Scene& scene) {
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.what)) return *draw;
  throw std::runtime_error("the scene draws nothing");
}

}  // namespace

MesaTeapot::MesaTeapot(const Scene& scene, Shading shading, int width, int height, int threads)
    : width_(width), height_(height) {
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  context_ = make_context(pixels_.data(), width, height, threads);
  const DrawCommand& draw = only_draw(scene);
  const MeshData& mesh = scene.meshes[draw.mesh];
  const bench::ShaderSources sources =
      lit_shaders({.camera = scene.camera.at_aspect(static_cast<double>(width) / height),
                   .transform = draw.state.transform,
                   .lights = scene.lights,
                   .model = scene.light_model,
                   .material = draw.state.material,
                   .shading = shading});
  use_program(sources.vertex, sources.fragment);
  const auto attribute = [&](GLuint location, const std::vector<float>& values) {
    make_buffer(GL_ARRAY_BUFFER, values.data(), values.size() * sizeof(float));
    load<PFNGLENABLEVERTEXATTRIBARRAYPROC>("glEnableVertexAttribArray")(location);
    load<PFNGLVERTEXATTRIBPOINTERPROC>("glVertexAttribPointer")(location, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  };
  attribute(0, mesh.positions);
  attribute(1, mesh.normals);
  make_buffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
  index_count_ = static_cast<int>(mesh.indices.size());
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
  for (const SceneCommand& command : scene.frame)
    if (const auto* clear = std::get_if<Clear>(&command.what); clear && clear->color)
      glClearColor(clear->color->r, clear->color->g, clear->color->b, 1);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("the rival's set-up ends in an OpenGL error");
}

MesaTeapot::~MesaTeapot() { OSMesaDestroyContext(context_); }

void MesaTeapot::draw() {
  OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glFinish();
}

}  // namespace tessera::rivals
