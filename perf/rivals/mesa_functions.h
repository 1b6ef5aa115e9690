// Functions of OSMesa, loaded on first use. The program does not depend on the library, and measurements
// without rivals do not load its 100 MB.
#pragma once

#include <GL/osmesa.h>
// After osmesa.h: needs its OpenGL types.
#include <GL/glext.h>

namespace tessera::rivals {

struct MesaFunctions {
  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaPixelStore) pixel_store;
  decltype(&glBindTexture) bind_texture;
  decltype(&glBlendFunc) blend_func;
  decltype(&glClear) clear;
  decltype(&glClearColor) clear_color;
  decltype(&glClearStencil) clear_stencil;
  decltype(&glColorMask) color_mask;
  decltype(&glDepthFunc) depth_func;
  decltype(&glDisable) disable;
  decltype(&glDrawArrays) draw_arrays;
  decltype(&glDrawElements) draw_elements;
  decltype(&glEnable) enable;
  decltype(&glFinish) finish;
  decltype(&glGetError) get_error;
  decltype(&glGetString) get_string;
  decltype(&glScissor) scissor;
  decltype(&glStencilFunc) stencil_func;
  decltype(&glStencilOp) stencil_op;
  decltype(&glTexImage2D) tex_image_2d;
  decltype(&glTexParameteri) tex_parameteri;
  PFNGLATTACHSHADERPROC attach_shader;
  PFNGLBINDBUFFERPROC bind_buffer;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer;
  PFNGLBLITFRAMEBUFFERPROC blit_framebuffer;
  PFNGLBUFFERDATAPROC buffer_data;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
  PFNGLCOMPILESHADERPROC compile_shader;
  PFNGLCREATEPROGRAMPROC create_program;
  PFNGLCREATESHADERPROC create_shader;
  PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer;
  PFNGLGENBUFFERSPROC gen_buffers;
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers;
  PFNGLGENERATEMIPMAPPROC generate_mipmap;
  PFNGLGETSHADERINFOLOGPROC get_shader_info_log;
  PFNGLGETSHADERIVPROC get_shaderiv;
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location;
  PFNGLLINKPROGRAMPROC link_program;
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC renderbuffer_storage_multisample;
  PFNGLSHADERSOURCEPROC shader_source;
  PFNGLUNIFORM3FVPROC uniform_3fv;
  PFNGLUNIFORMMATRIX4FVPROC uniform_matrix_4fv;
  PFNGLUSEPROGRAMPROC use_program;
  PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer;
};

/// @throws std::runtime_error if OSMesa or one of its functions is missing
const MesaFunctions& mesa();

}  // namespace tessera::rivals
