#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/tile_renderer.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "framebuffer/check.h"
#include "shading/tile_renderer.h"
#include "shading/tile_workspace.h"
#include "shading/draw_samples-inl.h"
#include "shading/pixel_rectangles-inl.h"
#include "shading/points_lines-inl.h"
#include "shading/resolve-inl.h"
#include "shading/textured_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

using DrawGroup = void (*)(TileRun&, std::uint32_t draw);

template <class Depth, Test kTest>
DrawGroup pick_by_color(Seen seen, bool sampled) {
  if (sampled) {
    switch (seen) {
      case Seen::nothing: return &draw_group_samples<Depth, Test::any, Seen::nothing>;  // rare: once for all tests
      case Seen::word: return &draw_group_samples<Depth, kTest, Seen::word>;
      default: return &draw_group_samples<Depth, kTest, Seen::collect>;
    }
  }
  switch (seen) {
    case Seen::nothing: return &draw_group<Depth, kTest, Seen::nothing>;
    case Seen::word: return &draw_group<Depth, kTest, Seen::word>;
    case Seen::interpolate: return &draw_group<Depth, kTest, Seen::interpolate>;
    case Seen::mix: return &draw_group<Depth, Test::any, Seen::mix>;
    default: return &draw_group<Depth, kTest, Seen::collect>;
  }
}

/// What happens to the pixels of a draw without operations.
Seen seen_without_operations(const TileDraw& draw) {
  if (draw.source == ColorSource::none) return Seen::nothing;
  if (draw.source == ColorSource::per_pixel || draw.deferred) return Seen::collect;
  return draw.source == ColorSource::interpolated ? Seen::interpolate : Seen::word;
}

/// What happens to those of a draw whose operations draw_group knows: a stencil test, and of colours that it makes a mix by their alpha.
std::optional<Seen> seen_with_operations(const TileFrame& frame, const TileDraw& draw) {
  const FragmentOps& ops = *draw.ops;
  if (frame.samples > 1 || ops.alpha_test || draw.number != TileDraw::Number::none || draw.offset_factor != 0 || draw.offset_units != 0 || draw.depth_offsets != nullptr) return std::nullopt;
  if (draw.source == ColorSource::none) return Seen::nothing;
  if (draw.deferred) return Seen::collect;
  if (draw.plain_colors) return seen_without_operations(draw);
  const ColorLayout& layout = frame.layout;
  const bool is_rgb8 = layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8 && layout.alpha_bits == 0 && !layout.luminance && !layout.index;
  if (!is_rgb8 || ops.dither || ops.logic != Logic::copy || draw.texture != nullptr || (draw.source != ColorSource::interpolated && draw.source != ColorSource::constant)) return std::nullopt;
  const bool is_plain_mix = ops.equation == Equation::add && ops.src_color == Factor::src_alpha && ops.dst_color == Factor::one_minus_src_alpha;
  return ops.blend && is_plain_mix ? std::optional(Seen::mix) : std::nullopt;
}

/// The code that runs for a draw: none of it holds a step that the draw does not have.
DrawGroup pick_draw_group(const TileFrame& frame, const TileDraw& draw) {
  if (draw.topology == Topology::points) return draw_points;
  if (draw.topology == Topology::lines) return draw_lines;
  if constexpr (kLanes > 1) {  // one lane gains nothing
    if (textures_at_once(frame, draw)) return draw_textured;
  }
  const std::optional<Seen> with_operations = draw.ops != nullptr ? seen_with_operations(frame, draw) : std::nullopt;
  if (draw.ops != nullptr && !with_operations) return frame.samples > 1 ? &draw_fragments_samples : &draw_fragments;
  const Seen seen = with_operations.value_or(seen_without_operations(draw));
  const bool less = draw.depth_test == CompareOp::less && draw.ops == nullptr, sampled = frame.samples > 1;
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::per_pixel);
  TESSERA_ASSERT(!sampled || draw.deferred || draw.source != ColorSource::interpolated ||
                 (draw.write_mask == 0xffffffffu && !draw.scaled_colors && !frame.layout.index && !frame.layout.luminance));
  if (!has_depth(frame, draw)) return pick_by_color<NoDepth, Test::any>(seen, sampled);
  switch (frame.depth_kind) {
    case DepthKind::float32: return less ? pick_by_color<Float32Depth, Test::less>(seen, sampled) : pick_by_color<Float32Depth, Test::any>(seen, sampled);
    case DepthKind::unorm32: return pick_by_color<Unorm32Depth, Test::any>(seen, sampled);
    default: return less ? pick_by_color<UnormDepth, Test::less>(seen, sampled) : pick_by_color<UnormDepth, Test::any>(seen, sampled);
  }
}

