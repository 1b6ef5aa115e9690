// Shading once for each visible pixel: tiles collect which triangle is seen where; then the colours of whole batches of
// pixels come about with full lanes. Within a block the loop runs over its distinct triangles, with masks: nothing is
// gathered by pixel.
#if defined(TESSERA_SHADING_DEFERRED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DEFERRED_INL_H_
#undef TESSERA_SHADING_DEFERRED_INL_H_
#else
#define TESSERA_SHADING_DEFERRED_INL_H_
#endif

#include <bit>

#include "shading/texture_coordinates-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "shading/tile_run-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count);  // lighting.cpp, same instruction set

inline constexpr int kBatchBlocks = kBatchPoints / kBlockPixels;

/// What the points of a batch share: one draw, one face.
struct BatchSurface {
  std::uint32_t draw = 0xffffffffu;
  bool back = false;
  // Which attributes of its triangles' vertices go into which arrays of the batch.
  int first_attribute = 0, attribute_count = 0;
  float* target[kMaxAttributes];
  bool adjacent = false;     // the arrays follow each other
  bool keeps_range = false;  // of the triangles' vertices
  const DrawTexture* texture = nullptr;  // or none
  TextureCoordinates coordinates;        // of the triangle last gathered, of textures with levels

  HWY_INLINE bool is_of(const ShadedTriangle& triangle) const { return draw == triangle.draw && back == triangle.back; }
};

/// Pixels of blocks that share a surface.
struct PixelBatch : BatchSurface {
  int blocks = 0;
  int index[kBatchBlocks];              // of each block's first pixel in tile memory
  std::uint32_t covered[kBatchBlocks];  // 16 bits
};

/// Words of one chunk of pixels from interpolated colours that are scaled to levels already.
HWY_INLINE Int pack_scaled(const ColorLayout& layout, const ShadingBatch& batch, int first) {
  const Int red = truncate(hn::Load(kFloat, batch.field[kColorR] + first));
  const Int green = truncate(hn::Load(kFloat, batch.field[kColorG] + first));
  const Int blue = truncate(hn::Load(kFloat, batch.field[kColorB] + first));
  return hn::Or(hn::Or(hn::ShiftLeftSame(red, layout.r_shift()), hn::ShiftLeftSame(green, layout.g_shift())), blue);
}

/// Words of one chunk of pixels from colours in 0..1: each component floor(c (2^b - 1) + 0.5), or a grey, or the nearest entry.
HWY_INLINE Int quantize_chunk(const TileFrame& frame, const ShadingBatch& batch, int first, std::uint32_t covered) {
  const ColorLayout& layout = frame.layout;
  const float *r = batch.field[kColorR] + first, *g = batch.field[kColorG] + first, *b = batch.field[kColorB] + first;
  if (layout.index || layout.luminance) {
    alignas(64) std::int32_t words[kLanes] = {};
    for (int l = 0; l < kLanes; ++l)
      if ((covered >> l & 1) != 0)
        words[l] = static_cast<std::int32_t>(layout.index ? frame.palette_search->nearest(r[l], g[l], b[l]) : quantize_rgb(layout, r[l], g[l], b[l]));
    return hn::Load(kInt, words);
  }
  const auto level = [](const float* c, int bits) HWY_ATTR {
    return truncate(mul_add(hn::Load(kFloat, c), splat(static_cast<float>((1 << bits) - 1)), splat(0.5f)));
  };
  return hn::Or(hn::Or(hn::ShiftLeftSame(level(r, layout.r_bits), layout.r_shift()), hn::ShiftLeftSame(level(g, layout.g_bits), layout.g_shift())),
                level(b, layout.b_bits));
}

/// Words of masked indices, step by step index_word(). Beyond the ends of a line, and where a sample alone is covered, an index may have
/// left its range: it comes back at the other end.
HWY_INLINE Int index_words(const ColorLayout& layout, Float interpolated) {
  const float modulus = layout.index_modulus();
  const Float turns = hn::Floor(hn::Mul(interpolated, splat(1 / modulus)));
  const Float within = neg_mul_add(turns, splat(modulus), interpolated);  // exact, but for what is rounded up to the modulus
  const Float index = hn::IfThenElseZero(hn::Eq(within, within), within);  // a NaN is 0
  const Int whole = truncate(hn::Max(index, hn::Zero(kFloat)));
  const auto up = hn::RebindMask(kInt, hn::Ge(hn::Sub(index, hn::ConvertTo(kFloat, whole)), splat(0.5f)));
  return hn::And(hn::Sub(whole, hn::VecFromMask(kInt, up)), splat(static_cast<std::int32_t>(layout.word_mask())));
}

