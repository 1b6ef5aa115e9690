#include "context.h"

#include <cstdlib>
#include <stdexcept>

namespace tessera::mesa {
namespace {

GLenum internal_format(reference::DepthFormat depth) {
  switch (depth) {
    case reference::DepthFormat::kNone: break;
    case reference::DepthFormat::kUnorm16: return GL_DEPTH_COMPONENT16;
    case reference::DepthFormat::kUnorm24: return GL_DEPTH_COMPONENT24;
    case reference::DepthFormat::kUnorm32: return GL_DEPTH_COMPONENT32;
    case reference::DepthFormat::kFloat32: return GL_DEPTH_COMPONENT32F;
  }
  return GL_NONE;
}

GLenum format_with_stencil(reference::DepthFormat depth) {
  if (depth == reference::DepthFormat::kNone) return GL_STENCIL_INDEX8;
  return depth == reference::DepthFormat::kFloat32 ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8;
}

template <class F>
void load(F& function, const char* name) {
  function = reinterpret_cast<F>(OSMesaGetProcAddress(name));
  if (function == nullptr) throw std::runtime_error(std::string("OSMesa has no ") + name);
}

// By default Mesa filters with weights of 8 bits and computes one level of detail for each four pixels. It
// reads this variable when the process creates its first context.
void ask_for_exact_filters() { setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 0); }

GLenum color_format(ColorStore color) {
  switch (color) {
    case ColorStore::kFloat: return GL_RGBA32F;
    case ColorStore::kBytes: return GL_RGB8;
    default: return GL_RGBA8;
  }
}

}  // namespace

Context::Context(int width_px, int height_px, const Buffers& buffers) : width_(width_px), height_(height_px) {
  const bool in_window = buffers.color == ColorStore::kWindow;
  const int window_width = in_window ? width_px : 1;
  const int window_height = in_window ? height_px : 1;
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            in_window ? 24 : 0,
                            OSMESA_STENCIL_BITS,
                            in_window ? 8 : 0,
                            OSMESA_ACCUM_BITS,
                            in_window ? 16 : 0,
                            OSMESA_PROFILE,
                            OSMESA_COMPAT_PROFILE,
                            0};
  window_.resize(static_cast<std::size_t>(window_width) * static_cast<std::size_t>(window_height));
  ask_for_exact_filters();
  context_ = OSMesaCreateContextAttribs(attributes, nullptr);
  if (context_ == nullptr) throw std::runtime_error("OSMesa cannot make a context");
  try {
    if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, window_width, window_height))
      throw std::runtime_error("OSMesa cannot make its context current");
    load_functions();
    if (!in_window) make_frame_buffer(buffers);
    glDisable(GL_DITHER);
    glClearColor(0, 0, 0, buffers.color == ColorStore::kBytesAndAlpha || in_window ? 0 : 1);
    glClearDepth(1);
    glClearAccum(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT |
            (in_window ? GL_ACCUM_BUFFER_BIT : 0));
    check_errors("making the buffers");
  } catch (...) {
    OSMesaDestroyContext(context_);
    throw;
  }
}

Context::~Context() { OSMesaDestroyContext(context_); }

void Context::load_functions() {
  Functions& f = functions_;
  load(f.provoking_vertex, "glProvokingVertex");
  load(f.clip_control, "glClipControl");
  load(f.viewport_indexed, "glViewportIndexedf");
  load(f.active_texture, "glActiveTexture");
  load(f.window_pos_3d, "glWindowPos3d");
  load(f.blend_color, "glBlendColor");
  load(f.blend_equation, "glBlendEquation");
  load(f.blend_func_separate, "glBlendFuncSeparate");
  load(f.stencil_func_separate, "glStencilFuncSeparate");
  load(f.stencil_op_separate, "glStencilOpSeparate");
  load(f.stencil_mask_separate, "glStencilMaskSeparate");
  load(f.gen_framebuffers, "glGenFramebuffers");
  load(f.bind_framebuffer, "glBindFramebuffer");
  load(f.check_framebuffer_status, "glCheckFramebufferStatus");
  load(f.gen_renderbuffers, "glGenRenderbuffers");
  load(f.bind_renderbuffer, "glBindRenderbuffer");
  load(f.renderbuffer_storage, "glRenderbufferStorage");
  load(f.framebuffer_renderbuffer, "glFramebufferRenderbuffer");
  load(f.create_shader, "glCreateShader");
  load(f.shader_source, "glShaderSource");
  load(f.compile_shader, "glCompileShader");
  load(f.get_shader_iv, "glGetShaderiv");
  load(f.get_shader_info_log, "glGetShaderInfoLog");
  load(f.create_program, "glCreateProgram");
  load(f.attach_shader, "glAttachShader");
  load(f.link_program, "glLinkProgram");
  load(f.get_program_iv, "glGetProgramiv");
  load(f.get_program_info_log, "glGetProgramInfoLog");
  load(f.use_program, "glUseProgram");
  load(f.get_uniform_location, "glGetUniformLocation");
  load(f.uniform_1i, "glUniform1i");
  load(f.uniform_4fv, "glUniform4fv");
}

void Context::make_frame_buffer(const Buffers& buffers) {
  const Functions& f = functions_;
  GLuint frame_buffer = 0;
  GLuint names[2] = {};
  f.gen_framebuffers(1, &frame_buffer);
  f.bind_framebuffer(GL_FRAMEBUFFER, frame_buffer);
  f.gen_renderbuffers(2, names);
  const auto attach = [&](GLuint buffer, GLenum attachment, GLenum format) {
    f.bind_renderbuffer(GL_RENDERBUFFER, buffer);
    f.renderbuffer_storage(GL_RENDERBUFFER, format, width_, height_);
    f.framebuffer_renderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(names[0], GL_COLOR_ATTACHMENT0, color_format(buffers.color));
  const bool has_depth = buffers.depth != reference::DepthFormat::kNone;
  if (buffers.stencil)
    attach(names[1], has_depth ? GL_DEPTH_STENCIL_ATTACHMENT : GL_STENCIL_ATTACHMENT,
           format_with_stencil(buffers.depth));
  else if (has_depth) attach(names[1], GL_DEPTH_ATTACHMENT, internal_format(buffers.depth));
  if (f.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OSMesa cannot make the frame buffer");
}

std::vector<float> Context::read_colors() const {
  std::vector<float> colors(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_FLOAT, colors.data());
  check_errors("reading the picture");
  return colors;
}

void check_errors(const std::string& doing) {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL error " + std::to_string(error) + " while " + doing);
}

}  // namespace tessera::mesa
