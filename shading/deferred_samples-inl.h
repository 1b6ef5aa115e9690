// Shading once for each visible triangle of each pixel, where pixels have several samples: the colour comes
// about at the pixel's centre and goes to the samples that see the triangle.
#if defined(TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#undef TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DEFERRED_SAMPLES_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "raster/lane_packing-inl.h"
#include "shading/deferred-inl.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Bits of a block's pixels, or of a chunk's, for each sample: 16 bits of a word, four samples a word.
struct SampleBits {
  std::uint64_t word[kMaxSamples / 4] = {};
};
/// The same 16 bits for each sample.
constexpr SampleBits at_all_samples(std::uint32_t bits) {
  return {{0x0001000100010001u * bits, 0x0001000100010001u * bits}};
}
/// Those that any sample has.
constexpr std::uint32_t at_any_sample(const SampleBits& bits) {
  const std::uint64_t all = bits.word[0] | bits.word[1], folded = all | all >> 32;
  return static_cast<std::uint32_t>(folded | folded >> 16) & 0xffff;
}
static_assert(kMaxSamples == 8);

/// What one triangle covers of one chunk of pixels. Its points stand side by side in the batch.
struct SampledPixels {
  int point;              // the first one, in the batch
  int index;              // of the chunk's first pixel in tile memory
  std::uint32_t covered;  // a bit a lane
  SampleBits seen;        // by which samples of these pixels
};

/// Points of one surface. A pixel has one for each triangle that its samples see: they are packed, since the
/// places of a block's pixels would not do.
struct SampledBatch : BatchSurface {
  int count = 0, pieces = 0;
  SampledPixels piece[kBatchPoints];  // each has a point at least
};

/// Words of the batch's points, in their order.
HWY_INLINE void shade_points(TileRun& run, const SampledBatch& points, std::int32_t* words) {
  const TileDraw& draw = run.frame.draws[points.draw];
  ShadingBatch& batch = run.memory.batch;
  const bool per_pixel = draw.source == ColorSource::per_pixel;
  const int whole = (points.count + kLanes - 1) / kLanes * kLanes;
  if (per_pixel) light_points_lanes(*draw.programs[points.back ? 1 : 0], batch, whole);
  if (draw.source == ColorSource::constant) fill_colors(draw, points.back, batch);
  if (draw.topology == Topology::lines && draw.source == ColorSource::interpolated)
    clamp_colors(batch, points.count);  // pixels may lie beyond the ends
  if (points.texture != nullptr) texture_points(*points.texture, batch, whole);
  for (int point = 0; point < points.count; point += kLanes) {
    const int count = std::min(points.count - point, kLanes);
    hn::Store(quantize_chunk(run.frame, batch, point, (1u << count) - 1), kInt, words + point);
  }
}

inline HWY_NOINLINE void shade_sampled_batch(TileRun& run, SampledBatch& points) {
  if (points.count == 0) return;
  alignas(64) std::int32_t words[kBatchPoints + kLanes];  // the last ones are read along with others
  shade_points(run, points, words);
  const Int writable = splat(static_cast<std::int32_t>(run.frame.draws[points.draw].write_mask));
  for (int i = 0; i < points.pieces; ++i) {
    const SampledPixels& pixels = points.piece[i];
    const Int of_pixels =
        hn::TableLookupLanes(hn::LoadU(kInt, words + pixels.point), unpacking_of(kInt, pixels.covered));
    for (int w = 0; w < run.samples / 4; ++w)
      for (int s = 0; s < 4; ++s)
        store_words(run.sample[4 * w + s].color + pixels.index, of_pixels,
                    mask_from_bits(static_cast<std::uint32_t>(pixels.seen.word[w] >> (16 * s))), writable);
  }
  run.counts.shaded_pixels += static_cast<std::uint64_t>(points.count);
  points.count = points.pieces = 0;
}

/// Texture coordinates of the points of one chunk.
inline HWY_NOINLINE void add_coordinates(const TileRun& run, SampledBatch& points,
                                         const ShadedTriangle& triangle, const Barycentric& at,
                                         std::uint32_t bits) {
  const auto packing = packing_of(kFloat, bits);
  coordinates_in(run, points, triangle).at(at, [&](int field, Float value) HWY_ATTR {
    hn::StoreU(hn::TableLookupLanes(value, packing), kFloat, run.memory.batch.field[field] + points.count);
  });
}

