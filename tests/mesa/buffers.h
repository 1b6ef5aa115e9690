// Which buffers Mesa gets for a scene.
#pragma once

#include <array>
#include <optional>

#include "tests/reference/scene.h"

namespace tessera::mesa {

enum class ColorStore {
  kFloat,  ///< nothing reads the colour buffer: colours become levels or palette entries when the frame is
           ///< finished
  kBytes,  ///< 8 bits a component and no alpha, for what reads it
  kBytesAndAlpha,
  kWindow  ///< 8 bits a component with alpha, in OSMesa's window: the only one that has an accumulation
           ///< buffer
};

struct Buffers {
  ColorStore color = ColorStore::kFloat;
  reference::DepthFormat depth = reference::DepthFormat::kNone;
  bool stencil = false;
};

/// What the fragments of a draw, a bitmap or an image obey; null for a command that makes none.
const reference::FragmentState* fragment_state(const reference::Command& command);

/// Whether what fragments write depends on the colours that are there. Masks of whole components do not
/// count.
bool reads_colors(const reference::FragmentState& state);

Buffers buffers_for(const reference::Scene& scene);

/// The masks of a draw as one of whole components (alpha: false without alpha planes), if they are one.
std::optional<std::array<bool, 4>> component_mask(const std::array<bool, 4>& color_mask,
                                                  std::uint32_t plane_mask,
                                                  const reference::FrameBufferFormat& format);

}  // namespace tessera::mesa
