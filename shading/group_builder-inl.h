// Collects the entries of a tile's bins into groups of points, lines or triangles, and draws the groups.
#if defined(TESSERA_SHADING_GROUP_BUILDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_GROUP_BUILDER_INL_H_
#undef TESSERA_SHADING_GROUP_BUILDER_INL_H_
#else
#define TESSERA_SHADING_GROUP_BUILDER_INL_H_
#endif

#include <algorithm>

#include "shading/draw_dispatch-inl.h"
#include "shading/hidden_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Whether a fragment that passes may be farther than the stored depth.
constexpr bool may_raise_depth(Compare test) {
  return test == Compare::greater || test == Compare::notequal || test == Compare::gequal ||
         test == Compare::always;
}

/// Collects elements of one draw, and draws them whenever a group is full.
struct GroupBuilder {
  TileContext& context;
  std::uint32_t draw_number = 0;
  const TileDraw* draw = nullptr;
  DrawGroupFunction draw_elements = nullptr;
  // Points and lines are so small that cache misses of their vertices would dominate: the vertices of the
  // next group are prefetched while one is drawn.
  std::uint32_t prefetched[2 * kGroupSize];
  int prefetched_count = 0;
  std::uint32_t pending[kGroupSize];  // triangles of the mesh that are not in the group yet
  int pending_count = 0;
  HiddenTriangles hidden;

  HWY_INLINE bool is_in(std::uint32_t number) const { return draw != nullptr && draw_number == number; }
  HWY_INLINE void begin_draw(std::uint32_t number) {
    const TileFrame& frame = context.frame;
    const TileDraw& next = frame.draws[number];
    // Pixels in the visibility buffer may only be overwritten by deferred draws that write the same planes.
    const bool has_visible_triangles = draw != nullptr && !context.memory.visible_triangles.empty();
    if (has_visible_triangles && (next.write_mask != draw->write_mask || !next.deferred))
      shade_whole_tile(context);
    if (context.meter != nullptr) context.meter->begin_draw(next.recorded_draw, context.counts.shaded_pixels);
    draw_number = number;
    draw = &next;
    draw_elements = draw_group_function(next.path);
    hidden.begin_draw(next);
    if (context.samples > 1 && next.depth_write && may_raise_depth(next.depth_test))
      reset_hiz(context, kMaxDepthKey);
    // The part of the draw's rectangle in the tile. Pixels beyond the frame buffer's edges may be drawn; they
    // are never read.
    context.rect = intersect({next.rect.x0 - context.tile_x, next.rect.y0 - context.tile_y,
                              next.rect.x1 - context.tile_x, next.rect.y1 - context.tile_y},
                             {0, 0, context.tile_size, context.tile_size});
    context.needs_scissor =
        ((context.rect.x0 | context.rect.y0 | context.rect.x1 | context.rect.y1) & 3) != 0;
    if (next.texels != nullptr) draw_pixel_rectangle(context, number);
  }
  /// Adds one entry of the bins, a primitive of the current draw.
  HWY_INLINE void add(const Bins& bins, std::uint32_t id) {
    if (draw->topology != Topology::triangles) return add_point_or_line(bins, id);
    if ((id & kDerivedBit) == 0) {
      pending[pending_count++] = id;
    } else {
      load_pending();
      load<3>(bins, id);
    }
    if (context.memory.group.count + pending_count < kGroupSize) return;
    load_pending();
    draw_all();
  }
  /// Adds leading entries that are triangles of the mesh, until the group is full. Returns their number.
  HWY_INLINE std::uint32_t add_mesh_triangles(const std::uint32_t* entries, std::uint32_t count) {
    if (draw == nullptr || draw->topology != Topology::triangles) return 0;
    const auto room = static_cast<std::uint32_t>(kGroupSize - context.memory.group.count - pending_count);
    const std::uint32_t max_added = std::min(count, room);
    std::uint32_t added = 0;
    while (added < max_added && (entries[added] & (kDrawMarker | kDerivedBit)) == 0) {
      pending[pending_count + static_cast<int>(added)] = entries[added];
      ++added;
    }
    pending_count += static_cast<int>(added);
    if (added == room) {
      load_pending();
      draw_all();
    }
    return added;
  }
  /// Loads all prefetched elements. Afterwards only attributes of derived primitives are read from the bins.
  HWY_INLINE void release_bins(const Bins& bins) { draw_prefetched(bins, 0); }
  /// Draws all elements that were added. `bins` are those of the last ones.
  HWY_INLINE void flush(const Bins& bins) {
    release_bins(bins);
    finish();
  }
  /// Draws the remaining elements. @pre release_bins() has run
  HWY_INLINE void finish() {
    load_pending();
    draw_all();
  }

