// Scenes that Mesa cannot render as specified.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// Displayed colour of an index buffer cleared to `index`, if the index is recoverable from the colour.
std::optional<reference::Rgb8> cleared_entry(std::uint32_t index, const reference::FrameBufferFormat& format);

/// The first reason found; none if Mesa can render the scene.
std::optional<std::string> first_limit(const reference::Scene& scene);

}  // namespace tessera::mesa
