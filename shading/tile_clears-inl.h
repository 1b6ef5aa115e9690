// What a tile does between draws: clears, and commands of the accumulation buffer.
#if defined(TESSERA_SHADING_TILE_CLEARS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_TILE_CLEARS_INL_H_
#undef TESSERA_SHADING_TILE_CLEARS_INL_H_
#else
#define TESSERA_SHADING_TILE_CLEARS_INL_H_
#endif

#include <algorithm>

#include "shading/deferred_samples-inl.h"
#include "shading/resolve-inl.h"
#include "shading/tile_accumulation.h"
#include "shading/tile_renderer.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Fills the pixels of `rect`, tile-relative.
template <class Word>
void fill_rect(Word* pixels, Word word, const PixelRect& rect, int tile_size) {
  if (rect.x0 == 0 && rect.y0 == 0 && rect.x1 == tile_size && rect.y1 == tile_size) {
    std::fill_n(pixels, tile_size * tile_size, word);
    return;
  }
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) pixels[tile_index(x, y, tile_size)] = word;
}

/// What of a rectangle lies in the tile, tile-relative; the tile's part beyond the frame buffer counts as
/// inside where the rectangle reaches the edge, so that whole tiles stay whole.
inline PixelRect rect_in_tile(const PixelRect& rect, const TileGrid& grid, int tile_x, int tile_y) {
  const int right = rect.x1 == grid.width_px ? tile_x + grid.tile_size : rect.x1;
  const int bottom = rect.y1 == grid.height_px ? tile_y + grid.tile_size : rect.y1;
  const PixelRect in_tile = intersect({rect.x0 - tile_x, rect.y0 - tile_y, right - tile_x, bottom - tile_y},
                                      {0, 0, grid.tile_size, grid.tile_size});
  return in_tile.empty() ? PixelRect{} : in_tile;
}

inline void clear_pixels(const TileRun& run, const TilePixels& pixels, const TileClear& clear,
                         const PixelRect& rect) {
  if (clear.color && !clear.dithered) fill_rect(pixels.color, clear.color_word, rect, run.tile_size);
  if (clear.color && clear.dithered) {
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x)
        pixels.color[tile_index(x, y, run.tile_size)] = clear.pattern[static_cast<std::size_t>(
            (run.tile_y + y) % kDitherSize * kDitherSize + (run.tile_x + x) % kDitherSize)];
  }
  if (clear.depth) fill_rect(pixels.depth, clear.depth_key, rect, run.tile_size);
  if (clear.stencil) fill_rect(pixels.stencil, clear.stencil_value, rect, run.tile_size);
}

inline HWY_NOINLINE void run_clear(TileRun& run, const TileClear& clear) {
  shade_whole_tile(run);
  const PixelRect rect = rect_in_tile(clear.rect, run.frame.grid, run.tile_x, run.tile_y);
  for (int s = 0; s < run.samples; ++s) clear_pixels(run, run.sample[s], clear, rect);
  if (run.samples > 1 && clear.depth)
    set_farthest(run, rect == PixelRect{0, 0, run.tile_size, run.tile_size} ? clear.depth_key : kFarthestKey);
  if (clear.accumulation)
    for (std::size_t c = 0; c < 4; ++c)
      fill_rect(run.memory.accumulation->component[c], clear.accumulation_levels[c], rect, run.tile_size);
}

inline HWY_NOINLINE void run_accumulation(TileRun& run, const TileAccumulation& command) {
  shade_whole_tile(run);
  const PixelRect rect = rect_in_tile(command.rect, run.frame.grid, run.tile_x, run.tile_y);
  const auto run_on = [&](std::uint32_t* color) {
    run_on_tile(command, rect, run.tile_x, run.tile_y, run.tile_size, color, run.memory.levels());
  };
  if (command.arithmetic.op() == AccumulationOp::give_back) {
    for (int s = 0; s < run.samples; ++s) run_on(run.sample[s].color);
    return;
  }
  const bool reads_color = command.arithmetic.op() == AccumulationOp::accumulate ||
                           command.arithmetic.op() == AccumulationOp::load;
  if (run.samples > 1 && reads_color) resolve_samples(run);
  run_on(run.color);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
