// Shading once for each visible triangle of each pixel, where pixels have several samples: the colour comes about at the
// pixel's centre and goes to the samples that see the triangle.
#if defined(TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#undef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "shading/deferred-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

inline constexpr int kMaxShares = 16;

/// Pixels of one block in a slot of a batch. A pixel of a slot has one triangle; where a block's pixels have more, the rest goes to
/// another slot, which several blocks share.
struct SlotShare {
  int slot, index;                  // of the block's first pixel in tile memory
  std::uint32_t covered;            // 16 bits
  std::uint32_t seen[kMaxSamples];  // by which samples of these pixels
};
struct SampledBatch : PixelBatch {
  int shares = 0;
  SlotShare share[kMaxShares];
  int spare = -1;                   // the slot that blocks share; -1: none yet
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
  for (int slot = 0; slot < pixels.blocks && !per_pixel; ++slot)
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) clamp_colors(batch, slot * kBlockPixels + chunk * kLanes);
  for (int i = 0; i < pixels.shares; ++i) {
    const SlotShare& share = pixels.share[i];
    run.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(share.covered));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const auto lanes_of = [chunk](std::uint32_t bits) { return bits >> (chunk * kLanes) & ((1u << kLanes) - 1); };
      if (lanes_of(share.covered) == 0) continue;
      const Int words = quantize_chunk(run.frame, batch, share.slot * kBlockPixels + chunk * kLanes, lanes_of(share.covered));
      for (int s = 0; s < run.samples; ++s)
        store_words(run.sample[s].color + share.index + chunk * kLanes, words, mask_from_bits(lanes_of(share.seen[s])), writable);
    }
  }
  pixels.blocks = pixels.shares = 0;
  pixels.spare = -1;
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

/// Puts the triangles of one block after the other into the slots of a batch, and shades the batch whenever it is full.
struct SampledShader {
  TileRun& run;
  SampledBatch pixels;
  // The block, and its shares of a slot of its own and of the spare one; -1: none yet.
  int bx = 0, by = 0, index = 0, own = -1, shared = -1;

  HWY_INLINE void begin_block(int x, int y) {
    bx = x, by = y, index = run.block_index(x, y);
    own = shared = -1;
  }
  HWY_INLINE void begin_surface_of(const ShadedTriangle& leader) {
    if (pixels.draw == leader.draw && pixels.back == leader.back) return;
    flush();
    begin_surface(run, pixels, leader.draw, leader.back);
  }
  HWY_INLINE void flush() {
    shade_sampled_batch(run, pixels);
    own = shared = -1;
  }
  /// A triangle of the batch's surface: its pixels in the block, and which of them each sample sees.
  HWY_INLINE void add(const ShadedTriangle& triangle, std::uint32_t covered, const std::uint32_t (&seen)[kMaxSamples]) {
    while (covered != 0) {
      if (own < 0) {
        if (pixels.blocks == kBatchBlocks) flush();
        own = open_share(open_slot());
      }
      const std::uint32_t in_own = covered & ~taken(own), rest = covered & ~in_own;
      std::uint32_t in_spare = 0;
      if (rest != 0) {
        if (pixels.spare < 0 || (rest & ~pixels.covered[pixels.spare]) == 0) {
          if (pixels.blocks == kBatchBlocks) {
            place(triangle, in_own, 0, seen);
            flush();
            covered = rest;
            continue;
          }
          pixels.spare = open_slot();
          shared = -1;
        }
        if (shared < 0) shared = open_share(pixels.spare);
        in_spare = rest & ~taken(shared);
      }
      place(triangle, in_own, in_spare, seen);
      covered = rest & ~in_spare;
    }
  }

 private:
  HWY_INLINE int open_slot() {
    pixels.covered[pixels.blocks] = 0;
    return pixels.blocks++;
  }
  HWY_INLINE int open_share(int slot) {
    SlotShare& share = pixels.share[pixels.shares];
    share.slot = slot;
    share.index = index;
    share.covered = 0;
    for (int s = 0; s < run.samples; ++s) share.seen[s] = 0;
    return pixels.shares++;
  }
  HWY_INLINE std::uint32_t taken(int share) const { return pixels.covered[pixels.share[share].slot]; }
  HWY_INLINE SlotPart part(int share, std::uint32_t covered) const { return covered == 0 ? SlotPart{} : SlotPart{pixels.share[share].slot, covered, taken(share)}; }
  HWY_INLINE void enter(int number, std::uint32_t covered, const std::uint32_t (&seen)[kMaxSamples]) {
    if (covered == 0) return;
    SlotShare& share = pixels.share[number];
    pixels.covered[share.slot] |= covered;
    share.covered |= covered;
    for (int s = 0; s < run.samples; ++s) share.seen[s] |= seen[s] & covered;
  }
  HWY_NOINLINE void place(const ShadedTriangle& triangle, std::uint32_t in_own, std::uint32_t in_spare, const std::uint32_t (&seen)[kMaxSamples]) {
    gather_attributes(run, pixels, triangle, bx, by, part(own, in_own), part(shared, in_spare));
    enter(own, in_own, seen);
    enter(shared, in_spare, seen);
  }
};

/// Shades one block. `samples` of them are looked at: one, where all agree.
HWY_INLINE void shade_block(SampledShader& shader, int samples, std::uint32_t (&waiting)[kMaxSamples]) {
  TileRun& run = shader.run;
  const TileWorkspace::Memory& memory = run.memory;
  for (int first = 0; first < samples; ++first) {
    while (waiting[first] != 0) {
      // All triangles of the surface that the first one belongs to, one after the other.
      const ShadedTriangle& leader = memory.triangles[run.sample[first].ids[shader.index + std::countr_zero(waiting[first])]];
      shader.begin_surface_of(leader);
      std::uint32_t left[kMaxSamples];
      std::copy_n(waiting, samples, left);
      for (int from = first; from < samples; ++from) {
        while (left[from] != 0) {
          const std::uint32_t id = run.sample[from].ids[shader.index + std::countr_zero(left[from])];
          const ShadedTriangle& triangle = memory.triangles[id];
          const bool same_surface = triangle.draw == leader.draw && triangle.back == leader.back;
          std::uint32_t seen[kMaxSamples], covered = 0;
          for (int s = 0; s < samples; ++s) {
            seen[s] = s < from ? 0 : pixels_of_triangle(run.sample[s].ids + shader.index, id);
            left[s] &= ~seen[s];
            if (same_surface) waiting[s] &= ~seen[s];
            covered |= seen[s];
          }
          for (int s = samples; s < run.samples; ++s) seen[s] = seen[0];
          if (same_surface) shader.add(triangle, covered, seen);
        }
      }
    }
  }
}

/// Shades what was collected in the whole tile, and forgets it.
inline HWY_NOINLINE void shade_collected_samples(TileRun& run) {
  SampledShader shader{.run = run, .pixels = {}};
  for (int by = 0; by < run.tile_size; by += 4) {
    for (int bx = 0; bx < run.tile_size; bx += 4) {
      shader.begin_block(bx, by);
      const int samples = samples_agree(run, shader.index) ? 1 : run.samples;
      std::uint32_t waiting[kMaxSamples], any = 0;
      for (int s = 0; s < samples; ++s) any |= waiting[s] = waiting_pixels(run.sample[s].ids + shader.index);
      if (any == 0) continue;
      shade_block(shader, samples, waiting);
      for (int s = 0; s < run.samples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          hn::Store(splat(-1), kInt, reinterpret_cast<std::int32_t*>(run.sample[s].ids) + shader.index + chunk * kLanes);
    }
  }
  shader.flush();
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
