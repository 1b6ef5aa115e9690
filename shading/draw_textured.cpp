// Textured triangles that are shaded immediately: texture coordinates, texels and colours stay in registers.
// Bit-identical to deferred shading.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/draw_textured.cpp"
#include "framebuffer/lanes.h"

#include "shading/draw_functions-inl.h"
#include "shading/fragment_depth-inl.h"
#include "shading/texture_coordinates-inl.h"
#include "shading/texture_env-inl.h"
#include "shading/texture_sampling-inl.h"
#include "shading/visible_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // one lane gains nothing: choose_pixel_path() takes another path

/// Functor for for_each_block(): one triangle.
template <TexelFilter kFilter>
struct TexturedBlocks {
  TileContext& context;
  const TileDraw& draw;
  const ShadedTriangle& triangle;
  bool uses_depth;
  bool is_rgb8;
  bool modulates;
  bool replaces_color;
  bool stores_full;  // full blocks are stored without tests or masks
  bool is_full;      // argument of draw_block(): the compiler would clone the function for a constant
  FragmentDepth depth;
  TextureCoordinates coordinates;
  Interpolant color[3];
  Int visible = hn::Zero(kInt);  // minus the number of visible pixels, per lane
  std::uint64_t blocks = 0;      // stored as a whole

  /// Full blocks are drawn several at a time, because the steps of one block depend on each other. With
  /// nearest texels most of the time goes into loads, and one block at a time suffices.
  static constexpr bool kTakesSingleBlocks = kFilter == TexelFilter::nearest || kFilter == TexelFilter::any;
  static constexpr int kBlocksPerGroup = kTakesSingleBlocks ? 1 : 4;
  struct FullBlock {
    int bx, by;
    BlockEdges edges;
  };
  FullBlock pending[kBlocksPerGroup];
  int pending_count = 0;

  /// @param i  triangle of the group
  HWY_INLINE void set_up(int i) {
    uses_depth = draw.path.uses_depth();
    const ColorLayout& layout = context.frame.layout;
    is_rgb8 = layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8;
    modulates = draw.texture->function == TextureEnv::modulate;
    replaces_color = is_rgb8 && draw.texture->function == TextureEnv::replace;
    const bool is_tested = uses_depth || context.needs_scissor;
    const bool writes_rgb = (draw.write_mask & 0xffffff) == 0xffffff;
    const bool has_short_formula = is_rgb8 && (replaces_color || modulates);
    stores_full = has_short_formula && writes_rgb && !is_tested;
    depth.set_up(context.frame, draw, context.memory.group, i, context.memory.source[i], context.tile_x,
                 context.tile_y);
    coordinates.set_up(triangle, context.memory.edges64.data(), *draw.texture, false, 1);
    const std::size_t face = triangle.back ? 1 : 0;
    for (int c = 0; c < 3; ++c) {
      color[c] = draw.source == ColorSource::constant
                     ? Interpolant{draw.color[face][static_cast<std::size_t>(c)], 0, 0}
                     : make_interpolant(triangle, draw.color_attribute[face] + c, true);
    }
  }
  HWY_INLINE std::uint64_t shaded_pixels() const {
    return std::uint64_t{kBlockPixels} * blocks + count_of(visible);
  }

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    if (kFull && kFilter != TexelFilter::any && stores_full) {
      const FullBlock block{bx, by, edges};
      if constexpr (kBlocksPerGroup == 1) {
        draw_full_blocks<1>(&block);
      } else {
        pending[pending_count++] = block;
        if (pending_count == kBlocksPerGroup) {
          draw_full_blocks<kBlocksPerGroup>(pending);
          pending_count = 0;
        }
      }
      return;
    }
    is_full = kFull;
    draw_block(bx, by, edges);
  }
  /// Draws the pending full blocks.
  HWY_INLINE void finish() {
    is_full = true;
    for (int i = 0; i < pending_count; ++i) draw_block(pending[i].bx, pending[i].by, pending[i].edges);
  }
  HWY_NOINLINE void draw_block(int bx, int by, const BlockEdges& edges) {
    const int block = context.block_index(bx, by);
    Int keys[kChunksPerBlock];
    Int passed[kChunksPerBlock];
    Int passed_any = hn::Zero(kInt);
    if (uses_depth) depth.block_keys(bx, by, keys);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      auto mask = is_full ? hn::Eq(hn::Zero(kInt), hn::Zero(kInt)) : edges.covered(chunk);
      if (context.needs_scissor) mask = hn::And(mask, scissor_mask(context.rect, bx, by, chunk));
      if (uses_depth) {
        std::int32_t* const depth_at = context.memory.depth + block + chunk * kLanes;
        const Int stored = hn::Load(kInt, depth_at);
        mask = hn::And(mask, compare_lanes(keys[chunk], draw.depth_test, stored));
        if (draw.depth_write) hn::Store(hn::IfThenElse(mask, keys[chunk], stored), kInt, depth_at);
      }
      passed[chunk] = hn::VecFromMask(kInt, mask);
      passed_any = hn::Or(passed_any, passed[chunk]);
      visible = hn::Add(visible, passed[chunk]);
    }
    if (hn::AllFalse(kInt, hn::MaskFromVec(passed_any))) return;
    Barycentric at[kChunksPerBlock];
    Texels texels[kChunksPerBlock];
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) at[chunk] = barycentric_at(bx, by, edges, chunk);
    find_texels(at, texels);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk)
      store_packed(context.color + block + chunk * kLanes, packed(at[chunk], texels[chunk]),
                   hn::MaskFromVec(passed[chunk]), splat(static_cast<std::int32_t>(draw.write_mask)));
  }

 private:
  template <int kBlocks>
  HWY_INLINE void draw_full_blocks(const FullBlock* group) {
    constexpr int kChunks = kBlocks * kChunksPerBlock;
    Barycentric at[kChunks];
    Texels texels[kChunks];
    for (int i = 0; i < kChunks; ++i) {
      const FullBlock& block = group[i / kChunksPerBlock];
      at[i] = barycentric_at(block.bx, block.by, block.edges, i % kChunksPerBlock);
    }
    find_texels(at, texels);
    for (int i = 0; i < kChunks; ++i) {
      const FullBlock& block = group[i / kChunksPerBlock];
      auto* const stored = reinterpret_cast<std::int32_t*>(
          context.color + context.block_index(block.bx, block.by) + i % kChunksPerBlock * kLanes);
      hn::Store(replaces_color ? pack_texels(texels[i]) : modulated_packed(at[i], texels[i]), kInt, stored);
    }
    blocks += kBlocks;
  }

  HWY_INLINE Barycentric barycentric_at(int bx, int by, const BlockEdges& edges, int chunk) const {
    if (HWY_UNLIKELY(triangle.edges64_index >= 0))
      return barycentric_edges64(
          triangle, context.memory.edges64[static_cast<std::size_t>(triangle.edges64_index)], bx, by, chunk);
    return barycentric_from_edges(triangle, edges.at(0, chunk), edges.at(1, chunk), edges.at(2, chunk));
  }
  template <int kChunks>
  HWY_INLINE void find_texels(const Barycentric (&at)[kChunks], Texels (&texels)[kChunks]) const {
    constexpr bool kClampsToRange = kFilter == TexelFilter::nearest || kFilter == TexelFilter::any;
    constexpr bool kHasSlopes = kFilter == TexelFilter::linear_mipmapped || kFilter == TexelFilter::any;
    Float s[kChunks], t[kChunks], footprint[kChunks];
    for (int i = 0; i < kChunks; ++i)
      coordinates.at<kHasSlopes, kClampsToRange>(at[i], [&](int field, Float value) HWY_ATTR {
        if (field == kTextureS) s[i] = value;
        else if (field == kTextureT) t[i] = value;
        else footprint[i] = value;
      });
    texels_where<kFilter>(*draw.texture->levels, s, t, footprint, texels);
  }
  HWY_INLINE Int packed(const Barycentric& at, const Texels& texels) const {
    if (replaces_color) return pack_texels(texels);
    if (is_rgb8 && modulates) return modulated_packed(at, texels);
    const Colors textured = texture_env_lanes(*draw.texture, untextured(at), colors_of(texels));
    return pack_colors(context.frame.layout, textured, splat(0.5f));
  }
  HWY_INLINE Int modulated_packed(const Barycentric& at, const Texels& texels) const {
    return pack_rgb8(modulated(untextured(at), colors_of(texels)));
  }
  HWY_INLINE Colors untextured(const Barycentric& at) const {
    return {{interpolate_clamped(at, color[0]), interpolate_clamped(at, color[1]),
             interpolate_clamped(at, color[2]), splat(1.0f)}};
  }
};

/// Functor for for_each_block(): rows of full blocks whose nearest texels are stored unchanged. Data that the
/// blocks share is copied into locals: the compiler would reload members after every store.
struct NearestRows {
  TexturedBlocks<TexelFilter::nearest>& blocks;

  HWY_INLINE bool applies() const {
    return blocks.stores_full && blocks.replaces_color && blocks.triangle.edges64_index < 0;
  }

  template <bool kFull>
  HWY_INLINE void operator()(int bx, int by, const BlockEdges& edges) {
    static_assert(!kFull);  // full blocks are drawn by full_row()
    blocks.template operator()<false>(bx, by, edges);
  }
  HWY_INLINE void full_row(int bx, int by, int count, const BlockEdges& first) {
    const TextureLevels& levels = *blocks.draw.texture->levels;
    const TextureLevel level = levels.level[0];
    const std::uint32_t* const words = levels.words + level.first;
    const TextureWrap wrap_s = levels.wrap_s, wrap_t = levels.wrap_t;
    WeightLanes weights;
    weights.set_up(blocks.triangle);
    ClampedInterpolantLanes s;
    ClampedInterpolantLanes t;
    s.set(blocks.coordinates.s.interpolant);
    t.set(blocks.coordinates.t.interpolant);
    RowEdges edges(blocks.triangle.edges, first);
    auto* stored = reinterpret_cast<std::int32_t*>(blocks.context.color + blocks.context.block_index(bx, by));
    for (const std::int32_t* const end = stored + kBlockPixels * count; stored < end; edges.step_right())
      for (int chunk = 0; chunk < kChunksPerBlock; ++chunk, stored += kLanes) {
        const Barycentric at = weights.at(edges.at(0, chunk), edges.at(1, chunk), edges.at(2, chunk));
        const Float at_s = wrapped(interpolate_clamped(at, s), wrap_s);
        const Float at_t = wrapped(interpolate_clamped(at, t), wrap_t);
        const Int texels = nearest_words(words, level, at_s, at_t);
        hn::Store(hn::And(texels, splat(0xffffff)), kInt, stored);
      }
    blocks.blocks += static_cast<std::uint64_t>(count);
  }
};

void draw_textured_triangles(TileContext& context, std::uint32_t draw_number) {
  const TriangleGroup& g = context.memory.group;
  const TileDraw& draw = context.frame.draws[draw_number];
  const std::uint32_t in_tile = set_up_group(context, draw.path.uses_depth(), true);
  for_each_visible_triangle(context, in_tile, [&](int i, const TileEdges& edges) TESSERA_LOOP_BODY {
    ShadedTriangle triangle;
    fill_shaded_triangle(triangle, context, draw_number, i, is_back(context, draw, i), edges);
    with_filter(*draw.texture->levels, [&]<TexelFilter kFilter>() HWY_ATTR {
      TexturedBlocks<kFilter> blocks{.context = context, .draw = draw, .triangle = triangle};
      blocks.set_up(i);
      const BlockOffsets offsets(edges.edges);
      const auto draw_with = [&](auto& functor) HWY_ATTR {
        for_each_block(edges.edges, offsets, g.x0[i], g.y0[i], g.x1[i], g.y1[i], functor);
      };
      bool is_drawn = false;
      if constexpr (kFilter == TexelFilter::nearest) {
        NearestRows rows{blocks};
        is_drawn = rows.applies();
        if (is_drawn) draw_with(rows);
      }
      if (!is_drawn) draw_with(blocks);
      blocks.finish();
      context.counts.shaded_pixels += blocks.shaded_pixels();
    });
    context.memory.edges64.clear();
  });
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();
