// Load and store operations of the attachments of a frame, in the sense of Vulkan and Metal.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "engine/record/recording.h"

namespace tessera::detail {

struct FrameCommands;

/// Contents of tile memory before the first command.
enum class LoadOp : std::uint8_t {
  none,      ///< tiles do not use the attachment
  load,      ///< contents of the frame buffer
  dont_care  ///< undefined: the first command replaces the whole attachment
};

/// Contents of the frame buffer after the frame.
enum class StoreOp : std::uint8_t {
  none,        ///< unchanged
  store,       ///< tiles are stored in the planes
  fast_clear,  ///< the whole attachment ends as `clear_values`; no planes are written
  discard      ///< undefined
};

struct AttachmentOps {
  LoadOp load = LoadOp::none;
  StoreOp store = StoreOp::none;
  std::array<std::uint32_t, 4> clear_values{};  ///< StoreOp::fast_clear: per plane stack of the buffer

  bool used() const { return load != LoadOp::none; }
  bool loads() const { return load == LoadOp::load; }
  bool stores() const { return store == StoreOp::store; }
};

struct FrameAttachments {
  AttachmentOps color, depth, stencil, accumulation;

  const AttachmentOps& operator[](Buffer which) const {
    switch (which) {
      case Buffer::color: return color;
      case Buffer::depth: return depth;
      case Buffer::stencil: return stencil;
      default: return accumulation;
    }
  }
  AttachmentOps& operator[](Buffer which) { return const_cast<AttachmentOps&>(std::as_const(*this)[which]); }
  bool any_stores() const {
    return color.stores() || depth.stores() || stencil.stores() || accumulation.stores();
  }
};

/// Plans the operations of every attachment.
/// @param commands   plans, clears and accumulations are complete
/// @param presented  the colour goes to an image
/// @throws Error  if the frame loads a buffer that the frame before did not keep
FrameAttachments plan_attachments(const FrameCommands& commands, FrameRecording& recording, bool presented);

}  // namespace tessera::detail