/// Fills the pixels of `rect`, tile-relative.
template <class Word>
void fill_rect(Word* pixels, Word word, const PixelRect& rect, int tile_size) {
  if (rect.x0 == 0 && rect.y0 == 0 && rect.x1 == tile_size && rect.y1 == tile_size) {
    std::fill_n(pixels, tile_size * tile_size, word);
    return;
  }
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) pixels[tile_index(x, y, tile_size)] = word;
}

/// What of a rectangle lies in the tile, tile-relative; the tile's part beyond the frame buffer counts as inside where the
/// rectangle reaches the edge, so that whole tiles stay whole.
PixelRect rect_in_tile(const PixelRect& rect, const TileGrid& grid, int tile_x, int tile_y) {
  const int right = rect.x1 == grid.width_px ? tile_x + grid.tile_size : rect.x1;
  const int bottom = rect.y1 == grid.height_px ? tile_y + grid.tile_size : rect.y1;
  const PixelRect in_tile = intersect({rect.x0 - tile_x, rect.y0 - tile_y, right - tile_x, bottom - tile_y}, {0, 0, grid.tile_size, grid.tile_size});
  return in_tile.empty() ? PixelRect{} : in_tile;
}

constexpr std::int32_t kFarthestKey = std::numeric_limits<std::int32_t>::max();

/// What is known of all blocks of a tile with several samples: none of their depth keys is greater.
void set_farthest(TileRun& run, std::int32_t key) { std::fill_n(run.memory.samples->farthest, run.tile_size * run.tile_size / kBlockPixels, key); }

void clear_pixels(const TileRun& run, const TilePixels& pixels, const TileClear& clear, const PixelRect& rect) {
  if (clear.color && !clear.dithered) fill_rect(pixels.color, clear.color_word, rect, run.tile_size);
  if (clear.color && clear.dithered) {
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x)
        pixels.color[tile_index(x, y, run.tile_size)] =
            clear.pattern[static_cast<std::size_t>((run.tile_y + y) % kDitherSize * kDitherSize + (run.tile_x + x) % kDitherSize)];
  }
  if (clear.depth) fill_rect(pixels.depth, clear.depth_key, rect, run.tile_size);
  if (clear.stencil) fill_rect(pixels.stencil, clear.stencil_value, rect, run.tile_size);
}

void run_clear(TileRun& run, const TileClear& clear) {
  shade_whole_tile(run);
  const PixelRect rect = rect_in_tile(clear.rect, run.frame.grid, run.tile_x, run.tile_y);
  for (int s = 0; s < run.samples; ++s) clear_pixels(run, run.sample[s], clear, rect);
  if (run.samples > 1 && clear.depth) set_farthest(run, rect == PixelRect{0, 0, run.tile_size, run.tile_size} ? clear.depth_key : kFarthestKey);
  if (clear.accumulation)
    for (std::size_t c = 0; c < 4; ++c) fill_rect(run.memory.accumulation->component[c], clear.accumulation_levels[c], rect, run.tile_size);
}

void run_accumulation(TileRun& run, const TileAccumulation& command) {
  shade_whole_tile(run);
  const PixelRect rect = rect_in_tile(command.rect, run.frame.grid, run.tile_x, run.tile_y);
  const auto run_on = [&](std::uint32_t* color) { run_on_tile(command, rect, run.tile_x, run.tile_y, run.tile_size, color, run.memory.levels()); };
  if (command.arithmetic.op() == AccumulationOp::give_back) {
    for (int s = 0; s < run.samples; ++s) run_on(run.sample[s].color);
    return;
  }
  const bool reads_color = command.arithmetic.op() == AccumulationOp::accumulate || command.arithmetic.op() == AccumulationOp::load;
  if (run.samples > 1 && reads_color) resolve_samples(run);
  run_on(run.memory.color);
}

/// What passes the test may be farther than what was stored.
constexpr bool may_raise_depth(CompareOp test) {
  return test == CompareOp::greater || test == CompareOp::notequal || test == CompareOp::gequal || test == CompareOp::always;
}