/// Lit points have normals of length 1 in the batch.
inline HWY_NOINLINE void store_normals(TileRun& run, const PixelBatch& pixels) {
  for (int slot = 0; slot < pixels.blocks; ++slot)
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const auto covered = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(pixels.covered[slot], chunk)));
      for (int c = 0; c < 3; ++c) {
        float* const to = run.memory.normals->component[c] + pixels.index[slot] + chunk * kLanes;
        const Float normal = hn::Load(kFloat, run.memory.batch.field[kNormalX + c] + slot * kBlockPixels + chunk * kLanes);
        hn::Store(hn::IfThenElse(covered, normal, hn::Load(kFloat, to)), kFloat, to);
      }
    }
}

/// The colours of a draw that has one, for a texture to work on.
HWY_INLINE void fill_colors(const TileDraw& draw, bool back, ShadingBatch& batch) {
  for (int c = 0; c < 3; ++c)
    for (int point = 0; point < kBatchPoints; point += kLanes) hn::Store(splat(draw.color[back ? 1 : 0][static_cast<std::size_t>(c)]), kFloat, batch.field[kColorR + c] + point);
}

/// The colours of the first `count` points, and of the rest of their vector. What was extrapolated is cut.
HWY_INLINE void clamp_colors(ShadingBatch& batch, int count) {
  for (int point = 0; point < count; point += kLanes)
    for (int c = 0; c < 3; ++c) {
      float* const color = batch.field[kColorR + c] + point;
      hn::Store(clamped_unit(hn::Load(kFloat, color)), kFloat, color);
    }
}

/// The colours of the first `count` points, whole vectors of lanes, under the texture. What follows them in the batch may be anything.
inline HWY_NOINLINE void texture_points(const DrawTexture& texture, ShadingBatch& batch, int count) {
  if (texture.levels != nullptr) sample_texture_lanes(*texture.levels, batch, count);
  for (int point = 0; point < count; point += kLanes) {
    Colors colors{{hn::Zero(kFloat), hn::Zero(kFloat), hn::Zero(kFloat), splat(1.0f)}};
    for (int c = 0; c < 3; ++c) colors.c[c] = hn::Load(kFloat, batch.field[kColorR + c] + point);
    colors = textured_lanes(texture, colors, texels_at(texture, batch, point));
    for (int c = 0; c < 3; ++c) hn::Store(colors.c[c], kFloat, batch.field[kColorR + c] + point);
  }
}

inline HWY_NOINLINE void shade_batch(TileRun& run, PixelBatch& pixels) {
  if (pixels.blocks == 0) return;
  const TileDraw& draw = run.frame.draws[pixels.draw];
  ShadingBatch& batch = run.memory.batch;
  const bool per_pixel = draw.source == ColorSource::per_pixel;
  if (per_pixel) light_points_lanes(*draw.programs[pixels.back ? 1 : 0], batch, pixels.blocks * kBlockPixels);
  if (draw.captures_normals) store_normals(run, pixels);
  // Pixels of a line may lie beyond its ends.
  if (draw.topology == Topology::lines && draw.source == ColorSource::interpolated && !draw.index[pixels.back ? 1 : 0]) clamp_colors(batch, pixels.blocks * kBlockPixels);
  if (pixels.texture != nullptr) {
    if (draw.source == ColorSource::constant) fill_colors(draw, pixels.back, batch);
    texture_points(*pixels.texture, batch, pixels.blocks * kBlockPixels);
  }
  for (int slot = 0; slot < pixels.blocks; ++slot) {
    run.counts.shaded_pixels += static_cast<std::uint64_t>(std::popcount(pixels.covered[slot]));
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const std::uint32_t covered_lanes = chunk_bits(pixels.covered[slot], chunk);
      if (covered_lanes == 0) continue;
      const int first = slot * kBlockPixels + chunk * kLanes;
      const Int words = draw.index[pixels.back ? 1 : 0]      ? index_words(run.frame.layout, hn::Load(kFloat, batch.field[kColorR] + first))
                        : !per_pixel && draw.scaled_colors ? pack_scaled(run.frame.layout, batch, first)
                                                           : quantize_chunk(run.frame, batch, first, covered_lanes);
      store_words(run.memory.color + pixels.index[slot] + chunk * kLanes, words, mask_from_bits(covered_lanes), splat(static_cast<std::int32_t>(draw.write_mask)));
    }
  }
  pixels.blocks = 0;
}

