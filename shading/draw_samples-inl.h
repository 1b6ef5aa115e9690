// Draws without operations where pixels have several samples: each sample goes the way of a tile with one, over the group of
// triangles moved by as much the other way (raster/sample_positions.h).
#if defined(TESSERA_SHADING_DRAW_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#undef TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#else
#define TESSERA_SHADING_DRAW_SAMPLES_INL_H_
#endif

#include "raster/sample_positions.h"
#include "shading/deferred_samples-inl.h"
#include "shading/draw_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

HWY_INLINE void move_group(TriangleGroup& g, std::int32_t x, std::int32_t y) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < kGroupSize; ++i) {
      g.x[k][i] += x;
      g.y[k][i] += y;
    }
}

/// Triangle i of a group that stands where its vertices are: what its pixels' centres see, inside of it or not.
inline HWY_NOINLINE void fill_centered_triangle(ShadedTriangle& triangle, TileRun& run, std::uint32_t draw_number, int i, bool back) {
  const TriangleGroup& g = run.memory.group;
  fill_shaded_triangle(triangle, run, draw_number, i, back);
  if (g.wide[i] == 0) return;
  TileEdges edges;
  WideEdges wide;
  tile_edges_of_wide(g, i, run.tile_x, run.tile_y, run.tile_size, edges, wide);
  keep_wide_edges(triangle, run.memory, wide);
}

template <class Depth, Test kTest, Seen kSeen>
void draw_group_samples(TileRun& run, std::uint32_t draw_number) {
  TileWorkspace::Memory& memory = run.memory;
  TriangleGroup& g = memory.group;
  const std::size_t triangles = memory.triangles.size(), wide = memory.wide.size();
  if constexpr (kSeen == Seen::collect_sample) {
    set_up_edges(g, run.tile_x, run.tile_y, run.rect);
    set_up_weights(g);
    memory.triangles.resize(triangles + static_cast<std::size_t>(g.count));
    for (int i = 0; i < g.count; ++i)
      fill_centered_triangle(memory.triangles[triangles + static_cast<std::size_t>(i)], run, draw_number, i,
                             !is_front(g.signed_area[i], run.frame.draws[draw_number].front_is_clockwise));
  }
  const SamplePosition* const positions = sample_positions(run.samples);
  SamplePosition moved{0, 0};
  run.any_seen = false;
  for (int s = 0; s < run.samples; ++s) {
    move_group(g, moved.x - positions[s].x, moved.y - positions[s].y);
    moved = positions[s];
    run.pixels = run.sample[s];
    draw_group<Depth, kTest, kSeen>(run, draw_number);
  }
  if constexpr (kSeen == Seen::collect_sample) {
    if (!run.any_seen) {
      memory.triangles.resize(triangles);
      memory.wide.resize(wide);
    } else if (run.frame.shade_at_once) {
      shade_whole_tile(run);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif
