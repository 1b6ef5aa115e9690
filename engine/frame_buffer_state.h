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

namespace tessera {

/// As they follow each other in memory.
inline constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

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
    if (planes.allocated()) planes.fill(word);
    else planes.allocate(word);
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
  Palette palette;                                ///< index mode
  std::unique_ptr<PaletteSearch> palette_search;  ///< made when a colour first needs it
  StoredBuffer color, depth, stencil;
  std::array<StoredBuffer, 4> accumulation;  ///< red, green, blue, alpha: a stack holds at most 32 planes

  /// Of accumulation the first of its four; what is lost, all of them are.
  StoredBuffer& buffer(Buffer which) {
    switch (which) {
      case Buffer::color: return color;
      case Buffer::depth: return depth;
      case Buffer::stencil: return stencil;
      default: return accumulation[0];
    }
  }
  /// What a buffer consists of, in the order of its planes; what is no Buffer, of nothing.
  std::span<StoredBuffer> parts(Buffer which) {
    if (which > Buffer::accumulation) return {};
    if (which == Buffer::accumulation) return accumulation;
    return {&buffer(which), 1};
  }
  /// The search structure, made on first use.
  const PaletteSearch* search() {
    if (!layout.index) return nullptr;
    if (!palette_search)
      palette_search = std::make_unique<PaletteSearch>(palette, format.dither != Dither::none);
    return palette_search.get();
  }
};

std::string_view name(Buffer buffer);

static_assert(static_cast<int>(DepthFormat::none) == static_cast<int>(DepthKind::none));
static_assert(static_cast<int>(DepthFormat::unorm32) == static_cast<int>(DepthKind::unorm32));
static_assert(static_cast<int>(DepthFormat::float32) == static_cast<int>(DepthKind::float32));

}  // namespace tessera
