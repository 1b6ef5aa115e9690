// Deferred shading: the visibility buffer holds the number of the triangle that is visible at each pixel;
// whole batches of these pixels are shaded with full lanes. Attributes are gathered by block span, the pixels
// of one triangle in one block, under masks; never pixel by pixel.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/deferred_shading.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>

#include "framebuffer/check.h"
#include "shading/batch_colors-inl.h"
#include "shading/batch_surface-inl.h"
#include "shading/coarse_cells-inl.h"
#include "shading/draw_functions-inl.h"
#include "shading/stage_blocks-inl.h"
#include "shading/tile_context-inl.h"
#include "shading/visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

inline constexpr int kBatchBlocks = kBatchPoints / kBlockPixels;
static_assert(kBatchBlocks * kBlockPixels == kBatchPoints);

/// Up to kBatchBlocks blocks with pixels of one surface. The block in slot n has the 16 points from 16 n on.
/// Points of uncovered pixels may hold any bits: nothing that is stored depends on them.
struct PixelBatch : BatchSurface {
  int blocks = 0;
  int index[kBatchBlocks];  // the block's first pixel in the tile
  int bx[kBatchBlocks], by[kBatchBlocks];
  std::uint32_t covered[kBatchBlocks];  // pixels of the surface, 16 bits
  bool one_surface = false;             // all visible triangles of the tile have this surface
#if HWY_TARGET == HWY_AVX3
  alignas(64) std::int32_t visibility[kBatchPoints];  // copy of the blocks' visibility buffer
  // Block spans. Each has at least one pixel, so they fit.
  int span_count = 0;
  std::int32_t triangle[kBatchPoints];
  std::int32_t slot[kBatchPoints];
#endif
};

/// Gathers the pixels of one triangle in the block of a slot.
template <int kCount>
HWY_INLINE void gather_visible(const TileContext& context, PixelBatch& pixels, int slot,
                               const ShadedTriangle& triangle, const TriangleInterpolants& interpolants,
                               std::uint32_t covered) {
  static_assert(kCount <= TriangleInterpolants::kCapacity);
  const int bx = pixels.bx[slot], by = pixels.by[slot];
  const int first = slot * kBlockPixels;
  if constexpr (kCount > 0) {
    gather_block_span<kCount>(context, pixels, triangle, interpolants, bx, by, covered, first);
  } else {
    const InterpolantArrays values(triangle, pixels.first_attribute, pixels.attribute_count);
    gather_block_span<0>(context, pixels, triangle, values, bx, by, covered, first);
  }
}

// take_surface_pixels() takes the pixels of a block that belong to the batch's surface into the next slot,
// and returns them. gather_pending() gathers the attributes whose gathering take_surface_pixels() has put
// off.
//   visibility  the block's part of the visibility buffer
//   pending     pixels of the block that have not been taken yet
#if HWY_TARGET == HWY_AVX3
// Two passes: take_surface_pixels() finds the distinct triangles of a block, in lanes; gather_pending()
// gathers the attributes of all block spans, so that mispredicted loop exits do not stall the FMA chains.

template <int kCount>
HWY_NOINLINE void gather_block_spans(const TileContext& context, PixelBatch& pixels) {
  for (int i = 0; i < pixels.span_count; ++i) {
    const int slot = pixels.slot[i];
    const std::int32_t id = pixels.triangle[i];
    gather_visible<kCount>(
        context, pixels, slot, context.memory.visible_triangles[static_cast<std::size_t>(id)],
        context.memory.interpolants[id], pixels_of(pixels.visibility + slot * kBlockPixels, id));
  }
}
HWY_INLINE void gather_pending(const TileContext& context, PixelBatch& pixels) {
  with_known_count(pixels, [&](auto count) HWY_ATTR { gather_block_spans<count.value>(context, pixels); });
  pixels.span_count = 0;
}

