// OpenGL's names for the channels of an image.
#pragma once

#include "context.h"

namespace tessera::mesa {

inline GLenum pixel_format(const reference::Image& image) {
  switch (image.channels) {
    case 1: return GL_LUMINANCE;
    case 2: return GL_LUMINANCE_ALPHA;
    case 3: return GL_RGB;
    default: return GL_RGBA;
  }
}

}  // namespace tessera::mesa
