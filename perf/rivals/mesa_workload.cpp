#include "perf/rivals/mesa_workload.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "perf/rivals/mesa_functions.h"

namespace tessera::rivals {
using namespace program;
namespace {

using bench::GlWorkload;

std::string gl_string(GLenum what) { return reinterpret_cast<const char*>(mesa().get_string(what)); }

/// A context that draws into a picture, rows from the top.
class MesaContext {
 public:
  MesaContext(int width, int height, MesaDriver driver, int threads) : picture_(width, height) {
    setenv("GALLIUM_DRIVER", driver == MesaDriver::llvmpipe ? "llvmpipe" : "softpipe", 1);
    setenv("LP_NUM_THREADS", threads == 1 ? "0" : std::to_string(threads).c_str(), 1);
    constexpr int kAttributes[] = {OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_DEPTH_BITS,
                                   24,
                                   OSMESA_STENCIL_BITS,
                                   8,
                                   OSMESA_PROFILE,
                                   OSMESA_COMPAT_PROFILE,
                                   0};
    context_ = mesa().create_context(kAttributes, nullptr);
    if (context_ == nullptr) throw std::runtime_error("OSMesa makes no context");
    make_current();
    const std::string wanted = driver == MesaDriver::llvmpipe ? "llvmpipe" : "softpipe",
                      found = gl_string(GL_RENDERER);
    if (found.find(wanted) == std::string::npos)
      throw std::runtime_error("OSMesa's driver is \"" + found + "\", expected " + wanted);
    mesa().pixel_store(OSMESA_Y_UP, 0);
  }
  ~MesaContext() { mesa().destroy_context(context_); }
  MesaContext(const MesaContext&) = delete;
  MesaContext& operator=(const MesaContext&) = delete;

  void make_current() {
    if (!mesa().make_current(context_, picture_.rgba.data(), GL_UNSIGNED_BYTE, picture_.width,
                             picture_.height))
      throw std::runtime_error("OSMesa does not draw into a picture of this size");
  }
  const Picture& picture() const { return picture_; }

 private:
  Picture picture_;
  OSMesaContext context_ = nullptr;
};

void link_and_use_program(const bench::ShaderSources& sources) {
  const GLuint program = mesa().create_program();
  const auto attach = [&](GLenum kind, const std::string& source) {
    const GLuint shader = mesa().create_shader(kind);
    const char* text = source.c_str();
    mesa().shader_source(shader, 1, &text, nullptr);
    mesa().compile_shader(shader);
    GLint is_good = 0;
    mesa().get_shaderiv(shader, GL_COMPILE_STATUS, &is_good);
    if (!is_good) {
      char log[2000];
      mesa().get_shader_info_log(shader, sizeof log, nullptr, log);
      throw std::runtime_error(std::string("a shader of the rival does not compile: ") + log);
    }
    mesa().attach_shader(program, shader);
  };
  attach(GL_VERTEX_SHADER, sources.vertex);
  attach(GL_FRAGMENT_SHADER, sources.fragment);
  mesa().link_program(program);
  mesa().use_program(program);
}

template <class Number>
void upload_buffer(GLenum target, const std::vector<Number>& values) {
  GLuint name = 0;
  mesa().gen_buffers(1, &name);
  mesa().bind_buffer(target, name);
  mesa().buffer_data(target, static_cast<GLsizeiptr>(values.size() * sizeof(Number)), values.data(),
                     GL_STATIC_DRAW);
}

void set_vertex_attribute(GLuint location, GLint components, const std::vector<float>& values) {
  if (values.empty()) return;
  upload_buffer(GL_ARRAY_BUFFER, values);
  mesa().enable_vertex_attrib_array(location);
  mesa().vertex_attrib_pointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

GLint filter_of(TextureFilter filter) {
  switch (filter) {
    case TextureFilter::nearest: return GL_NEAREST;
    case TextureFilter::linear: return GL_LINEAR;
    case TextureFilter::nearest_mipmap_nearest: return GL_NEAREST_MIPMAP_NEAREST;
    case TextureFilter::linear_mipmap_nearest: return GL_LINEAR_MIPMAP_NEAREST;
    case TextureFilter::nearest_mipmap_linear: return GL_NEAREST_MIPMAP_LINEAR;
    default: return GL_LINEAR_MIPMAP_LINEAR;
  }
}

void upload_texture(const GlWorkload& form) {
  mesa().bind_texture(GL_TEXTURE_2D, 0);
  mesa().tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, form.texture_size, form.texture_size, 0, GL_RGBA,
                      GL_UNSIGNED_BYTE, form.texels.data());
  mesa().generate_mipmap(GL_TEXTURE_2D);
  mesa().tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter_of(form.sampler.mag));
  mesa().tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter_of(form.sampler.min));
}