HWY_INLINE std::uint32_t take_surface_pixels(const TileContext& context, PixelBatch& pixels,
                                             const std::int32_t* visibility, std::uint32_t pending) {
  TESSERA_ASSERT(pixels.span_count <= pixels.blocks * kBlockPixels);
  const Int at = hn::Load(kInt, visibility);
  std::uint32_t covered = pending;
  if (!pixels.one_surface) {
    const Int surfaces = hn::GatherIndex(kInt, context.memory.surfaces, hn::Max(at, hn::Zero(kInt)));
    covered &= mask_bits(kInt, hn::Eq(surfaces, splat(pixels.surface_number())));
  }
  const std::uint32_t distinct = covered & ~mask_bits(kInt, duplicate_lanes(at));
  hn::StoreU(hn::Compress(at, mask_from_bits(distinct)), kInt, pixels.triangle + pixels.span_count);
  hn::StoreU(splat(pixels.blocks), kInt, pixels.slot + pixels.span_count);
  hn::Store(at, kInt, pixels.visibility + pixels.blocks * kBlockPixels);
  pixels.span_count += std::popcount(distinct);
  return covered;
}
#else
HWY_INLINE void gather_pending(const TileContext&, PixelBatch&) {}

HWY_INLINE std::uint32_t take_surface_pixels(const TileContext& context, PixelBatch& pixels,
                                             const std::int32_t* visibility, std::uint32_t pending) {
  std::uint32_t taken = 0;
  for (std::uint32_t left = pending; left != 0;) {
    const std::int32_t id = visibility[std::countr_zero(left)];
    const std::uint32_t covered = pixels_of(visibility, id);
    left &= ~covered;
    if (context.memory.surfaces[id] != pixels.surface_number()) continue;
    const ShadedTriangle& triangle = context.memory.visible_triangles[static_cast<std::size_t>(id)];
    with_known_count(pixels, [&](auto count) HWY_ATTR {
      gather_visible<count.value>(context, pixels, pixels.blocks, triangle, context.memory.interpolants[id],
                                  covered);
    });
    taken |= covered;
  }
  return taken;
}
#endif

/// Runs the fragment stage on the batch, whose colours are evaluated.
HWY_NOINLINE void run_stage_on_blocks(TileContext& context, PixelBatch& pixels) {
  const TileFragmentStage& stage = *pixels.stage;
  const TileStageDepth* const depth = context.memory.stage_depth.get();
  for (int slot = 0; slot < pixels.blocks; ++slot) {
    const int first = slot * kBlockPixels;
    if (stage.stage.reads.position) store_positions(context, pixels.bx[slot], pixels.by[slot], first);
    if (stage.stage.reads.depth) store_depths(context, depth->key + pixels.index[slot], first);
    if (pixels.covered[slot] != kWholeBlock)
      repeat_covered_point(context, stage, first, pixels.covered[slot]);
  }
  run_stage(context, pixels, pixels.blocks * kBlockPixels);
  for (int slot = 0; slot < pixels.blocks; ++slot)
    context.counts.non_finite_fragments += static_cast<std::uint64_t>(
        std::popcount(clamp_block_colors(context, slot * kBlockPixels) & pixels.covered[slot]));
}

/// Evaluates and stores the colours of the batch, whose attributes are gathered, and empties it.
HWY_INLINE void store_batch(TileContext& context, PixelBatch& pixels) {
  const TileDraw& draw = context.frame.draws[pixels.draw];
  const ShadingBatch& batch = context.memory.batch;
  const int count = pixels.blocks * kBlockPixels;
  if (pixels.stage != nullptr && pixels.alpha_attribute < 0)
    std::fill_n(context.memory.stage.field[kStageAlpha], count, pixels.alpha);
  evaluate_colors(context, pixels, count);
  if (pixels.stage != nullptr) run_stage_on_blocks(context, pixels);
  if (draw.captures_normals)
    for (int slot = 0; slot < pixels.blocks; ++slot)
      store_normals(context, pixels.index[slot], pixels.covered[slot], slot * kBlockPixels);
  const Int writable = splat(static_cast<std::int32_t>(draw.write_mask));
  const bool is_dithered = draw.dither != nullptr && pixels.packing == BatchSurface::Packing::unit;
  const auto packed = [&](int slot, int chunk, std::uint32_t covered) HWY_ATTR {
    const int first = slot * kBlockPixels + chunk * kLanes;
    if (!is_dithered) return pack_batch_colors(context.frame, pixels, batch, first, covered);
    const Float threshold = dither_thresholds(draw.dither->pattern(), context.tile_x + pixels.bx[slot],
                                              context.tile_y + pixels.by[slot], chunk);
    return pack_dithered_colors(context.frame, *draw.dither, batch, first, covered, threshold);
  };
  for (int slot = 0; slot < pixels.blocks; ++slot) {
    context.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(pixels.covered[slot]));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const std::uint32_t covered_lanes = chunk_bits(pixels.covered[slot], chunk);
      if (covered_lanes == 0) continue;
      store_packed(context.color + pixels.index[slot] + chunk * kLanes, packed(slot, chunk, covered_lanes),
                   mask_from_bits(covered_lanes), writable);
    }
  }
  pixels.blocks = 0;
}

