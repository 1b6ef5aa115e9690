// What rivals that run in OSMesa share: functions by name, programs from their sources, buffers.
#pragma once

#include <GL/osmesa.h>
// osmesa.h has OpenGL's own types
#include <GL/glext.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace tessera::rivals {

template <class Function>
Function load(const char* name) {
  const auto function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
  if (function == nullptr) throw std::runtime_error(std::string("OSMesa has no ") + name);
  return function;
}

/// A current context of 24 bits of depth that draws into `pixels`. @throws std::runtime_error
OSMesaContext make_context(void* pixels, int width, int height, int threads);
/// @throws std::runtime_error with what the compiler says
void use_program(const std::string& vertex_source, const std::string& fragment_source);
/// Makes a buffer of what does not change, and binds it.
void make_buffer(GLenum target, const void* data, std::size_t bytes);

}  // namespace tessera::rivals