/// Where the samples of the tile's pixels stand, with what the tile holds. Without triangles they would all be the same: one does.
void begin_samples(TileRun& run, int tile) {
  TileWorkspace::Memory& memory = run.memory;
  const TileFrame& frame = run.frame;
  std::int32_t* const stencil = memory.stencil ? memory.stencil->value : nullptr;
  run.sample[0] = {memory.color, memory.depth, memory.ids, stencil};
  run.samples = frame.samples > 1 && !frame.batches->untouched(tile) ? frame.samples : 1;
  if (run.samples == 1) return;
  TileSamples& samples = *memory.samples;
  set_farthest(run, kFarthestKey);
  const int pixels = run.tile_size * run.tile_size;
  run.sample[0].color = samples.color[0];
  if (frame.loads_color) std::copy_n(memory.color, pixels, samples.color[0]);
  for (int s = 1; s < run.samples; ++s) {
    run.sample[s] = samples.of(s, stencil != nullptr);
    if (frame.loads_color) std::copy_n(memory.color, pixels, run.sample[s].color);
    if (frame.loads_depth) std::copy_n(memory.depth, pixels, run.sample[s].depth);
    if (frame.loads_stencil) std::copy_n(stencil, pixels, run.sample[s].stencil);
  }
  if (samples.clean_samples >= run.samples && samples.clean_pixels >= pixels) return;
  for (int s = 1; s < run.samples; ++s) std::fill_n(run.sample[s].ids, pixels, kNoTriangle);
  samples.clean_samples = run.samples;
  samples.clean_pixels = pixels;
}

/// Collects elements of one draw until a group is full.
struct GroupBuilder {
  TileRun& run;
  std::uint32_t draw_number = 0;
  const TileDraw* draw = nullptr;
  DrawGroup draw_group_function = nullptr;
  // Points and lines are so small that waiting for their vertices would be most of the work: while a group is drawn, those of the next come.
  std::uint32_t fetched[2 * kGroupSize];
  int fetched_count = 0;
  std::uint32_t waiting[kGroupSize];  // triangles
  int waiting_count = 0;

  HWY_INLINE bool is_in(std::uint32_t number) const { return draw != nullptr && draw_number == number; }
  HWY_INLINE void begin_draw(std::uint32_t number) {
    const TileFrame& frame = run.frame;
    const TileDraw& next = frame.draws[number];
    // Pixels that wait for their colour keep it only from draws that write the same planes.
    if (draw != nullptr && !run.memory.triangles.empty() && (next.write_mask != draw->write_mask || !next.deferred)) shade_whole_tile(run);
    draw_number = number;
    draw = &next;
    if (next.texels == nullptr) draw_group_function = pick_draw_group(frame, next);
    if (run.samples > 1 && next.depth_write && may_raise_depth(next.depth_test)) set_farthest(run, kFarthestKey);
    // Exact at the draw's own rectangle; the frame buffer's edges may be overdrawn, nobody reads there.
    run.rect = intersect({next.rect.x0 - run.tile_x, next.rect.y0 - run.tile_y, next.rect.x1 - run.tile_x, next.rect.y1 - run.tile_y},
                         {0, 0, run.tile_size, run.tile_size});
    run.cut = ((run.rect.x0 | run.rect.y0 | run.rect.x1 | run.rect.y1) & 3) != 0;
    if (next.texels != nullptr) draw_pixel_rectangle(run, number);
  }
  HWY_INLINE void add(const Bins& bins, std::uint32_t id) {
    if (draw->topology != Topology::triangles) return add_small(bins, id);
    if ((id & kPiece) == 0) {
      waiting[waiting_count++] = id;
    } else {
      load_waiting();
      load<3>(bins, id);
    }
    if (run.memory.group.count + waiting_count < kGroupSize) return;
    load_waiting();
    draw_all();
  }
  /// Those of the entries that stand before the first one that is no triangle of the mesh's own, but no more than fill a group: how many were added.
  HWY_INLINE std::uint32_t add_own(const std::uint32_t* entries, std::uint32_t count) {
    if (draw == nullptr || draw->topology != Topology::triangles) return 0;
    const auto room = static_cast<std::uint32_t>(kGroupSize - run.memory.group.count - waiting_count), most = std::min(count, room);
    std::uint32_t added = 0;
    while (added < most && (entries[added] & (kDrawMarker | kPiece)) == 0) waiting[waiting_count + static_cast<int>(added)] = entries[added], ++added;
    waiting_count += static_cast<int>(added);
    if (added == room) {
      load_waiting();
      draw_all();
    }
    return added;
  }
  /// What was added needs these bins no longer, but for pieces' attributes.
  HWY_INLINE void leave(const Bins& bins) { draw_fetched(bins, 0); }
  /// Draws what was added; `bins` held the last of it.
  HWY_INLINE void flush(const Bins& bins) {
    leave(bins);
    load_waiting();
    draw_all();
  }

