// What a frame buffer is made of.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/tessera/tessera.hpp"
#include "framebuffer/bitplane.h"
#include "framebuffer/format.h"
#include "framebuffer/palette.h"
#include "framebuffer/palette_search.h"

namespace tessera {

/// One buffer of the stack, and what is known of it without looking at its planes.
struct StoredBuffer {
  enum class Content : std::uint8_t {
    uniform,  ///< every pixel has `word`; nothing is allocated
    planes,   ///< it stands in the planes
    lost      ///< the last frame did not keep it
  };
  BitplaneStack planes;
  Content content = Content::uniform;
  std::uint32_t word = 0;

  /// Makes the planes real. Throws std::bad_alloc; then nothing changed.
  void materialize() {
    if (content != Content::uniform) return;
    if (planes.allocated())
      planes.fill(word);
    else
      planes.allocate(word);
    content = Content::planes;
  }
  /// Every pixel becomes `value`.
  void become_uniform(std::uint32_t value) {
    planes.release();
    content = Content::uniform;
    word = value & planes.word_mask();
  }
  /// The caller looks at memory of its own: what is known has to stand there.
  void settle_lent_memory() {
    if (planes.uses_lent_memory() && planes.plane_count() > 0) materialize();
  }
};

struct FrameBufferState {
  FrameBufferFormat format;
  ColorLayout layout;
  DepthKind depth_kind = DepthKind::none;
  Palette palette;                               ///< index mode
  std::unique_ptr<PaletteSearch> palette_search; ///< made when a colour first needs it
  StoredBuffer color, depth, stencil;

  StoredBuffer& buffer(Buffer which) { return which == Buffer::color ? color : which == Buffer::depth ? depth : stencil; }
  /// The search structure, made on first use.
  const PaletteSearch* search() {
    if (!layout.index) return nullptr;
    if (!palette_search) palette_search = std::make_unique<PaletteSearch>(palette);
    return palette_search.get();
  }
};

std::string_view name(Buffer buffer);

static_assert(static_cast<int>(DepthFormat::none) == static_cast<int>(DepthKind::none));
static_assert(static_cast<int>(DepthFormat::unorm32) == static_cast<int>(DepthKind::unorm32));
static_assert(static_cast<int>(DepthFormat::float32) == static_cast<int>(DepthKind::float32));

}  // namespace tessera
