#include "programs.h"

#include <stdexcept>

#include "program_sources.h"

namespace tessera::mesa {
namespace {

using Parts = std::vector<const char*>;

void attach(const Functions& gl, GLuint program, GLenum type, const Parts& parts) {
  const GLuint shader = gl.create_shader(type);
  gl.shader_source(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  gl.compile_shader(shader);
  GLint compiled = 0;
  gl.get_shader_iv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    char log[2000] = {};
    gl.get_shader_info_log(shader, sizeof log, nullptr, log);
    throw std::runtime_error(std::string("GLSL: ") + log);
  }
  gl.attach_shader(program, shader);
}

void link(const Functions& gl, GLuint program) {
  gl.link_program(program);
  GLint linked = 0;
  gl.get_program_iv(program, GL_LINK_STATUS, &linked);
  if (linked != 0) return;
  char log[2000] = {};
  gl.get_program_info_log(program, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("GLSL: ") + log);
}

}  // namespace

GLuint Programs::made(LightingBy lighting, bool texturing) const {
  const Functions& gl = functions_;
  const bool at_pixels = lighting == LightingBy::kFragmentProgram;
  if (lighting == LightingBy::kFixedFunctions && !texturing) return 0;
  const GLuint name = gl.create_program();
  if (lighting != LightingBy::kFixedFunctions)
    attach(gl, name, GL_VERTEX_SHADER,
           {kVersion, kLighting, kEyeNormal, at_pixels ? kPixelLitVertex : kVertexLit});
  if (at_pixels) attach(gl, name, GL_FRAGMENT_SHADER, {kVersion, kLighting, kTexturing, kPixelLitFragment});
  else if (texturing) attach(gl, name, GL_FRAGMENT_SHADER, {kVersion, kTexturing, kTexturedFragment});
  link(gl, name);
  return name;
}

void Programs::use(LightingBy lighting, bool texturing) {
  const auto [program, is_new] = made_.try_emplace({lighting, texturing}, 0);
  if (is_new) program->second = made(lighting, texturing);
  used_ = program->second;
  functions_.use_program(used_);
}

void Programs::set(const char* uniform, int value) const {
  if (used_ != 0) functions_.uniform_1i(functions_.get_uniform_location(used_, uniform), value);
}

void Programs::set(const char* uniform, const Vectors& values) const {
  if (used_ != 0)
    functions_.uniform_4fv(functions_.get_uniform_location(used_, uniform),
                           static_cast<GLsizei>(values.size() / 4), values.data());
}

}  // namespace tessera::mesa
