#include "perf/rivals/osmesa.h"

#include <cstdlib>

namespace tessera::rivals {

OSMesaContext make_context(void* pixels, int width, int height, int threads) {
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  constexpr int kAttributes[] = {
      OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
  OSMesaContext context = OSMesaCreateContextAttribs(kAttributes, nullptr);
  if (context == nullptr || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height))
    throw std::runtime_error("OSMesa makes no context");
  return context;
}

void use_program(const std::string& vertex_source, const std::string& fragment_source) {
  const auto program = load<PFNGLCREATEPROGRAMPROC>("glCreateProgram")();
  const auto attach = [&](GLenum kind, const std::string& source) {
    const GLuint shader = load<PFNGLCREATESHADERPROC>("glCreateShader")(kind);
    const char* text = source.c_str();
    load<PFNGLSHADERSOURCEPROC>("glShaderSource")(shader, 1, &text, nullptr);
    load<PFNGLCOMPILESHADERPROC>("glCompileShader")(shader);
    GLint good = 0;
    load<PFNGLGETSHADERIVPROC>("glGetShaderiv")(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
      char log[2000];
      load<PFNGLGETSHADERINFOLOGPROC>("glGetShaderInfoLog")(shader, sizeof log, nullptr, log);
      throw std::runtime_error(std::string("a shader of the rival does not compile: ") + log);
    }
    load<PFNGLATTACHSHADERPROC>("glAttachShader")(program, shader);
  };
  attach(GL_VERTEX_SHADER, vertex_source);
  attach(GL_FRAGMENT_SHADER, fragment_source);
  load<PFNGLLINKPROGRAMPROC>("glLinkProgram")(program);
  load<PFNGLUSEPROGRAMPROC>("glUseProgram")(program);
}

void make_buffer(GLenum target, const void* data, std::size_t bytes) {
  GLuint name = 0;
  load<PFNGLGENBUFFERSPROC>("glGenBuffers")(1, &name);
  load<PFNGLBINDBUFFERPROC>("glBindBuffer")(target, name);
  load<PFNGLBUFFERDATAPROC>("glBufferData")(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
}

}  // namespace tessera::rivals
