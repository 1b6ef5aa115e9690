#include "texture_limits.h"

#include <algorithm>
#include <cmath>

#include "program_texturing.h"

namespace tessera::mesa {
namespace {

using Reason = std::optional<std::string>;

// Mesa's limit; also for bitmaps and images, which it draws as textures.
constexpr int kLargestTexture = 16384;

bool is_too_large(int width, int height) { return std::max(width, height) > kLargestTexture; }

// Mesa rounds the raster position. With a zoom of 1 this matters only halfway between two pixels.
bool is_moved(double at, double zoom) {
  const double fraction = at - std::floor(at);
  return fraction != 0 && (std::abs(zoom) != 1 || fraction == 0.5);
}

// Whether a pixel's centre lies on the border between two image pixels. Mesa finds the texel in float and may
// choose either.
bool meets_a_center(double at, double zoom, int count) {
  for (int n = 1; n <= count; ++n) {
    const double border = at + zoom * n;
    if (std::abs(border - std::floor(border) - 0.5) < 1e-4) return true;
  }
  return false;
}

}  // namespace

Reason texture_limit(const reference::Draw& draw, const reference::Scene& scene) {
  if (!draw.texture) return std::nullopt;
  const reference::Texture& texture = scene.textures.at(*draw.texture);
  const reference::Image& image = texture.image;
  if (is_too_large(image.width, image.height)) return "a texture beyond Mesa's";
  if (draw.texture_env == reference::TextureEnv::kDecal && image.channels < 3)
    return "OpenGL leaves the decal of luminance open";
  const bool fills = draw.polygon_mode[0] == reference::PolygonMode::kFill ||
                     draw.polygon_mode[1] == reference::PolygonMode::kFill;
  const bool outlines = draw.polygon_mode[0] == reference::PolygonMode::kLine ||
                        draw.polygon_mode[1] == reference::PolygonMode::kLine;
  if (fills && outlines && asks_for_level(texture))
    return "a level of detail for lines on one side and for polygons on the other";
  return std::nullopt;
}

Reason bitmap_limit(const reference::Bitmap& bitmap) {
  if (is_too_large(bitmap.width, bitmap.height)) return "a bitmap beyond Mesa's textures";
  return std::nullopt;
}

Reason image_limit(const reference::ImageDrawing& drawing) {
  if (is_too_large(drawing.image.width, drawing.image.height)) return "an image beyond Mesa's textures";
  if (is_moved(drawing.at[0], drawing.zoom[0]) || is_moved(drawing.at[1], drawing.zoom[1]))
    return "Mesa rounds the position of an image";
  if (meets_a_center(drawing.at[0], drawing.zoom[0], drawing.image.width) ||
      meets_a_center(drawing.at[1], drawing.zoom[1], drawing.image.height))
    return "a pixel's centre between two of an image's: Mesa takes either";
  return std::nullopt;
}

}  // namespace tessera::mesa
