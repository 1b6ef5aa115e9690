#include "textures.h"

#include "image_format.h"
#include "tests/reference/texture_sampler.h"

namespace tessera::mesa {
namespace {

GLint filter(reference::MagFilter mag) {
  return mag == reference::MagFilter::kNearest ? GL_NEAREST : GL_LINEAR;
}

GLint filter(reference::MinFilter min) {
  switch (min) {
    case reference::MinFilter::kNearest: return GL_NEAREST;
    case reference::MinFilter::kLinear: return GL_LINEAR;
    case reference::MinFilter::kNearestMipmapNearest: return GL_NEAREST_MIPMAP_NEAREST;
    case reference::MinFilter::kLinearMipmapNearest: return GL_LINEAR_MIPMAP_NEAREST;
    case reference::MinFilter::kNearestMipmapLinear: return GL_NEAREST_MIPMAP_LINEAR;
    case reference::MinFilter::kLinearMipmapLinear: return GL_LINEAR_MIPMAP_LINEAR;
  }
  return GL_LINEAR;
}

GLint wrap_mode(reference::Wrap wrap) {
  switch (wrap) {
    case reference::Wrap::kRepeat: return GL_REPEAT;
    case reference::Wrap::kClampToEdge: return GL_CLAMP_TO_EDGE;
    case reference::Wrap::kMirroredRepeat: return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

GLint environment(reference::TextureEnv env) {
  switch (env) {
    case reference::TextureEnv::kModulate: return GL_MODULATE;
    case reference::TextureEnv::kReplace: return GL_REPLACE;
    case reference::TextureEnv::kDecal: return GL_DECAL;
    case reference::TextureEnv::kBlend: return GL_BLEND;
    case reference::TextureEnv::kAdd: return GL_ADD;
  }
  return GL_MODULATE;
}

// 8 bits per channel, so that the filters see exactly the image.
GLint stored_format(const reference::Image& image) {
  switch (image.channels) {
    case 1: return GL_LUMINANCE8;
    case 2: return GL_LUMINANCE8_ALPHA8;
    case 3: return GL_RGB8;
    default: return GL_RGBA8;
  }
}

void upload_level(GLenum target, GLint level, const reference::Image& image) {
  const GLenum format = pixel_format(image);
  const GLint stored = stored_format(image);
  if (target == GL_TEXTURE_1D)
    glTexImage1D(target, level, stored, image.width, 0, format, GL_UNSIGNED_BYTE, image.levels.data());
  else
    glTexImage2D(target, level, stored, image.width, image.height, 0, format, GL_UNSIGNED_BYTE,
                 image.levels.data());
}

bool has_mipmaps(reference::MinFilter min) {
  return min != reference::MinFilter::kNearest && min != reference::MinFilter::kLinear;
}

GLenum target(const reference::Texture& texture) { return is_row(texture) ? GL_TEXTURE_1D : GL_TEXTURE_2D; }

}  // namespace

// Each mipmap level comes from the reference: OpenGL does not specify how mipmaps are computed.
GLuint Textures::uploaded(std::size_t number) {
  GLuint& name = names_.at(number);
  if (name != 0) return name;
  const reference::Texture& texture = textures_[number];
  const GLenum to = target(texture);
  glGenTextures(1, &name);
  glBindTexture(to, name);
  glTexParameteri(to, GL_TEXTURE_MAG_FILTER, filter(texture.mag));
  glTexParameteri(to, GL_TEXTURE_MIN_FILTER, filter(texture.min));
  glTexParameteri(to, GL_TEXTURE_WRAP_S, wrap_mode(texture.wrap_s));
  if (to == GL_TEXTURE_2D) glTexParameteri(to, GL_TEXTURE_WRAP_T, wrap_mode(texture.wrap_t));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  reference::Image image = texture.image;
  upload_level(to, 0, image);
  for (GLint level = 1; has_mipmaps(texture.min) && (image.width > 1 || image.height > 1); ++level) {
    image = reference::next_mipmap(image);
    upload_level(to, level, image);
  }
  return name;
}

void Textures::use(const reference::Draw& draw) {
  use_none();
  if (!draw.texture) return;
  const GLuint name = uploaded(*draw.texture);
  const GLenum to = target(textures_[*draw.texture]);
  if (to == GL_TEXTURE_1D) {
    functions_.active_texture(GL_TEXTURE0 + kRowUnit);
    glBindTexture(to, name);
    functions_.active_texture(GL_TEXTURE0 + kImageUnit);
  }
  glBindTexture(to, name);
  glEnable(to);
  const reference::Vec4 c = draw.texture_env_color;
  const GLfloat color[4] = {static_cast<GLfloat>(c.x), static_cast<GLfloat>(c.y), static_cast<GLfloat>(c.z),
                            static_cast<GLfloat>(c.w)};
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, environment(draw.texture_env));
  glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, color);
}

void Textures::use_none() {
  glDisable(GL_TEXTURE_1D);
  glDisable(GL_TEXTURE_2D);
}

}  // namespace tessera::mesa
