// Deferred shading for frames with several samples: a colour is evaluated once for each triangle that is
// visible in a pixel, at the pixel's centre, and is stored in the samples where the triangle is visible.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/deferred_shading_msaa.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>

#include "raster/lane_packing-inl.h"
#include "shading/batch_colors-inl.h"
#include "shading/batch_surface-inl.h"
#include "shading/coarse_cells-inl.h"
#include "shading/draw_functions-inl.h"
#include "shading/stage_blocks-inl.h"
#include "shading/visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Pixels of a block, or of a chunk, for each sample: 16 bits per sample, four samples per word.
struct SampleMasks {
  std::uint64_t word[kMaxSamples / 4] = {};
};
/// The same 16 bits for each sample.
constexpr SampleMasks broadcast_to_samples(std::uint32_t bits) {
  return {{0x0001000100010001u * bits, 0x0001000100010001u * bits}};
}
/// The union over the samples.
constexpr std::uint32_t any_sample_mask(const SampleMasks& bits) {
  const std::uint64_t all = bits.word[0] | bits.word[1];
  const std::uint64_t folded = all | all >> 32;
  return static_cast<std::uint32_t>(folded | folded >> 16) & 0xffff;
}
static_assert(kMaxSamples == 8);

/// The visible pixels of one triangle in one chunk. Their points are adjacent in the batch.
struct SampledSpan {
  int point;              // first point in the batch
  int index;              // the chunk's first pixel in the tile
  std::uint32_t covered;  // one bit per lane
  SampleMasks visible;    // samples of these pixels
};

/// Points of one surface. A pixel has one point for each triangle that is visible at its samples, so points
/// are packed: their order does not follow from the pixels' positions in a block.
struct SampledBatch : BatchSurface {
  int count = 0;
  int span_count = 0;
  SampledSpan spans[kBatchPoints];                         // each has at least one point
  alignas(64) std::int32_t cell_of_point[kBatchPoints]{};  // coarse shading
};

/// Evaluates the packed colours of the batch's points, in order.
HWY_INLINE void shade_points(TileContext& context, const SampledBatch& points, std::int32_t* packed) {
  const int whole_count = (points.count + kLanes - 1) / kLanes * kLanes;
  if (points.cell_size > 0) {
    light_cells(points, context.memory.cells);
    spread_cells(context.memory.cells, points.cell_of_point, context.memory.batch, whole_count);
    context.memory.cells.count = 0;
  }
  if (points.stage != nullptr && points.alpha_attribute < 0)
    std::fill_n(context.memory.stage.field[kStageAlpha], whole_count, points.alpha);
  evaluate_colors(context, points, whole_count);
  if (points.stage != nullptr) {
    run_stage(context, points, points.count);
    for (int point = 0; point < points.count; point += kLanes)
      context.counts.non_finite_fragments += static_cast<std::uint64_t>(std::popcount(
          clamp_stage_colors(context, point) & low_bits_mask(std::min(points.count - point, kLanes))));
  }
  for (int point = 0; point < points.count; point += kLanes) {
    const int count = std::min(points.count - point, kLanes);
    // In frames with several samples colours are neither indices nor scaled to levels.
    hn::Store(pack_unit_colors(context.frame, context.memory.batch, point, (1u << count) - 1), kInt,
              packed + point);
  }
}

/// Shades the points of the batch, and empties it.
inline HWY_NOINLINE void shade_sampled_batch(TileContext& context, SampledBatch& points) {
  if (points.count == 0) return;
  alignas(64) std::int32_t packed[kBatchPoints + kLanes];  // padded: whole vectors are read
  shade_points(context, points, packed);
  const Int writable = splat(static_cast<std::int32_t>(context.frame.draws[points.draw].write_mask));
  for (int i = 0; i < points.span_count; ++i) {
    const SampledSpan& span = points.spans[i];
    const Int colors =
        hn::TableLookupLanes(hn::LoadU(kInt, packed + span.point), expand_indices(kInt, span.covered));
    for (int w = 0; w < context.samples / 4; ++w)
      for (int s = 0; s < 4; ++s) {
        const auto lanes = static_cast<std::uint32_t>(span.visible.word[w] >> (16 * s));
        store_packed(context.sample[4 * w + s].color + span.index, colors, mask_from_bits(lanes), writable);
      }
  }
  context.counts.shaded_pixels += static_cast<std::uint64_t>(points.count);
  points.count = points.span_count = 0;
}

