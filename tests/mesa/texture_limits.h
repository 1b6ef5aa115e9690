// Textures and images that Mesa cannot render as specified.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// @param draw  as returned by as_drawn()
/// @return the first reason found; none if Mesa can render the draw
std::optional<std::string> texture_limit(const reference::Draw& draw, const reference::Scene& scene);

std::optional<std::string> bitmap_limit(const reference::Bitmap& bitmap);
std::optional<std::string> image_limit(const reference::ImageDrawing& drawing);

}  // namespace tessera::mesa
