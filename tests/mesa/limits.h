// What Mesa cannot follow.
#pragma once

#include <optional>
#include <string>

#include "tests/reference/scene.h"

namespace tessera::mesa {

/// What an index buffer cleared to an index shows, if it can be told from the colour alone afterwards.
std::optional<reference::Rgb8> cleared_entry(std::uint32_t index, const reference::FrameBufferFormat& format);

/// The first reason found; nothing if Mesa can follow.
std::optional<std::string> first_limit(const reference::Scene& scene);

}  // namespace tessera::mesa