/// Adds the texture coordinates of the points of one chunk.
inline HWY_NOINLINE void add_coordinates(const TileContext& context, SampledBatch& points,
                                         const ShadedTriangle& triangle, const Barycentric& at,
                                         std::uint32_t bits) {
  const auto packing = compress_indices(kFloat, bits);
  coordinates_in(context, points, triangle).at(at, [&](int field, Float value) HWY_ATTR {
    hn::StoreU(hn::TableLookupLanes(value, packing), kFloat,
               context.memory.batch.field[field] + points.count);
  });
}

/// Adds the inputs of the fragment stage at the points of one chunk.
inline HWY_NOINLINE void add_stage_inputs(const TileContext& context, const SampledBatch& points,
                                          const ShadedTriangle& triangle, const Barycentric& at, int bx,
                                          int by, int chunk, std::uint32_t bits) {
  const auto packing = compress_indices(kFloat, bits);
  const auto store = [&](int field, Float value) HWY_ATTR {
    hn::StoreU(hn::TableLookupLanes(value, packing), kFloat,
               context.memory.stage.field[field] + points.count);
  };
  interpolate_stage_inputs(context, points, triangle, at, store);
  if (!points.stage->stage.reads.position) return;
  const WindowPositions position = window_positions(context, bx, by, chunk);
  store(kStageX, position.x);
  store(kStageY, position.y);
}

/// Coarse shading: adds the cells of the visible pixels of one triangle in one block, and stores the cell of
/// each of the points that these pixels will have.
inline HWY_NOINLINE void add_point_cells(TileContext& context, SampledBatch& points,
                                         const ShadedTriangle& triangle, int bx, int by,
                                         std::uint32_t covered) {
  CellBatch& cells = context.memory.cells;
  // The points of the block are lit with its cells.
  const bool has_room = points.count <= kBatchPoints - kBlockPixels - kLanes && cells.has_room();
  if (!has_room) shade_sampled_batch(context, points);
  alignas(64) std::int32_t cell_of_pixel[kBlockPixels] = {};
  add_cells(context, points, triangle, bx, by, covered, cells, cell_of_pixel);
  int point = points.count;
  for (std::uint32_t left = covered; left != 0; left &= left - 1)
    points.cell_of_point[point++] = cell_of_pixel[std::countr_zero(left)];
}

/// Adds the visible pixels of one triangle in one block to the batch. Shades the batch whenever it is full.
/// @param kCount   number of attributes, in adjacent arrays and without texture coordinates; 0: any
/// @param index    the block's first pixel in the tile
/// @param visible  visible pixels of the block, per sample
template <int kCount>
HWY_INLINE void add_points_counted(TileContext& context, SampledBatch& points, const ShadedTriangle& triangle,
                                   int bx, int by, int index, const SampleMasks& visible) {
  const int count = kCount > 0 ? kCount : points.attribute_count;
  const InterpolantArrays values(triangle, points.first_attribute, count);
  const std::uint32_t covered = any_sample_mask(visible);
  if (kCount == 0 && points.cell_size > 0) add_point_cells(context, points, triangle, bx, by, covered);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const std::uint32_t bits = chunk_bits(covered, chunk);
    if (bits == 0) continue;
    // Whole vectors are stored.
    if (points.count > kBatchPoints - kLanes) shade_sampled_batch(context, points);
    const Barycentric at = barycentric(triangle, context.memory.edges64.data(), bx, by, chunk);
    const auto packing = compress_indices(kFloat, bits);
    for (int j = 0; j < count; ++j) {
      float* const target = kCount > 0 ? points.target[0] + j * kBatchPoints : points.target[j];
      const Float value =
          points.clamps_to_range
              ? interpolate_clamped(at, make_interpolant(triangle, points.first_attribute + j, true))
              : interpolate(at, values[j]);
      hn::StoreU(hn::TableLookupLanes(value, packing), kFloat, target + points.count);
    }
    if (kCount == 0 && points.gathers_coordinates) add_coordinates(context, points, triangle, at, bits);
    if (kCount == 0 && points.stage != nullptr)
      add_stage_inputs(context, points, triangle, at, bx, by, chunk, bits);
    SampledSpan& span = points.spans[points.span_count++];
    span.point = points.count;
    span.index = index + chunk * kLanes;
    span.covered = bits;
    constexpr std::uint64_t kLanesOfSamples = broadcast_to_samples((1u << kLanes) - 1).word[0];
    for (int w = 0; w < kMaxSamples / 4; ++w)
      span.visible.word[w] = visible.word[w] >> (chunk * kLanes) & kLanesOfSamples;
    points.count += std::popcount(bits);
  }
}
inline HWY_NOINLINE void add_points(TileContext& context, SampledBatch& points,
                                    const ShadedTriangle& triangle, int bx, int by, int index,
                                    const SampleMasks& visible) {
  const bool is_plain = points.adjacent && !points.gathers_coordinates && points.stage == nullptr;
  switch (is_plain ? points.attribute_count : 0) {
    case 3: return add_points_counted<3>(context, points, triangle, bx, by, index, visible);
    case 6: return add_points_counted<6>(context, points, triangle, bx, by, index, visible);
    default: return add_points_counted<0>(context, points, triangle, bx, by, index, visible);
  }
}