GLenum mode_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return GL_POINTS;
    case Primitive::lines: return GL_LINES;
    case Primitive::triangles: return GL_TRIANGLES;
    default: throw std::runtime_error("the rival draws points, lines and triangles");
  }
}

class MesaWorkload : public bench::Workload {
 public:
  MesaWorkload(const GlWorkload& form, int width, int height, MesaDriver driver, int threads)
      : window_(width, height, driver, threads), mode_(mode_of(form.mesh.primitive)) {
    link_and_use_program(form.shaders);
    set_vertex_attribute(0, form.mesh.position_components, form.mesh.positions);
    set_vertex_attribute(1, 3, form.mesh.normals);
    set_vertex_attribute(2, 4, form.mesh.colors);
    set_vertex_attribute(3, 2, form.mesh.texcoords);
    if (!form.mesh.indices.empty()) upload_buffer(GL_ELEMENT_ARRAY_BUFFER, form.mesh.indices);
    index_count_ = static_cast<GLsizei>(form.mesh.indices.size());
    revealed_indices_ = form.revealed_indices;
    vertex_count_ = static_cast<GLsizei>(form.mesh.vertex_count());
    if (form.texture_size != 0) upload_texture(form);
    mesa().disable(GL_DITHER);
    if (form.culls_back) mesa().enable(GL_CULL_FACE);
    if (form.tests_depth) {
      mesa().enable(GL_DEPTH_TEST);
      clear_mask_ |= kDepthAndStencil;
    }
    if (!form.writes_color) mesa().color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    if (form.blends) {
      mesa().enable(GL_BLEND);
      mesa().blend_func(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    if (form.increments_stencil) {
      mesa().enable(GL_STENCIL_TEST);
      mesa().clear_stencil(1);
      mesa().stencil_func(GL_LESS, 0, 0xff);
      mesa().stencil_op(GL_KEEP, GL_KEEP, GL_INCR);
      clear_mask_ |= kDepthAndStencil;
    }
    mesa().clear_color(form.clear_color.r, form.clear_color.g, form.clear_color.b, 1);
    if (mesa().get_error() != GL_NO_ERROR)
      throw std::runtime_error("the rival's set-up ends in an OpenGL error");
  }

  FrameStats draw() override {
    mesa().clear(clear_mask_);
    if (index_count_ > 0) mesa().draw_elements(mode_, index_count_, GL_UNSIGNED_INT, nullptr);
    else mesa().draw_arrays(mode_, 0, vertex_count_);
    mesa().finish();
    return {};
  }
  std::string fault() override {
    draw();
    if (revealed_indices_ > 0) reveal();
    return mesa().get_error() == GL_NO_ERROR ? "" : "an OpenGL error";
  }
  const Picture& picture() override { return window_.picture(); }
  bench::FrameWork work(const FrameStats&) const override { return {}; }

 private:
  void reveal() {
    mesa().color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    mesa().depth_func(GL_EQUAL);
    mesa().draw_elements(mode_, revealed_indices_, GL_UNSIGNED_INT,
                         reinterpret_cast<const void*>(
                             sizeof(GLuint) * static_cast<std::size_t>(index_count_ - revealed_indices_)));
    mesa().finish();
    mesa().depth_func(GL_LESS);
    mesa().color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  }

  static constexpr GLbitfield kDepthAndStencil =
      GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;  // they share words: one alone would be read and written

  MesaContext window_;
  GLenum mode_;
  GLsizei index_count_ = 0, vertex_count_ = 0, revealed_indices_ = 0;
  GLbitfield clear_mask_ = GL_COLOR_BUFFER_BIT;
};

}  // namespace

std::unique_ptr<bench::Workload> mesa_workload(const GlWorkload& form, int width, int height,
                                               MesaDriver driver, int threads) {
  return std::make_unique<MesaWorkload>(form, width, height, driver, threads);
}

double mesa_finish_ms(int width, int height, MesaDriver driver, int threads) {
  constexpr int kFrames = 51;
  MesaContext window(width, height, driver, threads);
  mesa().clear(GL_COLOR_BUFFER_BIT);
  mesa().finish();
  mesa().scissor(0, 0, 1, 1);
  mesa().enable(GL_SCISSOR_TEST);
  std::vector<double> times;
  for (int i = 0; i < kFrames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    mesa().clear(GL_COLOR_BUFFER_BIT);
    mesa().finish();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + kFrames / 2, times.end());
  return times[kFrames / 2];
}

std::string mesa_name(MesaDriver driver, int threads) {
  const MesaContext window(1, 1, driver, threads);
  return gl_string(GL_RENDERER) + ", " + gl_string(GL_VERSION);
}

}  // namespace tessera::rivals