/// Gathers what the pixels of a block need besides the colours of their cells, in slot `slot` of the batch.
HWY_INLINE void gather_pixel_inputs(const TileContext& context, PixelBatch& pixels, int slot,
                                    const std::int32_t* visibility) {
  for (std::uint32_t left = pixels.covered[slot]; left != 0;) {
    const std::int32_t id = visibility[std::countr_zero(left)];
    const std::uint32_t covered = pixels_of(visibility, id);
    left &= ~covered;
    const ShadedTriangle& triangle = context.memory.visible_triangles[static_cast<std::size_t>(id)];
    gather_visible<0>(context, pixels, slot, triangle, context.memory.interpolants[id], covered);
  }
}

/// Whether pixels need more than the colours of their cells.
HWY_INLINE bool gathers_pixel_inputs(const BatchSurface& surface) {
  return surface.gathers_coordinates || surface.gathers_stage_inputs;
}

/// Stores the lit colours of the cells in the pixels of the blocks. @pre no texture, no dither and no stage
HWY_INLINE void store_cells(TileContext& context, const PixelBatch& pixels, const CoarseBlocks& coarse,
                            const CellBatch& cells) {
  alignas(64) std::int32_t packed[kBatchPoints];
  for (int first = 0; first < cells.count; first += kLanes)
    hn::Store(pack_batch_colors(context.frame, pixels, cells.points, first,
                                low_bits_mask(std::min(cells.count - first, kLanes))),
              kInt, packed + first);
  const Int writable = splat(static_cast<std::int32_t>(context.frame.draws[pixels.draw].write_mask));
  for (int block = 0; block < coarse.count; ++block) {
    context.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(coarse.covered[block]));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const Int cell = hn::Load(kInt, coarse.cell_of_pixel + block * kBlockPixels + chunk * kLanes);
      store_packed(context.color + coarse.index[block] + chunk * kLanes,
                   load_words(reinterpret_cast<const std::uint32_t*>(packed), cell),
                   mask_from_bits(chunk_bits(coarse.covered[block], chunk)), writable);
    }
  }
}

/// Textures, dithers and stores the pixels of the blocks, kBatchBlocks at a time.
HWY_INLINE void store_cell_pixels(TileContext& context, PixelBatch& pixels, const CoarseBlocks& coarse,
                                  const CellBatch& cells) {
  for (int first = 0; first < coarse.count; first += kBatchBlocks) {
    const int count = std::min(coarse.count - first, kBatchBlocks);
    std::copy_n(coarse.index + first, count, pixels.index);
    std::copy_n(coarse.bx + first, count, pixels.bx);
    std::copy_n(coarse.by + first, count, pixels.by);
    std::copy_n(coarse.covered + first, count, pixels.covered);
    pixels.blocks = count;
    if (gathers_pixel_inputs(pixels))
      for (int slot = 0; slot < count; ++slot)
        gather_pixel_inputs(context, pixels, slot, coarse.visibility + (first + slot) * kBlockPixels);
    spread_cells(cells, coarse.cell_of_pixel + first * kBlockPixels, context.memory.batch,
                 count * kBlockPixels);
    store_batch(context, pixels);
  }
}

/// Lights the cells of the blocks, stores their pixels, and empties `coarse`.
HWY_NOINLINE void shade_coarse_blocks(TileContext& context, PixelBatch& pixels, CoarseBlocks& coarse) {
  CellBatch& cells = context.memory.cells;
  light_cells(pixels, cells);
  const bool has_dither = context.frame.draws[pixels.draw].dither != nullptr;
  const bool has_equal_pixels = pixels.texture == nullptr && !has_dither && pixels.stage == nullptr;
  if (has_equal_pixels) store_cells(context, pixels, coarse, cells);
  else store_cell_pixels(context, pixels, coarse, cells);
  coarse.count = cells.count = 0;
}

