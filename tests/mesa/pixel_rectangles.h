// Bitmaps and images at a window position. Set the fragment functions first; lighting and textures do not
// apply.
#pragma once

#include "context.h"

namespace tessera::mesa {

void draw_bitmap(const Functions& gl, const reference::Bitmap& bitmap);
void draw_image(const Functions& gl, const reference::ImageDrawing& drawing);

}  // namespace tessera::mesa