/// Adds what samples see of one triangle in one block to the batch. Shades the batch whenever it is full.
/// kCount: attributes in adjacent arrays without texture coordinates, where known; else 0.
template <int kCount>
HWY_INLINE void add_points_counted(TileRun& run, SampledBatch& points, const ShadedTriangle& triangle, int bx,
                                   int by, int index, const SampleBits& seen) {
  const int count = kCount > 0 ? kCount : points.attribute_count;
  const CornerArrays values(triangle, points.first_attribute, count);
  const std::uint32_t covered = at_any_sample(seen);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const std::uint32_t bits = chunk_bits(covered, chunk);
    if (bits == 0) continue;
    if (points.count > kBatchPoints - kLanes) shade_sampled_batch(run, points);  // whole vectors are stored
    const Barycentric at = barycentric(triangle, run.memory.wide.data(), bx, by, chunk);
    const auto packing = packing_of(kFloat, bits);
    for (int j = 0; j < count; ++j) {
      float* const target = kCount > 0 ? points.target[0] + j * kBatchPoints : points.target[j];
      const Float value = points.keeps_range
                              ? interpolate_within(at, corners(triangle, points.first_attribute + j, true))
                              : interpolate(at, values[j]);
      hn::StoreU(hn::TableLookupLanes(value, packing), kFloat, target + points.count);
    }
    if (kCount == 0 && has_coordinates(points)) add_coordinates(run, points, triangle, at, bits);
    SampledPixels& pixels = points.piece[points.pieces++];
    pixels.point = points.count;
    pixels.index = index + chunk * kLanes;
    pixels.covered = bits;
    for (int w = 0; w < kMaxSamples / 4; ++w)
      pixels.seen.word[w] = seen.word[w] >> (chunk * kLanes) & at_all_samples((1u << kLanes) - 1).word[0];
    points.count += std::popcount(bits);
  }
}
inline HWY_NOINLINE void add_points(TileRun& run, SampledBatch& points, const ShadedTriangle& triangle,
                                    int bx, int by, int index, const SampleBits& seen) {
  switch (points.adjacent && !has_coordinates(points) ? points.attribute_count : 0) {
    case 3: return add_points_counted<3>(run, points, triangle, bx, by, index, seen);
    case 6: return add_points_counted<6>(run, points, triangle, bx, by, index, seen);
    default: return add_points_counted<0>(run, points, triangle, bx, by, index, seen);
  }
}

/// The same at each sample.
template <int kSamples, class Compare>
HWY_INLINE SampleBits samples_where(const TileRun& run, int index, Compare compare) {
  SampleBits bits;
  for (int s = 0; s < kSamples; ++s)
    bits.word[s / 4] |=
        std::uint64_t{pixels_where(reinterpret_cast<const std::int32_t*>(run.sample[s].ids) + index, compare)}
        << (16 * (s % 4));
  return bits;
}

/// All samples of each pixel of a block wait for the same triangle, or for none.
template <int kSamples>
HWY_INLINE bool samples_agree(const TileRun& run, int index) {
  Int differing = hn::Zero(kInt);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto ids = [&](int s) HWY_ATTR {
      return hn::Load(kInt,
                      reinterpret_cast<const std::int32_t*>(run.sample[s].ids) + index + chunk * kLanes);
    };
    for (int s = 1; s < kSamples; ++s) differing = hn::Or(differing, hn::Xor(ids(s), ids(0)));
  }
  return hn::AllTrue(kInt, hn::Eq(differing, hn::Zero(kInt)));
}

/// Adds one block to the batch. kSamples of them are looked at: one, where all agree. False if none waits.
template <int kSamples>
HWY_INLINE bool add_block(TileRun& run, SampledBatch& points, int bx, int by, int index) {
  const auto id_at = [&](int word, std::uint64_t bits) {
    const int first = std::countr_zero(bits);
    return run.sample[4 * word + first / 16].ids[index + first % 16];
  };
  constexpr int kWords = (kSamples + 3) / 4;
  SampleBits waiting =
      samples_where<kSamples>(run, index, [](Int id) HWY_ATTR { return hn::Gt(id, splat(-1)); });
  if (at_any_sample(waiting) == 0) return false;
  for (int leading = 0; leading < kWords; ++leading) {
    while (waiting.word[leading] != 0) {
      // All triangles of the surface that the first one belongs to, one after the other.
      const ShadedTriangle& leader = run.memory.triangles[id_at(leading, waiting.word[leading])];
      if (!points.is_of(leader)) {
        shade_sampled_batch(run, points);
        begin_surface(run, points, leader);
      }
      SampleBits left = waiting;
      for (int word = leading; word < kWords; ++word) {
        while (left.word[word] != 0) {
          const std::uint32_t id = id_at(word, left.word[word]);
          const ShadedTriangle& triangle = run.memory.triangles[id];
          const Int wanted = splat(static_cast<std::int32_t>(id));
          const SampleBits seen =
              samples_where<kSamples>(run, index, [wanted](Int at) HWY_ATTR { return hn::Eq(at, wanted); });
          for (int w = 0; w < kWords; ++w) left.word[w] &= ~seen.word[w];
          if (!points.is_of(triangle)) continue;
          for (int w = 0; w < kWords; ++w) waiting.word[w] &= ~seen.word[w];
          add_points(run, points, triangle, bx, by, index,
                     kSamples == 1 ? at_all_samples(static_cast<std::uint32_t>(seen.word[0])) : seen);
        }
      }
    }
  }
  return true;
}

/// Shades what was collected in the whole tile, and forgets it.
template <int kSamples>
HWY_NOINLINE void shade_collected_samples(TileRun& run) {
  SampledBatch points;
  for (int by = 0; by < run.tile_size; by += 4) {
    for (int bx = 0; bx < run.tile_size; bx += 4) {
      const int index = run.block_index(bx, by);
      if (!(samples_agree<kSamples>(run, index) ? add_block<1>(run, points, bx, by, index)
                                                : add_block<kSamples>(run, points, bx, by, index)))
        continue;
      for (int s = 0; s < kSamples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          hn::Store(splat(-1), kInt,
                    reinterpret_cast<std::int32_t*>(run.sample[s].ids) + index + chunk * kLanes);
    }
  }
  shade_sampled_batch(run, points);
}

/// Shades everything that waits for its colour.
HWY_INLINE void shade_whole_tile(TileRun& run) {
  if (!run.memory.triangles.empty()) {
    if (run.samples == 4) shade_collected_samples<4>(run);
    else if (run.samples > 1) shade_collected_samples<kMaxSamples>(run);
    else shade_collected(run, 0, 0, run.tile_size - 1, run.tile_size - 1);
  }
  run.memory.triangles.clear();
  run.memory.wide.clear();
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