 private:
  HWY_INLINE std::size_t vertex_of(std::size_t corner) const {
    return draw->indices ? draw->indices[corner] : corner;
  }

  HWY_NOINLINE void add_point_or_line(const Bins& bins, std::uint32_t id) {
    if ((id & kDerivedBit) == 0) {
      const std::size_t corners = draw->topology == Topology::lines ? 2 : 1;
      for (std::size_t k = 0; k < corners; ++k) fetch(vertex_of(id * corners + k));
    }
    prefetched[prefetched_count++] = id;
    if (prefetched_count == 2 * kGroupSize) draw_prefetched(bins, kGroupSize);
  }
  HWY_INLINE void fetch(std::size_t vertex) const {
    __builtin_prefetch(draw->vertices + vertex);
    if (draw->source == ColorSource::per_vertex_packed) __builtin_prefetch(draw->packed_colors[0] + vertex);
    else __builtin_prefetch(draw->attributes + vertex * static_cast<std::size_t>(draw->attribute_stride));
  }
  /// Loads all prefetched elements except the last `kept`, and draws full groups.
  HWY_NOINLINE void draw_prefetched(const Bins& bins, int kept) {
    const int drawn = prefetched_count - kept;
    if (drawn <= 0) return;
    for (int i = 0; i < drawn; ++i) {
      if (draw->topology == Topology::lines) load<2>(bins, prefetched[i]);
      else load<1>(bins, prefetched[i]);
      if (context.memory.group.count == kGroupSize) draw_all();
    }
    std::copy_n(prefetched + drawn, kept, prefetched);
    prefetched_count = kept;
  }
  HWY_INLINE void draw_all() {
    TriangleGroup& g = context.memory.group;
    if (g.count == 0) return;
    // Unused lanes repeat the first triangle; they have no bit in the mask.
    for (int i = g.count; i < kGroupSize; ++i)
      for (int k = 0; k < 3; ++k) {
        g.x[k][i] = g.x[k][0];
        g.y[k][i] = g.y[k][0];
        g.z[k][i] = g.z[k][0];
        g.rw[k][i] = g.rw[k][0];
      }
    if (hidden.hides_group(context, *draw)) {
      context.counts.hidden_triangles += static_cast<std::uint64_t>(g.count);
    } else {
      if (HWY_UNLIKELY(draw->affine))
        for (auto& rw : g.rw) std::fill_n(rw, kGroupSize, 1.0f);
      draw_elements(context, draw_number);
    }
    g.count = 0;
    if (context.memory.visible_triangles.size() >= kMaxVisibleTriangles) shade_whole_tile(context);
  }
  HWY_NOINLINE void load_pending() {
    if (pending_count == 0) return;  // there may be no draw yet
    int loaded = 0;
    const DrawArrays arrays{.indices = draw->indices,
                            .vertices = draw->vertices,
                            .attributes = draw->attributes,
                            .stride = static_cast<std::size_t>(draw->attribute_stride)};
    for (; loaded + 4 <= pending_count; loaded += 4) load_four(arrays, pending + loaded);
    for (; loaded < pending_count; ++loaded) load_mesh_primitive<3>(pending[loaded]);
    pending_count = 0;
  }
  /// The arrays of a draw. A copy stays in registers while groups are written.
  struct DrawArrays {
    const std::uint32_t* indices;
    const WindowVertex* vertices;
    const float* attributes;
    std::size_t stride;
  };
  HWY_INLINE void load_four(const DrawArrays& arrays, const std::uint32_t* ids) {
    TileWorkspace::Memory& memory = context.memory;
    const int i = memory.group.count;
    memory.group.count += 4;
    std::size_t first[4];  // first corner of each triangle
    for (int t = 0; t < 4; ++t) {
      memory.source[i + t] = ids[t];
      first[t] = std::size_t{ids[t]} * 3;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const WindowVertex* v[4];
      const float* attributes[4];
      for (int t = 0; t < 4; ++t) {
        const std::size_t vertex = arrays.indices != nullptr ? arrays.indices[first[t] + k] : first[t] + k;
        v[t] = arrays.vertices + vertex;
        attributes[t] = arrays.attributes + vertex * arrays.stride;
      }
      std::copy_n(attributes, 4, memory.attributes[k] + i);
      load_four_vertices(i, static_cast<int>(k), v);
    }
  }
#if HWY_TARGET == HWY_SCALAR
  HWY_INLINE void load_four_vertices(int i, int k, const WindowVertex* const (&v)[4]) {
    for (int t = 0; t < 4; ++t) load_vertex(i + t, k, *v[t]);
  }
#else
  // Transposes four rows of x y z rw.
  HWY_INLINE void load_four_vertices(int i, int k, const WindowVertex* const (&v)[4]) {
    constexpr hn::CappedTag<std::int32_t, 4> four;
    constexpr hn::Repartition<std::int64_t, decltype(four)> pairs;
    TriangleGroup& g = context.memory.group;
    const auto row = [&](int t)
                         HWY_ATTR { return hn::LoadU(four, reinterpret_cast<const std::int32_t*>(v[t])); };
    const auto row0 = row(0);
    const auto row1 = row(1);
    const auto row2 = row(2);
    const auto row3 = row(3);
    const auto xxyy01 = hn::BitCast(pairs, hn::InterleaveLower(four, row0, row1));
    const auto xxyy23 = hn::BitCast(pairs, hn::InterleaveLower(four, row2, row3));
    const auto zzww01 = hn::BitCast(pairs, hn::InterleaveUpper(four, row0, row1));
    const auto zzww23 = hn::BitCast(pairs, hn::InterleaveUpper(four, row2, row3));
    const auto store = [&](auto column, void* to) HWY_ATTR {
      hn::StoreU(hn::BitCast(four, column), four, static_cast<std::int32_t*>(to));
    };
    store(hn::InterleaveLower(pairs, xxyy01, xxyy23), g.x[k] + i);
    store(hn::InterleaveUpper(pairs, xxyy01, xxyy23), g.y[k] + i);
    store(hn::InterleaveLower(pairs, zzww01, zzww23), g.z[k] + i);
    store(hn::InterleaveUpper(pairs, zzww01, zzww23), g.rw[k] + i);
  }
#endif
  template <int kCorners>
  HWY_INLINE void load(const Bins& bins, std::uint32_t id) {
    if ((id & kDerivedBit) == 0) return load_mesh_primitive<kCorners>(id);
    const int i = context.memory.group.count++;
    const DerivedPrimitive& derived = bins.derived(id);
    const float* const attributes = bins.attributes(derived);
    for (int k = 0; k < kCorners; ++k) {
      load_vertex(i, k, derived.vertices[k]);
      context.memory.attributes[k][i] = attributes + k * draw->attribute_stride;
    }
    context.memory.source[i] = derived.source;
  }
  template <int kCorners>
  HWY_INLINE void load_mesh_primitive(std::uint32_t id) {
    const int i = context.memory.group.count++;
    for (int k = 0; k < kCorners; ++k) {
      const std::size_t vertex = vertex_of(std::size_t{id} * kCorners + static_cast<std::size_t>(k));
      load_vertex(i, k, draw->vertices[vertex]);
      context.memory.attributes[k][i] =
          draw->attributes + vertex * static_cast<std::size_t>(draw->attribute_stride);
    }
    context.memory.source[i] = id;
  }
  HWY_INLINE void load_vertex(int i, int k, const WindowVertex& v) {
    TriangleGroup& g = context.memory.group;
    g.x[k][i] = v.x;
    g.y[k][i] = v.y;
    g.z[k][i] = v.z;
    g.rw[k][i] = v.rw;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