 private:
  HWY_INLINE std::size_t vertex_of(std::size_t corner) const { return draw->indices ? draw->indices[corner] : corner; }

  HWY_NOINLINE void add_small(const Bins& bins, std::uint32_t id) {
    if ((id & kPiece) == 0) {
      const std::size_t corners = draw->topology == Topology::lines ? 2 : 1;
      for (std::size_t k = 0; k < corners; ++k) fetch(vertex_of(id * corners + k));
    }
    fetched[fetched_count++] = id;
    if (fetched_count == 2 * kGroupSize) draw_fetched(bins, kGroupSize);
  }
  HWY_INLINE void fetch(std::size_t vertex) const {
    __builtin_prefetch(draw->vertices + vertex);
    if (draw->source == ColorSource::vertex_word)
      __builtin_prefetch(draw->words[0] + vertex);
    else
      __builtin_prefetch(draw->attributes + vertex * static_cast<std::size_t>(draw->attribute_stride));
  }
  /// All but the last `kept` of them.
  HWY_NOINLINE void draw_fetched(const Bins& bins, int kept) {
    const int drawn = fetched_count - kept;
    if (drawn <= 0) return;
    for (int i = 0; i < drawn; ++i) {
      draw->topology == Topology::lines ? load<2>(bins, fetched[i]) : load<1>(bins, fetched[i]);
      if (run.memory.group.count == kGroupSize) draw_all();
    }
    std::copy_n(fetched + drawn, kept, fetched);
    fetched_count = kept;
  }
  HWY_INLINE void draw_all() {
    TriangleGroup& g = run.memory.group;
    if (g.count == 0) return;
    // Lanes without a triangle repeat the first one and have no bit in the mask.
    for (int i = g.count; i < kGroupSize; ++i)
      for (int k = 0; k < 3; ++k) g.x[k][i] = g.x[k][0], g.y[k][i] = g.y[k][0], g.z[k][i] = g.z[k][0], g.rw[k][i] = g.rw[k][0];
    draw_group_function(run, draw_number);
    g.count = 0;
    if (run.memory.triangles.size() >= kMaxCollected) shade_whole_tile(run);
  }
  HWY_NOINLINE void load_waiting() {
    if (waiting_count == 0) return;  // there may be no draw yet
    int loaded = 0;
    const DrawArrays arrays{.indices = draw->indices, .vertices = draw->vertices, .attributes = draw->attributes, .stride = static_cast<std::size_t>(draw->attribute_stride)};
    for (; loaded + 4 <= waiting_count; loaded += 4) load_four(arrays, waiting + loaded);
    for (; loaded < waiting_count; ++loaded) load_own<3>(waiting[loaded]);
    waiting_count = 0;
  }
  /// What of a draw says where its vertices are. A copy: it stays in registers while groups are written.
  struct DrawArrays {
    const std::uint32_t* indices;
    const WindowVertex* vertices;
    const float* attributes;
    std::size_t stride;
  };
  HWY_INLINE void load_four(const DrawArrays& arrays, const std::uint32_t* ids) {
    TileWorkspace::Memory& memory = run.memory;
    const int i = memory.group.count;
    memory.group.count += 4;
    std::size_t first[4];  // corner
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
  // Four rows of x y z rw become columns.
  HWY_INLINE void load_four_vertices(int i, int k, const WindowVertex* const (&v)[4]) {
    constexpr hn::CappedTag<std::int32_t, 4> four;
    constexpr hn::Repartition<std::int64_t, decltype(four)> pairs;
    TriangleGroup& g = run.memory.group;
    const auto row = [&](int t) HWY_ATTR { return hn::LoadU(four, reinterpret_cast<const std::int32_t*>(v[t])); };
    const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    const auto xy01 = hn::BitCast(pairs, hn::InterleaveLower(four, r0, r1)), xy23 = hn::BitCast(pairs, hn::InterleaveLower(four, r2, r3));  // x x y y
    const auto zw01 = hn::BitCast(pairs, hn::InterleaveUpper(four, r0, r1)), zw23 = hn::BitCast(pairs, hn::InterleaveUpper(four, r2, r3));
    const auto store = [&](auto column, void* to) HWY_ATTR { hn::StoreU(hn::BitCast(four, column), four, static_cast<std::int32_t*>(to)); };
    store(hn::InterleaveLower(pairs, xy01, xy23), g.x[k] + i);
    store(hn::InterleaveUpper(pairs, xy01, xy23), g.y[k] + i);
    store(hn::InterleaveLower(pairs, zw01, zw23), g.z[k] + i);
    store(hn::InterleaveUpper(pairs, zw01, zw23), g.rw[k] + i);
  }
#endif
  template <int kCorners>
  HWY_INLINE void load(const Bins& bins, std::uint32_t id) {
    if ((id & kPiece) == 0) return load_own<kCorners>(id);
    const int i = run.memory.group.count++;
    const Piece& piece = bins.piece(id);
    const float* const attributes = bins.attributes(piece);
    for (int k = 0; k < kCorners; ++k) {
      load_vertex(i, k, piece.vertices[k]);
      run.memory.attributes[k][i] = attributes + k * draw->attribute_stride;
    }
    run.memory.source[i] = piece.source;
  }
  /// One of the mesh's own.
  template <int kCorners>
  HWY_INLINE void load_own(std::uint32_t id) {
    const int i = run.memory.group.count++;
    for (int k = 0; k < kCorners; ++k) {
      const std::size_t vertex = vertex_of(std::size_t{id} * kCorners + static_cast<std::size_t>(k));
      load_vertex(i, k, draw->vertices[vertex]);
      run.memory.attributes[k][i] = draw->attributes + vertex * static_cast<std::size_t>(draw->attribute_stride);
    }
    run.memory.source[i] = id;
  }
  HWY_INLINE void load_vertex(int i, int k, const WindowVertex& v) {
    TriangleGroup& g = run.memory.group;
    g.x[k][i] = v.x;
    g.y[k][i] = v.y;
    g.z[k][i] = v.z;
    g.rw[k][i] = v.rw;
  }
};

TileCounts render_tile_lanes(const TileFrame& frame, int tile, TileWorkspace& workspace) {
  const TileGrid& grid = frame.grid;
  TileRun run{.frame = frame,
              .memory = workspace.memory(),
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
    while (next_clear < end && frame.clears[next_clear].before_draw <= draw) run_clear(run, frame.clears[next_clear++]);
  };
  // All that was drawn before has been flushed.
  const auto commands_before = [&](std::uint32_t draw) {
    while (next_accumulation < frame.accumulation_count && frame.accumulations[next_accumulation].before_draw <= draw) {
      const TileAccumulation& command = frame.accumulations[next_accumulation++];
      clears_before(draw, command.after_clears);
      run_accumulation(run, command);
    }
    clears_before(draw, frame.clear_count);
  };
  for (std::uint32_t b = 0; b < frame.batches->count(); ++b) {
    if (frame.batches->one_by_one()) shade_whole_tile(run);  // triangles that were seen refer to the batch before
    const Bins& bins = frame.batches->read(b);
    for (std::uint32_t index = bins.first(tile); index != Bins::kNone; index = bins.block(index).next) {
      run.counts.touched = true;
      const Bins::Block& block = bins.block(index);
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
    frame.batches->one_by_one() || b + 1 == frame.batches->count() ? builder.flush(bins) : builder.leave(bins);
  }
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
  memory_->triangles.reserve(kMaxCollected + kGroupSize);
  memory_->wide.reserve(kMaxCollected + kGroupSize);
}
TileWorkspace::~TileWorkspace() = default;
TileWorkspace::TileWorkspace(TileWorkspace&&) noexcept = default;
std::uint32_t* TileWorkspace::color() { return memory_->color; }
std::int32_t* TileWorkspace::depth() { return memory_->depth; }
std::int32_t* TileWorkspace::stencil() { return memory_->stencil->value; }
const std::uint32_t* TileWorkspace::sample_color(int sample) const { return memory_->samples->color[sample]; }
AccumulatedPixels TileWorkspace::accumulation() { return memory_->levels(); }
float* TileWorkspace::normals(int component) { return memory_->normals->component[component]; }
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

std::uint32_t color_word(const ColorLayout& layout, const PaletteSearch* search, float r, float g, float b, float a) {
  if (layout.index) return search->nearest(r, g, b) & layout.word_mask();
  const std::uint32_t alpha = layout.alpha_bits == 0 ? 0 : quantize(a, layout.alpha_bits) << layout.bits;
  return quantize_rgb(layout, r, g, b) | alpha;
}

}  // namespace tessera
#endif