/// The texture of a draw's faces: where indices are drawn, none has a say.
HWY_INLINE const DrawTexture* texture_of(const TileDraw& draw, bool back) { return draw.index[back ? 1 : 0] ? nullptr : draw.texture; }

/// Whether a draw's attributes stay within those of a triangle's vertices: where pixels' centres may be outside; and colours, unless they keep away from the
/// borders of levels already (scaled_colors). What lies beyond a line's end is as equation 3.6 has it.
HWY_INLINE bool attributes_keep_range(const TileRun& run, const TileDraw& draw) {
  return draw.topology != Topology::lines && (run.samples > 1 || (draw.source == ColorSource::interpolated && !draw.scaled_colors));
}

/// Makes the batch one of another surface. @pre it is empty
HWY_INLINE void begin_surface(const TileRun& run, BatchSurface& surface, const ShadedTriangle& triangle) {
  const TileDraw& draw = run.frame.draws[triangle.draw];
  const bool per_pixel = draw.source == ColorSource::per_pixel, back = triangle.back;
  surface.draw = triangle.draw;
  surface.back = back;
  surface.first_attribute = per_pixel ? draw.first_attribute : draw.color_attribute[back ? 1 : 0];
  surface.attribute_count = per_pixel ? draw.attribute_count : draw.source == ColorSource::constant ? 0 : draw.index[back ? 1 : 0] ? 1 : 3;
  surface.adjacent = true;
  for (int j = 0; j < surface.attribute_count; ++j) {
    surface.target[j] = run.memory.batch.field[per_pixel ? draw.fields[j] : kColorR + j];
    surface.adjacent &= surface.target[j] == surface.target[0] + j * kBatchPoints;
  }
  surface.keeps_range = attributes_keep_range(run, draw);
  surface.texture = texture_of(draw, back);
  surface.coordinates.triangle = nullptr;
}

/// Of a texture with levels: what its coordinates in a triangle are made of.
HWY_INLINE const TextureCoordinates& coordinates_in(const TileRun& run, BatchSurface& surface, const ShadedTriangle& triangle) {
  if (surface.coordinates.triangle != &triangle) surface.coordinates.set_up(triangle, run.memory.wide.data(), *surface.texture, run.frame.draws[surface.draw].topology == Topology::lines, run.samples);
  return surface.coordinates;
}
HWY_INLINE bool has_coordinates(const BatchSurface& surface) { return surface.texture != nullptr && surface.texture->levels != nullptr; }

HWY_INLINE Barycentric barycentric_of(const TileRun& run, const NarrowEdges& edges, int bx, int by, int chunk) {
  const ShadedTriangle& t = edges.triangle;
  return t.wide < 0 ? edges.barycentric(chunk) : barycentric_wide(t, run.memory.wide[static_cast<std::size_t>(t.wide)], bx, by, chunk);
}

/// Texture coordinates of the chunk of points from `point` on, in the lanes of `mask`.
inline HWY_NOINLINE void gather_coordinates(const TileRun& run, BatchSurface& surface, const ShadedTriangle& triangle, const Barycentric& at, LaneMask mask, int point) {
  const auto lanes = hn::RebindMask(kFloat, mask);
  coordinates_in(run, surface, triangle).at(at, [&](int field, Float value) HWY_ATTR {
    float* const to = run.memory.batch.field[field] + point;
    hn::Store(hn::IfThenElse(lanes, value, hn::Load(kFloat, to)), kFloat, to);
  });
}

