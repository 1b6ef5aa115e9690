#include "program_texturing.h"

#include "textures.h"

namespace tessera::mesa {
namespace {

using reference::MagFilter;
using reference::MinFilter;
using reference::PrimitiveType;

int texture_env_number(reference::TextureEnv env) {
  switch (env) {
    case reference::TextureEnv::kModulate: break;
    case reference::TextureEnv::kReplace: return 1;
    case reference::TextureEnv::kDecal: return 2;
    case reference::TextureEnv::kBlend: return 3;
    case reference::TextureEnv::kAdd: return 4;
  }
  return 0;
}

// OpenGL's constant c of 3.8.9; Mesa always uses 0.
double magnified_up_to(const reference::Texture& texture) {
  const bool is_sharper =
      texture.min == MinFilter::kNearestMipmapNearest || texture.min == MinFilter::kNearestMipmapLinear;
  return texture.mag == MagFilter::kLinear && is_sharper ? 0.5 : 0;
}

}  // namespace

bool asks_for_level(const reference::Texture& texture) {
  return texture.min != (texture.mag == MagFilter::kNearest ? MinFilter::kNearest : MinFilter::kLinear);
}

bool draws_lines(const reference::Draw& draw, const reference::Mesh& mesh) {
  switch (mesh.primitive) {
    case PrimitiveType::kPoints: return false;
    case PrimitiveType::kLines:
    case PrimitiveType::kLineStrip:
    case PrimitiveType::kLineLoop: return true;
    default:
      return draw.polygon_mode[0] == reference::PolygonMode::kLine ||
             draw.polygon_mode[1] == reference::PolygonMode::kLine;
  }
}

void set_program_texture(const Programs& programs, const reference::Draw& draw, const reference::Mesh& mesh,
                         const reference::Texture* texture) {
  programs.set("image", kImageUnit);
  programs.set("row", kRowUnit);
  if (texture == nullptr) {
    programs.set("texture_dimensions", 0);
    return;
  }
  programs.set("texture_dimensions", is_row(*texture) ? 1 : 2);
  const reference::Image& image = texture->image;
  Vectors size;
  Vectors env_color;
  append(size, {static_cast<double>(image.width), is_row(*texture) ? 0.0 : image.height,
                draws_lines(draw, mesh) ? 1.0 : 0.0, magnified_up_to(*texture)});
  append(env_color, draw.texture_env_color);
  programs.set("texture_size", size);
  programs.set("texture_env", texture_env_number(draw.texture_env));
  programs.set("texture_has_alpha", image.channels % 2 == 0 ? 1 : 0);
  programs.set("texture_env_color", env_color);
}

}  // namespace tessera::mesa
