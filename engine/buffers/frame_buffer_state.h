// What a frame buffer is made of.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/tessera/tessera.hpp"
#include "framebuffer/bitplane.h"
#include "framebuffer/format.h"
#include "framebuffer/palette.h"
#include "framebuffer/palette_search.h"

namespace tessera::detail {

/// As they follow each other in memory.
inline constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

/// One buffer of the stack, and what is known of it without looking at its planes.
struct Attachment {
  enum class Content : std::uint8_t {
    fast_cleared,  ///< every pixel has `clear_value`; nothing is allocated
    planes,        ///< it stands in the planes
    undefined      ///< the last frame did not keep it
  };
  BitplaneStack planes;
  Content content = Content::fast_cleared;
  std::uint32_t clear_value = 0;

  /// Makes the planes real. Throws std::bad_alloc; then nothing changed.
  void materialize() {
    if (content != Content::fast_cleared) return;
    if (planes.allocated()) planes.fill(clear_value);
    else planes.allocate(clear_value);
    content = Content::planes;
  }
  /// Every pixel becomes `value`.
  void fast_clear(std::uint32_t value) {
    planes.release();
    content = Content::fast_cleared;
    clear_value = value & planes.value_mask();
  }
  /// The caller looks at memory of its own: what is known has to stand there.
  void materialize_external_memory() {
    if (planes.uses_external_memory() && planes.plane_count() > 0) materialize();
  }
};

struct FrameBufferState {
  FrameBufferFormat format;
  ColorLayout layout;
  DepthFormat depth_format = DepthFormat::none;
  Palette palette;                                ///< index mode
  std::unique_ptr<PaletteSearch> palette_search;  ///< made when a colour first needs it
  Attachment color, depth, stencil;
  std::array<Attachment, 4> accumulation;  ///< red, green, blue, alpha: a stack holds at most 32 planes

  /// Of accumulation the first of its four; what is lost, all of them are.
  Attachment& buffer(Buffer which) {
    switch (which) {
      case Buffer::color: return color;
      case Buffer::depth: return depth;
      case Buffer::stencil: return stencil;
      default: return accumulation[0];
    }
  }
  /// What a buffer consists of, in the order of its planes; what is no Buffer, of nothing.
  std::span<Attachment> attachments(Buffer which) {
    if (which > Buffer::accumulation) return {};
    if (which == Buffer::accumulation) return accumulation;
    return {&buffer(which), 1};
  }
  /// The search structure, made on first use.
  const PaletteSearch* ensure_palette_search() {
    if (!layout.index) return nullptr;
    if (!palette_search)
      palette_search = std::make_unique<PaletteSearch>(palette, format.dither != Dither::none);
    return palette_search.get();
  }
};

std::string_view name(Buffer buffer);

}  // namespace tessera::detail
