// An OpenGL context, and a frame buffer object or OSMesa's window to draw into.
#pragma once

#define GL_GLEXT_PROTOTYPES 0
#include <GL/osmesa.h>
// glext.h needs the types of osmesa.h.
#include <GL/glext.h>

#include <cstdint>
#include <string>
#include <vector>

#include "buffers.h"
#include "tests/reference/scene.h"

namespace tessera::mesa {

/// OpenGL functions newer than 1.1, loaded from the current context.
struct Functions {
  PFNGLPROVOKINGVERTEXPROC provoking_vertex;
  PFNGLCLIPCONTROLPROC clip_control;
  PFNGLVIEWPORTINDEXEDFPROC viewport_indexed;
  PFNGLACTIVETEXTUREPROC active_texture;
  PFNGLWINDOWPOS3DPROC window_pos_3d;

  PFNGLBLENDCOLORPROC blend_color;
  PFNGLBLENDEQUATIONPROC blend_equation;
  PFNGLBLENDFUNCSEPARATEPROC blend_func_separate;
  PFNGLSTENCILFUNCSEPARATEPROC stencil_func_separate;
  PFNGLSTENCILOPSEPARATEPROC stencil_op_separate;
  PFNGLSTENCILMASKSEPARATEPROC stencil_mask_separate;

  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers;
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer;
  PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer;

  PFNGLCREATESHADERPROC create_shader;
  PFNGLSHADERSOURCEPROC shader_source;
  PFNGLCOMPILESHADERPROC compile_shader;
  PFNGLGETSHADERIVPROC get_shader_iv;
  PFNGLGETSHADERINFOLOGPROC get_shader_info_log;
  PFNGLCREATEPROGRAMPROC create_program;
  PFNGLATTACHSHADERPROC attach_shader;
  PFNGLLINKPROGRAMPROC link_program;
  PFNGLGETPROGRAMIVPROC get_program_iv;
  PFNGLGETPROGRAMINFOLOGPROC get_program_info_log;
  PFNGLUSEPROGRAMPROC use_program;
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location;
  PFNGLUNIFORM1IPROC uniform_1i;
  PFNGLUNIFORM4FVPROC uniform_4fv;
};

/// An OpenGL context, current on the thread that created it until it is destroyed. Owns all its objects.
class Context {
 public:
  /// @throws std::runtime_error if OSMesa cannot make such a context or frame buffer.
  Context(int width_px, int height_px, const Buffers& buffers);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const Functions& functions() const { return functions_; }

  /// Red, green and blue of each pixel, rows from the bottom.
  std::vector<float> read_colors() const;

 private:
  void load_functions();
  void make_frame_buffer(const Buffers& buffers);

  int width_, height_;
  std::vector<std::uint32_t> window_;  // required by OSMesa; a single pixel if unused
  OSMesaContext context_ = nullptr;
  Functions functions_{};
};

/// @throws std::runtime_error if OpenGL has recorded an error since the last call.
void check_errors(const std::string& doing);

}  // namespace tessera::mesa
