// What Mesa cannot follow of textures and images.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// @param draw  as as_drawn() gives it
/// @return the first reason found; nothing if Mesa can follow
std::optional<std::string> texture_limit(const reference::Draw& draw, const reference::Scene& scene);

std::optional<std::string> bitmap_limit(const reference::Bitmap& bitmap);
std::optional<std::string> image_limit(const reference::ImageDrawing& drawing);

}  // namespace tessera::mesa
