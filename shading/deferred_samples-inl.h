// Shading once for each visible triangle of each pixel, where pixels have several samples: the colour comes about at the
// pixel's centre and goes to the samples that see the triangle.
#if defined(TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#undef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#endif

#include <bit>

#include "shading/deferred-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// A batch whose slots hold one triangle at most for each pixel of a block; a block with more takes several slots.
struct SampledBatch : PixelBatch {
  std::uint32_t seen[kBatchBlocks][kMaxSamples];  // by which samples of the slot's pixels; 16 bits
};

/// Centres may lie outside of the triangles that their samples see: colours are extrapolated there, and cut.
HWY_INLINE void clamp_colors(ShadingBatch& batch, int first) {
  for (int c = 0; c < 3; ++c) {
    float* const color = batch.field[kColorR + c] + first;
    hn::Store(clamped_unit(hn::Load(kFloat, color)), kFloat, color);
  }
}

inline HWY_NOINLINE void shade_sampled_batch(TileRun& run, SampledBatch& pixels) {
  if (pixels.blocks == 0) return;
  const TileDraw& draw = run.frame.draws[pixels.draw];
  ShadingBatch& batch = run.memory.batch;
  const bool per_pixel = draw.source == ColorSource::per_pixel;
  if (per_pixel) light_points_lanes(*draw.programs[pixels.back ? 1 : 0], batch, pixels.blocks * kBlockPixels);
  const Int writable = splat(static_cast<std::int32_t>(draw.write_mask));
  for (int slot = 0; slot < pixels.blocks; ++slot) {
    run.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(pixels.covered[slot]));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const auto lanes_of = [chunk](std::uint32_t bits) { return bits >> (chunk * kLanes) & ((1u << kLanes) - 1); };
      if (lanes_of(pixels.covered[slot]) == 0) continue;
      const int first = slot * kBlockPixels + chunk * kLanes;
      if (!per_pixel) clamp_colors(batch, first);
      const Int words = quantize_chunk(run.frame, batch, first, lanes_of(pixels.covered[slot]));
      for (int s = 0; s < run.samples; ++s)
        store_words(run.sample[s].color + pixels.index[slot] + chunk * kLanes, words, mask_from_bits(lanes_of(pixels.seen[slot][s])), writable);
    }
  }
  pixels.blocks = 0;
}

/// The pixels of a block in which each sample waits for the colour of triangle `id`.
HWY_INLINE std::uint32_t pixels_of_triangle(const std::uint32_t* ids, std::uint32_t id) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= mask_bits(kInt, hn::Eq(hn::Load(kInt, reinterpret_cast<const std::int32_t*>(ids) + chunk * kLanes), splat(static_cast<std::int32_t>(id)))) << (chunk * kLanes);
  return bits;
}
HWY_INLINE std::uint32_t waiting_pixels(const std::uint32_t* ids) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= mask_bits(kInt, hn::Gt(hn::Load(kInt, reinterpret_cast<const std::int32_t*>(ids) + chunk * kLanes), splat(-1))) << (chunk * kLanes);
  return bits;
}
/// All samples of each pixel of a block wait for the same triangle, or for none.
HWY_INLINE bool samples_agree(const TileRun& run, int index) {
  Int differing = hn::Zero(kInt);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto ids = [&](int s) HWY_ATTR { return hn::Load(kInt, reinterpret_cast<const std::int32_t*>(run.sample[s].ids) + index + chunk * kLanes); };
    for (int s = 1; s < run.samples; ++s) differing = hn::Or(differing, hn::Xor(ids(s), ids(0)));
  }
  return hn::AllTrue(kInt, hn::Eq(differing, hn::Zero(kInt)));
}

/// Fills the next slot of the batch with as many of the block's waiting samples as have its surface, one triangle a pixel.
/// @param samples  those that are looked at; 1: the others are like the first
HWY_INLINE void fill_slot(TileRun& run, SampledBatch& pixels, int bx, int by, int index, int samples, std::uint32_t (&waiting)[kMaxSamples]) {
  const TileWorkspace::Memory& memory = run.memory;
  std::uint32_t left[kMaxSamples], (&seen)[kMaxSamples] = pixels.seen[pixels.blocks];
  std::uint32_t taken = 0;
  for (int s = 0; s < samples; ++s) {
    left[s] = waiting[s];
    seen[s] = 0;
  }
  for (int first = 0; first < samples; ++first) {
    while (left[first] != 0) {
      const std::uint32_t id = run.sample[first].ids[index + std::countr_zero(left[first])];
      const ShadedTriangle& triangle = memory.triangles[id];
      std::uint32_t same[kMaxSamples], any = 0;
      for (int s = first; s < samples; ++s) {
        same[s] = pixels_of_triangle(run.sample[s].ids + index, id) & left[s];
        left[s] &= ~same[s];
        any |= same[s];
      }
      if (triangle.draw != pixels.draw || triangle.back != pixels.back) continue;
      const std::uint32_t free = any & ~taken;
      if (free == 0) continue;
      gather_attributes(run, pixels, triangle, bx, by, free, taken);
      taken |= free;
      for (int s = first; s < samples; ++s) {
        seen[s] |= same[s] & free;
        waiting[s] &= ~(same[s] & free);
      }
    }
  }
  for (int s = samples; s < run.samples; ++s) seen[s] = seen[0];
  pixels.index[pixels.blocks] = index;
  pixels.covered[pixels.blocks] = taken;
  ++pixels.blocks;
}

/// Shades what was collected in the whole tile, and forgets it.
inline HWY_NOINLINE void shade_collected_samples(TileRun& run) {
  SampledBatch pixels;
  for (int by = 0; by < run.tile_size; by += 4) {
    for (int bx = 0; bx < run.tile_size; bx += 4) {
      const int index = run.block_index(bx, by);
      const int samples = samples_agree(run, index) ? 1 : run.samples;
      std::uint32_t waiting[kMaxSamples], any = 0;
      for (int s = 0; s < samples; ++s) any |= waiting[s] = waiting_pixels(run.sample[s].ids + index);
      if (any == 0) continue;
      for (int first = 0; first < samples; ++first) {
        while (waiting[first] != 0) {
          const ShadedTriangle& leader = run.memory.triangles[run.sample[first].ids[index + std::countr_zero(waiting[first])]];
          const bool other_surface = pixels.draw != leader.draw || pixels.back != leader.back;
          if (pixels.blocks == kBatchBlocks || other_surface) shade_sampled_batch(run, pixels);
          if (other_surface) begin_surface(run, pixels, leader.draw, leader.back);
          fill_slot(run, pixels, bx, by, index, samples, waiting);
        }
      }
      for (int s = 0; s < run.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          hn::Store(splat(-1), kInt, reinterpret_cast<std::int32_t*>(run.sample[s].ids) + index + chunk * kLanes);
    }
  }
  shade_sampled_batch(run, pixels);
}

/// Shades everything that waits for its colour.
HWY_INLINE void shade_whole_tile(TileRun& run) {
  if (!run.memory.triangles.empty()) {
    if (run.samples > 1)
      shade_collected_samples(run);
    else
      shade_collected(run, 0, 0, run.tile_size - 1, run.tile_size - 1);
  }
  run.memory.triangles.clear();
  run.memory.wide.clear();
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
