// Draws bitmaps [GL 2.1, 3.7] and images [3.6.4, with several samples 3.6.6] at a window position.
#pragma once

#include <cstdint>

#include "sample_buffers.h"
#include "scene.h"

namespace tessera::reference {

/// @param command  index in Scene::frame
void draw_bitmap(const Bitmap& bitmap, std::int32_t command, SampleBuffers& buffers);
void draw_image(const ImageDrawing& drawing, std::int32_t command, SampleBuffers& buffers);

}  // namespace tessera::reference
