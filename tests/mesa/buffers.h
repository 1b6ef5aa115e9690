// Selection of Mesa's colour buffer for a scene.
#pragma once

#include <array>
#include <optional>

#include "tests/reference/scene.h"

namespace tessera::mesa {

enum class ColorStore {
  /// Nothing reads the colour buffer: colours are quantized to levels or palette entries after the frame.
  kFloat,
  kBytes,  ///< 8 bits per component without alpha, for operations that read the buffer
  kBytesAndAlpha,
  kWindow  ///< 8 bits per component with alpha, in OSMesa's window, which alone has an accumulation buffer
};

struct Buffers {
  ColorStore color = ColorStore::kFloat;
  reference::DepthFormat depth = reference::DepthFormat::kNone;
  bool stencil = false;
};

/// Fragment state of a draw, a bitmap or an image; null for other commands.
const reference::FragmentState* fragment_state(const reference::Command& command);

/// Whether written colours depend on the stored ones. Masks of whole components do not count.
bool reads_colors(const reference::FragmentState& state);

Buffers buffers_for(const reference::Scene& scene);

/// Converts the masks of a draw to one of whole components (alpha: false without alpha planes), if possible.
std::optional<std::array<bool, 4>> component_mask(const std::array<bool, 4>& color_mask,
                                                  std::uint32_t plane_mask,
                                                  const reference::FrameBufferFormat& format);

}  // namespace tessera::mesa