/// Adds the pixels of a block that belong to the surface, and returns them.
/// @param pending  pixels of the block that have not been taken yet
HWY_NOINLINE std::uint32_t take_coarse_pixels(TileContext& context, PixelBatch& pixels, CoarseBlocks& coarse,
                                              const std::int32_t* visibility, std::uint32_t pending,
                                              int index, int bx, int by) {
  CellBatch& cells = context.memory.cells;
  if (coarse.count == CoarseBlocks::kCapacity || !cells.has_room())
    shade_coarse_blocks(context, pixels, coarse);
  const int block = coarse.count++;
  std::uint32_t taken = 0;
  for (std::uint32_t left = pending; left != 0;) {
    const std::int32_t id = visibility[std::countr_zero(left)];
    const std::uint32_t covered = pixels_of(visibility, id);
    left &= ~covered;
    if (context.memory.surfaces[id] != pixels.surface_number()) continue;
    add_cells(context, pixels, context.memory.visible_triangles[static_cast<std::size_t>(id)], bx, by,
              covered, cells, coarse.cell_of_pixel + block * kBlockPixels);
    taken |= covered;
  }
  if (gathers_pixel_inputs(pixels))
    std::copy_n(visibility, kBlockPixels, coarse.visibility + block * kBlockPixels);
  coarse.index[block] = index;
  coarse.bx[block] = bx;
  coarse.by[block] = by;
  coarse.covered[block] = taken;
  return taken;
}

/// Shades the points of the batch, and empties it.
inline HWY_NOINLINE void shade_batch(TileContext& context, PixelBatch& pixels) {
  if (pixels.blocks == 0) return;
  gather_pending(context, pixels);
  store_batch(context, pixels);
}

/// Sets the surface numbers and interpolants of all visible triangles. Returns whether they have one surface.
HWY_INLINE bool prepare_triangles(const TileContext& context) {
  TileWorkspace::Memory& memory = context.memory;
  TESSERA_ASSERT(memory.visible_triangles.size() <= kVisibleTriangleCapacity);
  BatchSurface surface;
  bool stores_interpolants = false;
  int changes = 0;
  for (std::size_t i = 0; i < memory.visible_triangles.size(); ++i) {
    const ShadedTriangle& triangle = memory.visible_triangles[i];
    if (!surface.is_of(triangle)) {
      begin_surface(context, surface, triangle);
      stores_interpolants = known_count(surface) > 0;
      ++changes;
    }
    memory.surfaces[i] = surface.surface_number();
    if (stores_interpolants) store_interpolants(triangle, surface.first_attribute, memory.interpolants[i]);
  }
  return changes == 1;
}

void shade_visible(TileContext& context, int x0, int y0, int x1, int y1) {
  TileWorkspace::Memory& memory = context.memory;
  PixelBatch pixels;
  CoarseBlocks& coarse = memory.coarse;
  pixels.one_surface = prepare_triangles(context);
  for (int by = y0 & ~3; by <= y1; by += 4) {
    for (int bx = x0 & ~3; bx <= x1; bx += 4) {
      const int index = context.block_index(bx, by);
      auto* const visibility = reinterpret_cast<std::int32_t*>(memory.visibility) + index;
      std::uint32_t pending = pixels_where(visibility, [](Int at) HWY_ATTR { return hn::Gt(at, splat(-1)); });
      if (pending == 0) continue;
      while (pending != 0) {
        // One turn takes all pixels of the block with the same surface as the first pending one.
        const ShadedTriangle& leader =
            memory.visible_triangles[static_cast<std::size_t>(visibility[std::countr_zero(pending)])];
        const bool other_surface = !pixels.is_of(leader);
        if (pixels.blocks == kBatchBlocks || other_surface) shade_batch(context, pixels);
        if (other_surface) {
          if (coarse.count > 0) shade_coarse_blocks(context, pixels, coarse);
          measure_as(context, leader.draw);
          begin_surface(context, pixels, leader);
        }
        if (pixels.cell_size > 0) {
          pending &= ~take_coarse_pixels(context, pixels, coarse, visibility, pending, index, bx, by);
          continue;
        }
        pixels.index[pixels.blocks] = index;
        pixels.bx[pixels.blocks] = bx;
        pixels.by[pixels.blocks] = by;
        const std::uint32_t taken = take_surface_pixels(context, pixels, visibility, pending);
        pending &= ~taken;
        pixels.covered[pixels.blocks++] = taken;
      }
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
        hn::Store(splat(-1), kInt, visibility + chunk * kLanes);
    }
  }
  shade_batch(context, pixels);
  if (coarse.count > 0) shade_coarse_blocks(context, pixels, coarse);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
