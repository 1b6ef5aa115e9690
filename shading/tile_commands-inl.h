// Commands between draws: clears, and operations of the accumulation buffer.
#if defined(TESSERA_SHADING_TILE_COMMANDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TILE_COMMANDS_INL_H_
#undef TESSERA_SHADING_TILE_COMMANDS_INL_H_
#else
#define TESSERA_SHADING_TILE_COMMANDS_INL_H_
#endif

#include <algorithm>

#include "shading/draw_functions-inl.h"
#include "shading/resolve-inl.h"
#include "shading/tile_accumulation.h"
#include "shading/tile_renderer.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Fills the pixels of `rect`, tile-relative.
template <class Word>
void fill_rect(Word* pixels, Word word, const PixelRect& rect, int tile_size) {
  if (rect == PixelRect{0, 0, tile_size, tile_size}) {
    std::fill_n(pixels, tile_size * tile_size, word);
    return;
  }
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) pixels[tile_index(x, y, tile_size)] = word;
}

/// The part of a rectangle in the tile, tile-relative. A rectangle that reaches the right or bottom edge of
/// the frame buffer is extended to that of the tile, so that whole tiles are recognized.
inline PixelRect rect_in_tile(const PixelRect& rect, const TileGrid& grid, int tile_x, int tile_y) {
  const int right = rect.x1 == grid.width_px ? tile_x + grid.tile_size : rect.x1;
  const int bottom = rect.y1 == grid.height_px ? tile_y + grid.tile_size : rect.y1;
  const PixelRect in_tile = intersect({rect.x0 - tile_x, rect.y0 - tile_y, right - tile_x, bottom - tile_y},
                                      {0, 0, grid.tile_size, grid.tile_size});
  return in_tile.empty() ? PixelRect{} : in_tile;
}

/// Fills the pixels of `rect` with the pattern of a dithered clear.
inline void fill_pattern(const TileContext& context, std::uint32_t* pixels, const TileClear& clear,
                         const PixelRect& rect) {
  const TileFrame& frame = context.frame;
  const std::uint32_t* const pattern = frame.clear_patterns + clear.first_of_pattern;
  for (int y = rect.y0; y < rect.y1; ++y) {
    const int row = (context.tile_y + y) & (frame.clear_pattern_rows - 1);
    for (int x = rect.x0, count; x < rect.x1; x += count) {
      // Four pixels of a block are adjacent, in the pattern too.
      count = std::min(kBlockSize - x % kBlockSize, rect.x1 - x);
      const int column = (context.tile_x + x) & (frame.clear_pattern_columns - 1);
      const std::uint32_t* const from = pattern + row * frame.clear_pattern_columns + column;
      std::uint32_t* const to = pixels + tile_index(x, y, context.tile_size);
      if (count == kBlockSize) std::copy_n(from, kBlockSize, to);
      else std::copy_n(from, count, to);
    }
  }
}

inline void clear_pixels(const TileContext& context, const TileAttachments& pixels, const TileClear& clear,
                         const PixelRect& rect) {
  if (clear.color && !clear.dithered) fill_rect(pixels.color, clear.packed_color, rect, context.tile_size);
  if (clear.color && clear.dithered) fill_pattern(context, pixels.color, clear, rect);
  if (clear.depth) fill_rect(pixels.depth, clear.depth_key, rect, context.tile_size);
  if (clear.stencil) fill_rect(pixels.stencil, clear.stencil_value, rect, context.tile_size);
}

inline HWY_NOINLINE void run_clear(TileContext& context, const TileClear& clear) {
  shade_whole_tile(context);
  const PixelRect rect = rect_in_tile(clear.rect, context.frame.grid, context.tile_x, context.tile_y);
  for (int s = 0; s < context.samples; ++s) clear_pixels(context, context.sample[s], clear, rect);
  if (context.samples > 1 && clear.depth) {
    const bool is_whole_tile = rect == PixelRect{0, 0, context.tile_size, context.tile_size};
    reset_hiz(context, is_whole_tile ? clear.depth_key : kMaxDepthKey);
  }
  if (clear.accumulation)
    for (std::size_t c = 0; c < 4; ++c)
      fill_rect(context.memory.accumulation->component[c], clear.accumulation_levels[c], rect,
                context.tile_size);
}

inline HWY_NOINLINE void run_accumulation(TileContext& context, const TileAccumulation& command) {
  shade_whole_tile(context);
  const PixelRect rect = rect_in_tile(command.rect, context.frame.grid, context.tile_x, context.tile_y);
  const auto run_on = [&](std::uint32_t* color) {
    accumulate_tile(command, rect, context.tile_x, context.tile_y, context.tile_size, color,
                    context.memory.levels());
  };
  if (command.arithmetic.op() == AccumOp::return_color) {
    for (int s = 0; s < context.samples; ++s) run_on(context.sample[s].color);
    return;
  }
  const bool reads_color =
      command.arithmetic.op() == AccumOp::accum || command.arithmetic.op() == AccumOp::load;
  if (context.samples > 1 && reads_color) resolve_samples(context);
  run_on(context.color);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
