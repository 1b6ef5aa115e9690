#include "perf/rivals/mesa_workload.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "perf/rivals/mesa_functions.h"

namespace tessera::rivals {
using namespace program;
namespace {

using bench::GlWorkload;

std::string gl_string(GLenum name) { return reinterpret_cast<const char*>(mesa().get_string(name)); }

const char* driver_name(MesaDriver driver) {
  return driver == MesaDriver::llvmpipe ? "llvmpipe" : "softpipe";
}

/// A context that draws into a picture, top row first.
class MesaContext {
 public:
  MesaContext(int width, int height, MesaDriver driver, int threads) : picture_(width, height) {
    setenv("GALLIUM_DRIVER", driver_name(driver), 1);
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
    if (context_ == nullptr) throw std::runtime_error("OSMesa cannot create a context");
    make_current();
    const std::string wanted = driver_name(driver);
    const std::string found = gl_string(GL_RENDERER);
    if (found.find(wanted) == std::string::npos)
      throw std::runtime_error("the OSMesa driver is \"" + found + "\", expected " + wanted);
    mesa().pixel_store(OSMESA_Y_UP, 0);
  }
  ~MesaContext() { mesa().destroy_context(context_); }
  MesaContext(const MesaContext&) = delete;
  MesaContext& operator=(const MesaContext&) = delete;

  void make_current() {
    if (!mesa().make_current(context_, picture_.rgba.data(), GL_UNSIGNED_BYTE, picture_.width,
                             picture_.height))
      throw std::runtime_error("OSMesa cannot draw into a picture of this size");
  }
  const Picture& picture() const { return picture_; }

 private:
  Picture picture_;
  OSMesaContext context_ = nullptr;
};

GLuint link_and_use_program(const bench::ShaderSources& sources) {
  const GLuint program = mesa().create_program();
  const auto attach = [&](GLenum kind, const std::string& source) {
    const GLuint shader = mesa().create_shader(kind);
    const char* text = source.c_str();
    mesa().shader_source(shader, 1, &text, nullptr);
    mesa().compile_shader(shader);
    GLint is_compiled = 0;
    mesa().get_shaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    if (!is_compiled) {
      char log[2000];
      mesa().get_shader_info_log(shader, sizeof log, nullptr, log);
      throw std::runtime_error(std::string("a shader of the rival fails to compile: ") + log);
    }
    mesa().attach_shader(program, shader);
  };
  attach(GL_VERTEX_SHADER, sources.vertex);
  attach(GL_FRAGMENT_SHADER, sources.fragment);
  mesa().link_program(program);
  mesa().use_program(program);
  return program;
}

/// A buffer of several samples per pixel.
class MultisampleBuffer {
 public:
  MultisampleBuffer(int width, int height, int samples) : width_(width), height_(height) {
    mesa().gen_framebuffers(1, &framebuffer_);
    mesa().bind_framebuffer(GL_FRAMEBUFFER, framebuffer_);
    for (const auto& [attachment, format] :
         {std::pair(GL_COLOR_ATTACHMENT0, GL_RGBA8), {GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8}}) {
      GLuint buffer = 0;
      mesa().gen_renderbuffers(1, &buffer);
      mesa().bind_renderbuffer(GL_RENDERBUFFER, buffer);
      mesa().renderbuffer_storage_multisample(GL_RENDERBUFFER, samples, static_cast<GLenum>(format), width,
                                              height);
      mesa().framebuffer_renderbuffer(GL_FRAMEBUFFER, static_cast<GLenum>(attachment), GL_RENDERBUFFER,
                                      buffer);
    }
    if (mesa().check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("the rival has no buffer of " + std::to_string(samples) + " samples");
  }
  void bind() const { mesa().bind_framebuffer(GL_FRAMEBUFFER, framebuffer_); }
  /// Writes the means of the samples to the picture.
  void resolve() const {
    mesa().bind_framebuffer(GL_DRAW_FRAMEBUFFER, 0);
    mesa().blit_framebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }

 private:
  int width_, height_;
  GLuint framebuffer_ = 0;
};

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

void upload_texture(const GlWorkload& workload) {
  mesa().bind_texture(GL_TEXTURE_2D, 0);
  mesa().tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, workload.texture_size, workload.texture_size, 0, GL_RGBA,
                      GL_UNSIGNED_BYTE, workload.texels.data());
  mesa().generate_mipmap(GL_TEXTURE_2D);
  mesa().tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter_of(workload.sampler.mag));
  mesa().tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter_of(workload.sampler.min));
}

GLenum mode_of(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return GL_POINTS;
    case Primitive::lines: return GL_LINES;
    case Primitive::triangles: return GL_TRIANGLES;
    default: throw std::runtime_error("the rival draws points, lines and triangles only");
  }
}

