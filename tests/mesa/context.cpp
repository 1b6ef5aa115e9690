#include "context.h"

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

template <class F>
void load(F& function, const char* name) {
  function = reinterpret_cast<F>(OSMesaGetProcAddress(name));
  if (function == nullptr) throw std::runtime_error(std::string("OSMesa has no ") + name);
}

}  // namespace

Context::Context(const reference::FrameBufferFormat& format) : width_(format.width_px), height_(format.height_px) {
  constexpr int kAttributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
  context_ = OSMesaCreateContextAttribs(kAttributes, nullptr);
  if (context_ == nullptr) throw std::runtime_error("OSMesa cannot make a context");
  try {
    if (!OSMesaMakeCurrent(context_, &window_pixel_, GL_UNSIGNED_BYTE, 1, 1)) throw std::runtime_error("OSMesa cannot make its context current");
    load_functions();
    make_frame_buffer(format.depth);
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

// Fresh buffers hold colour 0 and depth 1.
void Context::make_frame_buffer(reference::DepthFormat depth) {
  const Functions& f = functions_;
  GLuint frame_buffer = 0, buffers[2] = {};
  f.gen_framebuffers(1, &frame_buffer);
  f.bind_framebuffer(GL_FRAMEBUFFER, frame_buffer);
  f.gen_renderbuffers(2, buffers);
  const auto attach = [&](GLuint buffer, GLenum attachment, GLenum format) {
    f.bind_renderbuffer(GL_RENDERBUFFER, buffer);
    f.renderbuffer_storage(GL_RENDERBUFFER, format, width_, height_);
    f.framebuffer_renderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(buffers[0], GL_COLOR_ATTACHMENT0, GL_RGBA32F);
  if (depth != reference::DepthFormat::kNone) attach(buffers[1], GL_DEPTH_ATTACHMENT, internal_format(depth));
  if (f.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw std::runtime_error("OSMesa cannot make the frame buffer");
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  check_errors("making the frame buffer");
}

std::vector<float> Context::read_colors() const {
  std::vector<float> colors(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_FLOAT, colors.data());
  check_errors("reading the picture");
  return colors;
}

void check_errors(const std::string& doing) {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error) + " while " + doing);
}

}  // namespace tessera::mesa
