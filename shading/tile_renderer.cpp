// Renders a tile: clears, draws and commands of the accumulation buffer, in the order of recording.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/tile_renderer.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/group_builder-inl.h"
#include "shading/resolve-inl.h"
#include "shading/tile_commands-inl.h"
#include "shading/tile_renderer.h"
#include "shading/tile_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Sets up the attachments of the samples and loads them from the tile. A tile without primitives needs one
/// sample only: all would be equal.
void load_samples(TileContext& context, int tile) {
  TileWorkspace::Memory& memory = context.memory;
  const TileFrame& frame = context.frame;
  std::int32_t* const stencil = memory.stencil ? memory.stencil->value : nullptr;
  context.sample[0] = {context.color, memory.depth, memory.visibility, stencil};
  context.samples = frame.samples > 1 && !frame.batches->known_empty(tile) ? frame.samples : 1;
  if (context.samples == 1) return;
  TileSamples& samples = *memory.samples;
  reset_hiz(context, kMaxDepthKey);
  const int pixels = context.tile_size * context.tile_size;
  context.sample[0].color = samples.color[0];
  if (frame.loads_color) std::copy_n(context.color, pixels, samples.color[0]);
  for (int s = 1; s < context.samples; ++s) {
    context.sample[s] = samples.of(s, stencil != nullptr);
    if (frame.loads_color) std::copy_n(context.color, pixels, context.sample[s].color);
    if (frame.loads_depth) std::copy_n(memory.depth, pixels, context.sample[s].depth);
    if (frame.loads_stencil) std::copy_n(stencil, pixels, context.sample[s].stencil);
  }
  if (samples.clean_samples >= context.samples && samples.clean_pixels >= pixels) return;
  for (int s = 1; s < context.samples; ++s) std::fill_n(context.sample[s].visibility, pixels, kNoTriangle);
  samples.clean_samples = context.samples;
  samples.clean_pixels = pixels;
}

TileCounts render_tile_lanes(const TileFrame& frame, int tile, TileWorkspace& workspace) {
  const TileGrid& grid = frame.grid;
  TileContext context{.frame = frame,
                      .memory = workspace.memory(),
                      .color = workspace.color(),
                      .tile_x = tile % grid.columns() * grid.tile_size,
                      .tile_y = tile / grid.columns() * grid.tile_size,
                      .tile_size = grid.tile_size,
                      .rect = {},
                      .needs_scissor = false,
                      .counts = {},
                      .sample = {},
                      .meter = frame.meter_pass == MeterPass::none ? nullptr : workspace.memory().meter};
  if (context.meter != nullptr) context.meter->begin_tile(frame.meter_pass);
  TileWorkspace::Memory& memory = context.memory;
  memory.group.count = 0;
  memory.visible_triangles.clear();
  memory.edges64.clear();
  if (!memory.visibility_clean)
    std::fill(std::begin(memory.visibility), std::end(memory.visibility), kNoTriangle);
  memory.visibility_clean = false;  // if rendering stops early
  load_samples(context, tile);

  std::uint32_t next_clear = 0, next_accumulation = 0;
  GroupBuilder builder{context};
  const auto clears_before = [&](std::uint32_t draw, std::uint32_t end) {
    while (next_clear < end && frame.clears[next_clear].before_draw <= draw)
      run_clear(context, frame.clears[next_clear++]);
  };
  // @pre draws before it have been flushed
  const auto commands_before = [&](std::uint32_t draw) {
    while (next_accumulation < frame.accumulation_count &&
           frame.accumulations[next_accumulation].before_draw <= draw) {
      const TileAccumulation& command = frame.accumulations[next_accumulation++];
      clears_before(draw, command.after_clears);
      run_accumulation(context, command);
    }
    clears_before(draw, frame.clear_count);
  };
  for (std::uint32_t b = frame.batches->next(tile, 0); b < frame.batches->count();) {
    if (frame.batches->is_streamed()) {
      shade_whole_tile(context);  // collected triangles refer to the previous batch
      measure_as_no_draw(context);
    }
    const Bins& bins = frame.batches->read(b);
    if (frame.batches->is_streamed() && builder.draw != nullptr) measure_as(context, builder.draw_number);
    // Other cores wrote most of the batches, and bins are linked lists: prefetch one block ahead.
    const std::uint32_t following = frame.batches->next(tile, b + 1);
    const Bins* const ahead = frame.batches->peek(following);
    if (ahead != nullptr) ahead->prefetch_first(tile);
    for (std::uint32_t index = bins.first(tile); index != Bins::kNone; index = bins.block(index).next) {
      context.counts.touched = true;
      const Bins::Block& block = bins.block(index);
      if (block.next != Bins::kNone) bins.prefetch_block(block.next);
      else if (ahead != nullptr) ahead->prefetch_block(ahead->first(tile));
      for (std::uint32_t e = 0; e < block.count; ++e) {
        e += builder.add_mesh_triangles(block.entries + e, block.count - e);
        if (e == block.count) break;
        const std::uint32_t entry = block.entries[e];
        if ((entry & kDrawMarker) != 0) {
          const std::uint32_t draw = entry & ~kDrawMarker;
          if (builder.is_in(draw)) continue;
          builder.flush(bins);
          measure_as_no_draw(context);
          commands_before(draw);
          builder.begin_draw(draw);
        } else {
          builder.add(bins, entry);
        }
      }
    }
    // A group may continue in the next batch if this one stays in memory.
    frame.batches->is_streamed() ? builder.flush(bins) : builder.release_bins(bins);
    b = following;
  }
  builder.finish();
  measure_as_no_draw(context);
  commands_before(frame.draw_count);
  shade_whole_tile(context);
  if (context.samples > 1) resolve_samples(context);
  memory.visibility_clean = true;
  return context.counts;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

RenderTile* render_tile(InstructionSet isa) { return TESSERA_KERNEL(isa, render_tile_lanes); }

std::uint32_t pack_color_or_index(const ColorLayout& layout, const PaletteSearch* search, float r, float g,
                                  float b, float a) {
  if (layout.index) return search->nearest(r, g, b) & layout.value_mask();
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : quantize(a, layout.alpha_bits) << layout.bits;
  return quantize_rgb(layout, r, g, b) | alpha;
}

}  // namespace tessera::detail
#endif