class MesaWorkload : public bench::Workload {
 public:
  MesaWorkload(const GlWorkload& workload, int width, int height, MesaDriver driver, int threads)
      : context_(width, height, driver, threads), mode_(mode_of(workload.mesh.primitive)) {
    const GLuint program = link_and_use_program(workload.shaders);
    set_draws(program, workload.draws);
    if (workload.samples > 1) multisample_.emplace(width, height, workload.samples);
    set_vertex_attribute(0, workload.mesh.position_components, workload.mesh.positions);
    set_vertex_attribute(1, 3, workload.mesh.normals);
    set_vertex_attribute(2, 4, workload.mesh.colors);
    set_vertex_attribute(3, 2, workload.mesh.texcoords);
    if (!workload.mesh.indices.empty()) upload_buffer(GL_ELEMENT_ARRAY_BUFFER, workload.mesh.indices);
    index_count_ = static_cast<GLsizei>(workload.mesh.indices.size());
    revealed_indices_ = workload.revealed_indices;
    vertex_count_ = static_cast<GLsizei>(workload.mesh.vertex_count());
    if (workload.texture_size != 0) upload_texture(workload);
    mesa().disable(GL_DITHER);
    if (workload.culls_back) mesa().enable(GL_CULL_FACE);
    if (workload.tests_depth) {
      mesa().enable(GL_DEPTH_TEST);
      clear_mask_ |= kDepthAndStencil;
    }
    if (!workload.writes_color) mesa().color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    if (workload.blends) {
      mesa().enable(GL_BLEND);
      mesa().blend_func(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    if (workload.increments_stencil) {
      mesa().enable(GL_STENCIL_TEST);
      mesa().clear_stencil(1);
      mesa().stencil_func(GL_LESS, 0, 0xff);
      mesa().stencil_op(GL_KEEP, GL_KEEP, GL_INCR);
      clear_mask_ |= kDepthAndStencil;
    }
    mesa().clear_color(workload.clear_color.r, workload.clear_color.g, workload.clear_color.b, 1);
    if (mesa().get_error() != GL_NO_ERROR)
      throw std::runtime_error("the set-up of the rival causes an OpenGL error");
  }

  FrameStats draw() override {
    if (multisample_) multisample_->bind();
    mesa().clear(clear_mask_);
    if (draws_.empty()) draw_mesh();
    for (const Uniforms& uniforms : draws_) {
      mesa().uniform_matrix_4fv(matrix_location_, 1, GL_TRUE, uniforms.matrix.data());
      mesa().uniform_3fv(color_location_, 1, uniforms.color.data());
      draw_mesh();
    }
    if (multisample_) multisample_->resolve();
    mesa().finish();
    return {};
  }
  std::string fault() override {
    draw();
    if (revealed_indices_ > 0) reveal();
    return mesa().get_error() == GL_NO_ERROR ? "" : "drawing causes an OpenGL error";
  }
  const Picture& picture() override { return context_.picture(); }
  bench::FrameWork work(const FrameStats&) const override { return {}; }

 private:
  struct Uniforms {
    std::array<float, 16> matrix;  // rows
    std::array<float, 3> color;
  };
  void set_draws(GLuint program, const std::vector<bench::GlDraw>& draws) {
    if (draws.empty()) return;
    matrix_location_ = mesa().get_uniform_location(program, "clip_from_object");
    color_location_ = mesa().get_uniform_location(program, "color");
    for (const bench::GlDraw& draw : draws) {
      Uniforms& uniforms = draws_.emplace_back();
      std::transform(draw.clip_from_object.m.begin(), draw.clip_from_object.m.end(), uniforms.matrix.begin(),
                     [](double element) { return static_cast<float>(element); });
      uniforms.color = {draw.color.r, draw.color.g, draw.color.b};
    }
  }
  void draw_mesh() const {
    if (index_count_ > 0) mesa().draw_elements(mode_, index_count_, GL_UNSIGNED_INT, nullptr);
    else mesa().draw_arrays(mode_, 0, vertex_count_);
  }
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

  // Depth and stencil are packed into one word: clearing only one of them would read and write the buffer.
  static constexpr GLbitfield kDepthAndStencil = GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;

  MesaContext context_;
  GLenum mode_;
  std::optional<MultisampleBuffer> multisample_{};
  std::vector<Uniforms> draws_{};
  GLint matrix_location_ = -1;
  GLint color_location_ = -1;
  GLsizei index_count_ = 0;
  GLsizei vertex_count_ = 0;
  GLsizei revealed_indices_ = 0;
  GLbitfield clear_mask_ = GL_COLOR_BUFFER_BIT;
};

}  // namespace

std::unique_ptr<bench::Workload> mesa_workload(const GlWorkload& workload, int width, int height,
                                               MesaDriver driver, int threads) {
  return std::make_unique<MesaWorkload>(workload, width, height, driver, threads);
}

double mesa_finish_ms(int width, int height, MesaDriver driver, int threads) {
  constexpr int kFrames = 51;
  MesaContext context(width, height, driver, threads);
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
  const MesaContext context(1, 1, driver, threads);
  return gl_string(GL_RENDERER) + ", " + gl_string(GL_VERSION);
}

}  // namespace tessera::rivals
