#include "perf/rivals/mesa_teapot.h"

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

#include "perf/rivals/osmesa.h"

namespace tessera::rivals {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9e", value);
  return text;
}

std::string vector_literal(double x, double y, double z) { return "vec3(" + number(x) + "," + number(y) + "," + number(z) + ")"; }
std::string color_literal(const Color& c) { return vector_literal(c.r, c.g, c.b); }

// GLSL's matrices are written in columns.
std::string matrix_literal(const Matrix& matrix, int size) {
  std::string text = "mat" + std::to_string(size) + "(";
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < size; ++row) text += (column + row > 0 ? "," : "") + number(matrix.m[static_cast<std::size_t>(4 * row + column)]);
  return text + ")";
}

/// light(normal, position): the lighting equation for one directional light and a local viewer, all of it literals.
std::string lighting_function(const Scene& scene, const Material& m) {
  const Light& light = scene.lights.at(0);
  if (scene.lights.size() != 1 || light.position[3] != 0 || !scene.light_model.local_viewer) throw std::runtime_error("the rival knows one directional light and a local viewer");
  const auto& v = scene.camera.view.m;
  double l[3];
  for (std::size_t row = 0; row < 3; ++row)
    l[row] = v[4 * row] * double{light.position[0]} + v[4 * row + 1] * double{light.position[1]} + v[4 * row + 2] * double{light.position[2]};
  const double length = std::sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
  const Color& a = scene.light_model.ambient;
  const Color base{m.emission.r + a.r * m.ambient.r + light.ambient.r * m.ambient.r, m.emission.g + a.g * m.ambient.g + light.ambient.g * m.ambient.g,
                   m.emission.b + a.b * m.ambient.b + light.ambient.b * m.ambient.b, 1};
  const Color diffuse{light.diffuse.r * m.diffuse.r, light.diffuse.g * m.diffuse.g, light.diffuse.b * m.diffuse.b, 1};
  const Color specular{light.specular.r * m.specular.r, light.specular.g * m.specular.g, light.specular.b * m.specular.b, 1};
  std::ostringstream s;
  s << "vec3 light(vec3 n, vec3 p) {\n"
    << "  const vec3 l = " << vector_literal(l[0] / length, l[1] / length, l[2] / length) << ";\n"
    << "  float nl = dot(n, l);\n"
    << "  vec3 h = normalize(l - normalize(p));\n"
    << "  float s = nl > 0.0 ? pow(max(dot(n, h), 0.0), " << number(m.shininess) << ") : 0.0;\n"
    << "  return clamp(" << color_literal(base) << " + max(nl, 0.0) * " << color_literal(diffuse) << " + s * " << color_literal(specular) << ", 0.0, 1.0);\n}\n";
  return s.str();
}

struct Sources {
  std::string vertex, fragment;
};

Sources shader_sources(const Scene& scene, const DrawCommand& draw, Shading shading, double aspect) {
  const Camera camera = scene.camera.at_aspect(aspect);
  const Matrix eye = camera.view * draw.state.transform, clip = camera.projection * eye;
  const std::string head = "#version 330\n", lighting = lighting_function(scene, draw.state.material);
  const std::string inputs = "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\n";
  const std::string transform = "  gl_Position = " + matrix_literal(clip, 4) + " * vec4(position, 1.0);\n  vec3 n = normalize(" + matrix_literal(eye, 3) +
                                " * normal);\n  vec3 p = (" + matrix_literal(eye, 4) + " * vec4(position, 1.0)).xyz;\n";
  if (shading == Shading::phong)
    return {head + inputs + "out vec3 n_;\nout vec3 p_;\nvoid main() {\n" + transform + "  n_ = n;\n  p_ = p;\n}\n",
            head + "in vec3 n_;\nin vec3 p_;\nout vec4 color;\n" + lighting + "void main() { color = vec4(light(normalize(n_), p_), 1.0); }\n"};
  const std::string how = shading == Shading::flat ? "flat " : "";
  return {head + inputs + how + "out vec3 c_;\n" + lighting + "void main() {\n" + transform + "  c_ = light(n, p);\n}\n",
          head + how + "in vec3 c_;\nout vec4 color;\nvoid main() { color = vec4(c_, 1.0); }\n"};
}

const DrawCommand& only_draw(const Scene& scene) {
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.what)) return *draw;
  throw std::runtime_error("the scene draws nothing");
}

}  // namespace

MesaTeapot::MesaTeapot(const Scene& scene, Shading shading, int width, int height, int threads) : width_(width), height_(height) {
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  context_ = make_context(pixels_.data(), width, height, threads);
  const DrawCommand& draw = only_draw(scene);
  const MeshData& mesh = scene.meshes[draw.mesh];
  const Sources sources = shader_sources(scene, draw, shading, static_cast<double>(width) / height);
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
    if (const auto* clear = std::get_if<Clear>(&command.what); clear && clear->color) glClearColor(clear->color->r, clear->color->g, clear->color->b, 1);
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
