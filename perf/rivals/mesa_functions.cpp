#include "perf/rivals/mesa_functions.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace tessera::rivals {
namespace {

constexpr const char* kLibrary = "libOSMesa.so.8";

class Library {
 public:
  Library() : handle_(dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr)
      throw std::runtime_error(std::string("cannot load ") + kLibrary +
                               ", which --rivals needs (Debian package libosmesa6)");
    address_of_ = symbol<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  }
  template <class Function>
  Function symbol(const char* name) const {
    return checked(reinterpret_cast<Function>(dlsym(handle_, name)), name);
  }
  /// Loads an OpenGL function.
  template <class Function>
  void load(Function& function, const char* name) const {
    function = checked(reinterpret_cast<Function>(address_of_(name)), name);
  }

 private:
  template <class Function>
  static Function checked(Function function, const char* name) {
    if (function == nullptr) throw std::runtime_error(std::string(kLibrary) + " has no function " + name);
    return function;
  }
  void* handle_;
  decltype(&OSMesaGetProcAddress) address_of_;
};

MesaFunctions load() {
  const Library library;  // never closed: its threads keep running
  MesaFunctions f{};
  f.create_context = library.symbol<decltype(f.create_context)>("OSMesaCreateContextAttribs");
  f.make_current = library.symbol<decltype(f.make_current)>("OSMesaMakeCurrent");
  f.destroy_context = library.symbol<decltype(f.destroy_context)>("OSMesaDestroyContext");
  f.pixel_store = library.symbol<decltype(f.pixel_store)>("OSMesaPixelStore");
  library.load(f.bind_texture, "glBindTexture");
  library.load(f.blend_func, "glBlendFunc");
  library.load(f.clear, "glClear");
  library.load(f.clear_color, "glClearColor");
  library.load(f.clear_stencil, "glClearStencil");
  library.load(f.color_mask, "glColorMask");
  library.load(f.depth_func, "glDepthFunc");
  library.load(f.disable, "glDisable");
  library.load(f.draw_arrays, "glDrawArrays");
  library.load(f.draw_elements, "glDrawElements");
  library.load(f.enable, "glEnable");
  library.load(f.finish, "glFinish");
  library.load(f.get_error, "glGetError");
  library.load(f.get_string, "glGetString");
  library.load(f.scissor, "glScissor");
  library.load(f.stencil_func, "glStencilFunc");
  library.load(f.stencil_op, "glStencilOp");
  library.load(f.tex_image_2d, "glTexImage2D");
  library.load(f.tex_parameteri, "glTexParameteri");
  library.load(f.attach_shader, "glAttachShader");
  library.load(f.bind_buffer, "glBindBuffer");
  library.load(f.bind_framebuffer, "glBindFramebuffer");
  library.load(f.bind_renderbuffer, "glBindRenderbuffer");
  library.load(f.blit_framebuffer, "glBlitFramebuffer");
  library.load(f.buffer_data, "glBufferData");
  library.load(f.check_framebuffer_status, "glCheckFramebufferStatus");
  library.load(f.compile_shader, "glCompileShader");
  library.load(f.create_program, "glCreateProgram");
  library.load(f.create_shader, "glCreateShader");
  library.load(f.enable_vertex_attrib_array, "glEnableVertexAttribArray");
  library.load(f.framebuffer_renderbuffer, "glFramebufferRenderbuffer");
  library.load(f.gen_buffers, "glGenBuffers");
  library.load(f.gen_framebuffers, "glGenFramebuffers");
  library.load(f.gen_renderbuffers, "glGenRenderbuffers");
  library.load(f.generate_mipmap, "glGenerateMipmap");
  library.load(f.get_shader_info_log, "glGetShaderInfoLog");
  library.load(f.get_shaderiv, "glGetShaderiv");
  library.load(f.get_uniform_location, "glGetUniformLocation");
  library.load(f.link_program, "glLinkProgram");
  library.load(f.renderbuffer_storage_multisample, "glRenderbufferStorageMultisample");
  library.load(f.shader_source, "glShaderSource");
  library.load(f.uniform_3fv, "glUniform3fv");
  library.load(f.uniform_matrix_4fv, "glUniformMatrix4fv");
  library.load(f.use_program, "glUseProgram");
  library.load(f.vertex_attrib_pointer, "glVertexAttribPointer");
  return f;
}

}  // namespace

const MesaFunctions& mesa() {
  static const MesaFunctions kFunctions = load();
  return kFunctions;
}

}  // namespace tessera::rivals
