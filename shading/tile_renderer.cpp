// Renders a tile: clears, draws and commands of the accumulation buffer in the order in which they were
// recorded.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/tile_renderer.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/group_builder-inl.h"
#include "shading/resolve-inl.h"
#include "shading/tile_clears-inl.h"
#include "shading/tile_renderer.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Where the samples of the tile's pixels stand, with what the tile holds. Without triangles they would all
/// be the same: one does.
void begin_samples(TileRun& run, int tile) {
  TileWorkspace::Memory& memory = run.memory;
  const TileFrame& frame = run.frame;
  std::int32_t* const stencil = memory.stencil ? memory.stencil->value : nullptr;
  run.sample[0] = {run.color, memory.depth, memory.ids, stencil};
  run.samples = frame.samples > 1 && !frame.batches->untouched(tile) ? frame.samples : 1;
  if (run.samples == 1) return;
  TileSamples& samples = *memory.samples;
  set_farthest(run, kFarthestKey);
  const int pixels = run.tile_size * run.tile_size;
  run.sample[0].color = samples.color[0];
  if (frame.loads_color) std::copy_n(run.color, pixels, samples.color[0]);
  for (int s = 1; s < run.samples; ++s) {
    run.sample[s] = samples.of(s, stencil != nullptr);
    if (frame.loads_color) std::copy_n(run.color, pixels, run.sample[s].color);
    if (frame.loads_depth) std::copy_n(memory.depth, pixels, run.sample[s].depth);
    if (frame.loads_stencil) std::copy_n(stencil, pixels, run.sample[s].stencil);
  }
  if (samples.clean_samples >= run.samples && samples.clean_pixels >= pixels) return;
  for (int s = 1; s < run.samples; ++s) std::fill_n(run.sample[s].ids, pixels, kNoTriangle);
  samples.clean_samples = run.samples;
  samples.clean_pixels = pixels;
}

