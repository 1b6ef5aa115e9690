#include "pixel_rectangles.h"

#include "image_format.h"

namespace tessera::mesa {
namespace {

// Each row starts at a new byte, most significant bit left.
std::vector<GLubyte> packed(const reference::Bitmap& bitmap) {
  const auto width = static_cast<std::size_t>(bitmap.width);
  const auto height = static_cast<std::size_t>(bitmap.height);
  const auto row_bytes = (width + 7) / 8;
  std::vector<GLubyte> bytes(row_bytes * height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      if (bitmap.bits[y * width + x]) bytes[y * row_bytes + x / 8] |= static_cast<GLubyte>(0x80u >> x % 8);
  return bytes;
}

void go_to(const Functions& gl, const std::array<double, 2>& at, double depth) {
  glDepthRange(0, 1);  // The raster position's depth would otherwise be mapped to the range.
  gl.window_pos_3d(at[0], at[1], depth);
}

}  // namespace

// The raster colour is the current colour at the time of glRasterPos. Mesa gathers bitmaps and draws them
// together, so overlapping ones would merge; flushing draws each by itself.
void draw_bitmap(const Functions& gl, const reference::Bitmap& bitmap) {
  const reference::Vec4 c = bitmap.color;
  glColor4d(c.x, c.y, c.z, c.w);
  go_to(gl, bitmap.at, bitmap.raster_depth);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glBitmap(bitmap.width, bitmap.height, 0, 0, 0, 0, packed(bitmap).data());
  glFlush();
}

void draw_image(const Functions& gl, const reference::ImageDrawing& drawing) {
  const reference::Image& image = drawing.image;
  go_to(gl, drawing.at, drawing.raster_depth);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelZoom(static_cast<GLfloat>(drawing.zoom[0]), static_cast<GLfloat>(drawing.zoom[1]));
  glDrawPixels(image.width, image.height, pixel_format(image), GL_UNSIGNED_BYTE, image.levels.data());
}

}  // namespace tessera::mesa
