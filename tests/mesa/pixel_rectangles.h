// Bitmaps and images at a window position. The fragment functions are set before; lighting and textures have
// no say.
#pragma once

#include "context.h"

namespace tessera::mesa {

void draw_bitmap(const Functions& gl, const reference::Bitmap& bitmap);
void draw_image(const Functions& gl, const reference::ImageDrawing& drawing);

}  // namespace tessera::mesa