TileCounts render_tile_lanes(const TileFrame& frame, int tile, TileWorkspace& workspace) {
  const TileGrid& grid = frame.grid;
  TileRun run{.frame = frame,
              .memory = workspace.memory(),
              .color = workspace.color(),
              .tile_x = tile % grid.columns() * grid.tile_size,
              .tile_y = tile / grid.columns() * grid.tile_size,
              .tile_size = grid.tile_size,
              .rect = {},
              .cut = false,
              .counts = {},
              .sample = {}};
  TileWorkspace::Memory& memory = run.memory;
  memory.group.count = 0;
  memory.triangles.clear();
  memory.wide.clear();
  if (!memory.ids_clean) std::fill(std::begin(memory.ids), std::end(memory.ids), kNoTriangle);
  memory.ids_clean = false;  // until the end of the tile
  begin_samples(run, tile);

  std::uint32_t next_clear = 0, next_accumulation = 0;
  GroupBuilder builder{run};
  const auto clears_before = [&](std::uint32_t draw, std::uint32_t end) {
    while (next_clear < end && frame.clears[next_clear].before_draw <= draw)
      run_clear(run, frame.clears[next_clear++]);
  };
  // All that was drawn before has been flushed.
  const auto commands_before = [&](std::uint32_t draw) {
    while (next_accumulation < frame.accumulation_count &&
           frame.accumulations[next_accumulation].before_draw <= draw) {
      const TileAccumulation& command = frame.accumulations[next_accumulation++];
      clears_before(draw, command.after_clears);
      run_accumulation(run, command);
    }
    clears_before(draw, frame.clear_count);
  };
  for (std::uint32_t b = frame.batches->next(tile, 0); b < frame.batches->count();) {
    if (frame.batches->one_by_one())
      shade_whole_tile(run);  // triangles that were seen refer to the batch before
    const Bins& bins = frame.batches->read(b);
    // Other cores binned most of the batches, and a list is a chain: what comes next is fetched while the
    // block before it is worked on.
    const std::uint32_t following = frame.batches->next(tile, b + 1);
    const Bins* const ahead = frame.batches->ahead(following);
    if (ahead != nullptr) ahead->fetch_first(tile);
    for (std::uint32_t index = bins.first(tile); index != Bins::kNone; index = bins.block(index).next) {
      run.counts.touched = true;
      const Bins::Block& block = bins.block(index);
      if (block.next != Bins::kNone) bins.fetch_block(block.next);
      else if (ahead != nullptr) ahead->fetch_block(ahead->first(tile));
      for (std::uint32_t e = 0; e < block.count; ++e) {
        e += builder.add_own(block.entries + e, block.count - e);
        if (e == block.count) break;
        const std::uint32_t entry = block.entries[e];
        if ((entry & kDrawMarker) != 0) {
          const std::uint32_t draw = entry & ~kDrawMarker;
          if (builder.is_in(draw)) continue;
          builder.flush(bins);
          commands_before(draw);
          builder.begin_draw(draw);
        } else {
          builder.add(bins, entry);
        }
      }
    }
    // Groups go on in the next batch, if this one is still there.
    frame.batches->one_by_one() ? builder.flush(bins) : builder.leave(bins);
    b = following;
  }
  builder.finish();
  commands_before(frame.draw_count);
  shade_whole_tile(run);
  if (run.samples > 1) resolve_samples(run);
  memory.ids_clean = true;
  return run.counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

RenderTile* render_tile(Isa isa) { return TESSERA_KERNEL(isa, render_tile_lanes); }

TileWorkspace::TileWorkspace() : memory_(std::make_unique<Memory>()) {
  // A group is added before the next look at the limit. Rendering a tile allocates nothing.
  memory_->triangles.reserve(kCollectedRoom);
  memory_->wide.reserve(kCollectedRoom);
  allocate_colors(1);
}
TileWorkspace::~TileWorkspace() = default;
TileWorkspace::TileWorkspace(TileWorkspace&&) noexcept = default;
std::uint32_t* TileWorkspace::color() { return memory_->color; }
std::uint32_t* TileWorkspace::select_color(std::size_t tile) {
  return memory_->color = memory_->colors[tile].word;
}
std::int32_t* TileWorkspace::depth() { return memory_->depth; }
std::int32_t* TileWorkspace::stencil() { return memory_->stencil->value; }
const std::uint32_t* TileWorkspace::sample_color(int sample) const { return memory_->samples->color[sample]; }
AccumulatedPixels TileWorkspace::accumulation() { return memory_->levels(); }
float* TileWorkspace::normals(int component) { return memory_->normals->component[component]; }
void TileWorkspace::allocate_colors(int tiles) {
  if (memory_->colors.size() >= static_cast<std::size_t>(tiles)) return;
  memory_->colors.resize(static_cast<std::size_t>(tiles));
  select_color(0);
}
void TileWorkspace::allocate_normals() {
  if (!memory_->normals) memory_->normals = std::make_unique<TileNormals>();
}

void TileWorkspace::allocate_samples() {
  if (memory_->samples) return;
  memory_->samples = std::make_unique_for_overwrite<TileSamples>();
  memory_->samples->clean_samples = memory_->samples->clean_pixels = 0;
}

void TileWorkspace::allocate_stencil() {
  if (!memory_->stencil) memory_->stencil = std::make_unique<TileStencil>();
}
void TileWorkspace::allocate_accumulation() {
  if (!memory_->accumulation) memory_->accumulation = std::make_unique<TileLevels>();
}

std::uint32_t color_word(const ColorLayout& layout, const PaletteSearch* search, float r, float g, float b,
                         float a) {
  if (layout.index) return search->nearest(r, g, b) & layout.word_mask();
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : quantize(a, layout.alpha_bits) << layout.bits;
  return quantize_rgb(layout, r, g, b) | alpha;
}

}  // namespace tessera
#endif