/// pixels_where() at each sample.
template <int kSamples, class Predicate>
HWY_INLINE SampleMasks samples_where(const TileContext& context, int index, Predicate predicate) {
  SampleMasks bits;
  for (int s = 0; s < kSamples; ++s) {
    const auto* const visibility = reinterpret_cast<const std::int32_t*>(context.sample[s].visibility);
    bits.word[s / 4] |= std::uint64_t{pixels_where(visibility + index, predicate)} << (16 * (s % 4));
  }
  return bits;
}

/// Whether in each pixel of a block the same triangle, or none, is visible at all samples.
template <int kSamples>
HWY_INLINE bool samples_agree(const TileContext& context, int index) {
  Int differing = hn::Zero(kInt);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const auto visibility = [&](int s) HWY_ATTR {
      return hn::Load(
          kInt, reinterpret_cast<const std::int32_t*>(context.sample[s].visibility) + index + chunk * kLanes);
    };
    for (int s = 1; s < kSamples; ++s) differing = hn::Or(differing, hn::Xor(visibility(s), visibility(0)));
  }
  return hn::AllTrue(kInt, hn::Eq(differing, hn::Zero(kInt)));
}

/// Adds the points of one block to the batch. Returns false if no triangle is visible there.
/// @param kSamples  samples to read: 1 if samples_agree()
template <int kSamples>
HWY_INLINE bool add_block(TileContext& context, SampledBatch& points, int bx, int by, int index) {
  const auto id_at = [&](int word, std::uint64_t bits) {
    const int first = std::countr_zero(bits);
    return context.sample[4 * word + first / 16].visibility[index + first % 16];
  };
  constexpr int kWords = (kSamples + 3) / 4;
  SampleMasks pending =
      samples_where<kSamples>(context, index, [](Int id) HWY_ATTR { return hn::Gt(id, splat(-1)); });
  if (any_sample_mask(pending) == 0) return false;
  for (int leading = 0; leading < kWords; ++leading) {
    while (pending.word[leading] != 0) {
      // One turn takes all triangles with the same surface as the first pending one, in order.
      const ShadedTriangle& leader = context.memory.visible_triangles[id_at(leading, pending.word[leading])];
      if (!points.is_of(leader)) {
        shade_sampled_batch(context, points);
        measure_as(context, leader.draw);
        begin_surface(context, points, leader);
      }
      SampleMasks left = pending;
      for (int word = leading; word < kWords; ++word) {
        while (left.word[word] != 0) {
          const std::uint32_t id = id_at(word, left.word[word]);
          const ShadedTriangle& triangle = context.memory.visible_triangles[id];
          const Int wanted = splat(static_cast<std::int32_t>(id));
          const SampleMasks visible = samples_where<kSamples>(
              context, index, [wanted](Int at) HWY_ATTR { return hn::Eq(at, wanted); });
          for (int w = 0; w < kWords; ++w) left.word[w] &= ~visible.word[w];
          if (!points.is_of(triangle)) continue;
          for (int w = 0; w < kWords; ++w) pending.word[w] &= ~visible.word[w];
          if constexpr (kSamples == 1) {
            const SampleMasks all = broadcast_to_samples(static_cast<std::uint32_t>(visible.word[0]));
            add_points(context, points, triangle, bx, by, index, all);
          } else {
            add_points(context, points, triangle, bx, by, index, visible);
          }
        }
      }
    }
  }
  return true;
}

template <int kSamples>
HWY_NOINLINE void shade_visible_samples(TileContext& context) {
  SampledBatch points;
  for (int by = 0; by < context.tile_size; by += 4) {
    for (int bx = 0; bx < context.tile_size; bx += 4) {
      const int index = context.block_index(bx, by);
      const bool has_triangles = samples_agree<kSamples>(context, index)
                                     ? add_block<1>(context, points, bx, by, index)
                                     : add_block<kSamples>(context, points, bx, by, index);
      if (!has_triangles) continue;
      for (int s = 0; s < kSamples; ++s)
        for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
          hn::Store(splat(-1), kInt,
                    reinterpret_cast<std::int32_t*>(context.sample[s].visibility) + index + chunk * kLanes);
    }
  }
  shade_sampled_batch(context, points);
}

void shade_visible_msaa(TileContext& context) {
  if (context.samples == 4) shade_visible_samples<4>(context);
  else shade_visible_samples<kMaxSamples>(context);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
