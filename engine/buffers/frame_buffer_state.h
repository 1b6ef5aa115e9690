// State of a FrameBuffer.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/tessera/tessera.hpp"
#include "framebuffer/bitplane.h"
#include "framebuffer/color_dither.h"
#include "framebuffer/error_diffusion.h"
#include "framebuffer/format.h"
#include "framebuffer/palette.h"
#include "framebuffer/palette_search.h"

namespace tessera::detail {

/// All buffers, in the order of their planes in memory.
inline constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

/// One stack of bitplanes, and the state of its contents.
struct Attachment {
  enum class Content : std::uint8_t {
    fast_cleared,  ///< every pixel has `clear_value`; planes are not valid
    planes,        ///< stored in the planes
    undefined      ///< the last frame did not keep it
  };
  BitplaneStack planes;
  Content content = Content::fast_cleared;
  std::uint32_t clear_value = 0;

  /// Stores a fast clear in the planes. Throws std::bad_alloc; then nothing has changed.
  void materialize() {
    if (content != Content::fast_cleared) return;
    if (planes.allocated()) planes.fill(clear_value);
    else planes.allocate(clear_value);
    content = Content::planes;
  }
  /// Sets every pixel to `value`, and releases the planes.
  void fast_clear(std::uint32_t value) {
    planes.release();
    content = Content::fast_cleared;
    clear_value = value & planes.value_mask();
  }
  /// External memory is read by the caller, so it must hold the contents.
  void materialize_external_memory() {
    if (planes.uses_external_memory() && planes.plane_count() > 0) materialize();
  }
};

/// A colour of 0 to 1 under an ordered dither.
struct DitheredColor {
  std::array<float, 4> color{};        ///< r g b a
  std::vector<std::uint32_t> pattern;  ///< packed colours, see DitherPattern; empty: none
};

struct FrameBufferState {
  FrameBufferFormat format;
  ColorLayout layout;  ///< colours that frames draw; with error diffusion working_layout(stored_layout)
  ColorLayout stored_layout;  ///< colours that are read back
  DepthFormat depth_format = DepthFormat::none;
  Palette palette;                                ///< index mode
  std::unique_ptr<PaletteSearch> palette_search;  ///< built on first use
  std::unique_ptr<ColorDither> dither;            ///< ordered dither; null: none
  DitheredColor dithered_color;                   ///< the last one of a clear
  std::unique_ptr<ErrorDiffusion> diffusion;      ///< null: none
  std::vector<std::uint32_t> diffusion_band;      ///< rows of drawn, then of stored colours
  Attachment color;                               ///< as drawn, in `layout`
  Attachment diffused;                            ///< with error diffusion: the stored colours
  Attachment depth, stencil;
  std::array<Attachment, 4> accumulation;  ///< r g b a: one stack holds at most 32 planes

  /// The colours that are read back.
  Attachment& stored_color() { return is_error_diffusion(format.dither) ? diffused : color; }

  /// The first stack of a buffer. The four stacks of accumulation have the same `content`.
  Attachment& buffer(Buffer which) {
    switch (which) {
      case Buffer::color: return color;
      case Buffer::depth: return depth;
      case Buffer::stencil: return stencil;
      default: return accumulation[0];
    }
  }
  /// The stacks of a buffer, in the order of its planes; empty for a value that is no Buffer.
  std::span<Attachment> attachments(Buffer which) {
    if (which > Buffer::accumulation) return {};
    if (which == Buffer::accumulation) return accumulation;
    return {&buffer(which), 1};
  }
  /// The stacks that are read back.
  Attachment& stored_buffer(Buffer which) { return which == Buffer::color ? stored_color() : buffer(which); }
  std::span<Attachment> stored_attachments(Buffer which) {
    if (which == Buffer::color) return {&stored_color(), 1};
    return attachments(which);
  }
  /// Null for RGB buffers. Built on first use.
  const PaletteSearch* ensure_palette_search() {
    if (!layout.index) return nullptr;
    if (!palette_search)
      palette_search = std::make_unique<PaletteSearch>(palette, dither ? dither->spread() / 2 : 0,
                                                       level_values(dither ? dither_light() : std::nullopt));
    return palette_search.get();
  }
  /// The curve of DitherSpace::light; absent for DitherSpace::levels.
  std::optional<LightCurve> dither_light() const {
    if (format.dither_in == DitherSpace::levels) return std::nullopt;
    return LightCurve{format.dither_gamma};
  }
  /// Sets `dither`, `diffusion` and `layout` from format, palette and stored_layout.
  void build_dither();
};

std::string_view name(Buffer buffer);

/// The first stack of a buffer that `function` reads back.
/// @throws Error  if the format lacks the buffer, or the last frame did not keep it
const Attachment& require_readable(FrameBufferState& state, Buffer which, const char* function);

}  // namespace tessera::detail