/// Adds the pixels of one triangle in one block to the batch's next slot; `taken`: those that triangles before it have there. Lanes
/// that no triangle fills hold anything. kCount: attributes in adjacent arrays that need not be kept within a range, where known; else 0, and there may be
/// texture coordinates.
template <int kCount>
HWY_INLINE void gather_counted(const TileRun& run, PixelBatch& pixels, const ShadedTriangle& triangle, int bx, int by, std::uint32_t covered, std::uint32_t taken) {
  const int count = kCount > 0 ? kCount : pixels.attribute_count;
  const CornerArrays values(triangle, pixels.first_attribute, count);
  const auto value_of = [&](const Barycentric& at, int j) HWY_ATTR {
    return kCount == 0 && pixels.keeps_range ? interpolate_within(at, corners(triangle, pixels.first_attribute + j, true)) : interpolate(at, values[j]);
  };
  const NarrowEdges edges(triangle, bx, by);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    if (chunk_bits(covered, chunk) == 0) continue;
    const Barycentric at = barycentric_of(run, edges, bx, by, chunk);
    const int point = pixels.blocks * kBlockPixels + chunk * kLanes;
    const auto target = [&](int j) { return (kCount > 0 ? pixels.target[0] + j * kBatchPoints : pixels.target[j]) + point; };
    if (chunk_bits(taken, chunk) == 0) {  // the first triangle of a chunk may fill all of it
      for (int j = 0; j < count; ++j) hn::Store(value_of(at, j), kFloat, target(j));
    } else {
      const auto mask = hn::RebindMask(kFloat, mask_from_bits(chunk_bits(covered, chunk)));
      const auto store = [&](Float value, float* to) HWY_ATTR { hn::Store(hn::IfThenElse(mask, value, hn::Load(kFloat, to)), kFloat, to); };
      for (int j = 0; j < count; ++j) store(value_of(at, j), target(j));
    }
    if (kCount == 0 && has_coordinates(pixels))
      gather_coordinates(run, pixels, triangle, at, chunk_bits(taken, chunk) == 0 ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : mask_from_bits(chunk_bits(covered, chunk)), point);
  }
}
HWY_INLINE void gather_attributes(const TileRun& run, PixelBatch& pixels, const ShadedTriangle& triangle, int bx, int by, std::uint32_t covered, std::uint32_t taken) {
  switch (pixels.adjacent && !pixels.keeps_range && !has_coordinates(pixels) ? pixels.attribute_count : 0) {
    case 1: return gather_counted<1>(run, pixels, triangle, bx, by, covered, taken);
    case 3: return gather_counted<3>(run, pixels, triangle, bx, by, covered, taken);
    case 6: return gather_counted<6>(run, pixels, triangle, bx, by, covered, taken);
    default: return gather_counted<0>(run, pixels, triangle, bx, by, covered, taken);
  }
}

/// The pixels of a block whose triangles' numbers compare so.
template <class Compare>
HWY_INLINE std::uint32_t pixels_where(const std::uint32_t* ids, Compare compare) {
  std::uint32_t bits = 0;
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
    bits |= mask_bits(kInt, compare(hn::Load(kInt, reinterpret_cast<const std::int32_t*>(ids) + chunk * kLanes))) << (chunk * kLanes);
  return bits;
}

/// Shades what was collected in the blocks of [x0, x1] x [y0, y1], pixels of the tile, and forgets it.
inline HWY_NOINLINE void shade_collected(TileRun& run, int x0, int y0, int x1, int y1) {
  TileWorkspace::Memory& memory = run.memory;
  PixelBatch pixels;
  for (int by = y0 & ~3; by <= y1; by += 4) {
    for (int bx = x0 & ~3; bx <= x1; bx += 4) {
      const int index = run.block_index(bx, by);
      std::uint32_t* ids = memory.ids + index;
      std::uint32_t waiting = pixels_where(ids, [](Int at) HWY_ATTR { return hn::Gt(at, splat(-1)); });
      if (waiting == 0) continue;
      while (waiting != 0) {
        // All pixels of the block that belong to the surface of the first one still waiting.
        const ShadedTriangle& leader = memory.triangles[ids[std::countr_zero(waiting)]];
        const bool other_surface = !pixels.is_of(leader);
        if (pixels.blocks == kBatchBlocks || other_surface) shade_batch(run, pixels);
        if (other_surface) begin_surface(run, pixels, leader);
        std::uint32_t left = waiting, taken = 0;
        while (left != 0) {
          const std::uint32_t id = ids[std::countr_zero(left)];
          const ShadedTriangle& triangle = memory.triangles[id];
          const Int wanted = splat(static_cast<std::int32_t>(id));
          const std::uint32_t same = pixels_where(ids, [wanted](Int at) HWY_ATTR { return hn::Eq(at, wanted); });
          left &= ~same;
          if (!pixels.is_of(triangle)) continue;
          gather_attributes(run, pixels, triangle, bx, by, same, taken);
          taken |= same;
        }
        waiting &= ~taken;
        pixels.index[pixels.blocks] = index;
        pixels.covered[pixels.blocks] = taken;
        ++pixels.blocks;
      }
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) hn::Store(splat(-1), kInt, reinterpret_cast<std::int32_t*>(ids) + chunk * kLanes);
    }
  }
  shade_batch(run, pixels);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
