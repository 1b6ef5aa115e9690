#include "engine/runtime/draw_measurer.h"

#include "raster/vertex_transform.h"

namespace tessera::detail {

void DrawMeasurer::begin_frame(std::size_t draws, std::size_t workers) {
  results_.clear();
  if (workers > 0) results_.reserve(draws);
  draws_ = draws;
  workers_in_use_ = workers;
  if (workers_.size() < workers) workers_.resize(workers);
  for (std::size_t w = 0; w < workers; ++w) {
    workers_[w].stages.assign(draws, {});
    workers_[w].tiles.begin_frame(draws);
  }
}

void DrawMeasurer::count_vertices(int worker, std::size_t draw, std::size_t first, std::size_t last) {
  if (!is_on()) return;
  of(worker, draw).vertices += last - first;
  of(worker, draw).vertex_batches += (last - first + kVertexBatch - 1) / kVertexBatch;
}

void DrawMeasurer::count_elements(int worker, std::size_t draw, const BinCounts& before,
                                  const BinCounts& after) {
  if (!is_on()) return;
  DrawMeasurement& counts = of(worker, draw);
  counts.triangles_in += after.triangles_in - before.triangles_in;
  counts.trivially_rejected += after.outside - before.outside;
  counts.culled += after.culled - before.culled;
  counts.clipped += after.clipped - before.clipped;
  counts.binned += after.binned - before.binned;
}

DrawMeter* DrawMeasurer::tile_meter(int worker) {
  return is_on() ? &workers_[static_cast<std::size_t>(worker)].tiles : nullptr;
}

void DrawMeasurer::finish() noexcept {
  if (!is_on()) return;
  results_.assign(draws_, {});
  for (std::size_t w = 0; w < workers_in_use_; ++w)
    for (std::size_t d = 0; d < draws_; ++d) {
      DrawMeasurement& sum = results_[d];
      const DrawMeasurement& stages = workers_[w].stages[d];
      const DrawCost& tiles = workers_[w].tiles.costs()[d];
      sum.vertex_seconds += stages.vertex_seconds;
      sum.binning_seconds += stages.binning_seconds;
      sum.tile_seconds += tiles.seconds;
      sum.vertices += stages.vertices;
      sum.vertex_batches += stages.vertex_batches;
      sum.triangles_in += stages.triangles_in;
      sum.trivially_rejected += stages.trivially_rejected;
      sum.culled += stages.culled;
      sum.clipped += stages.clipped;
      sum.binned += stages.binned;
      sum.tiles += tiles.tiles;
      sum.shaded_pixels += tiles.shaded_pixels;
      sum.fragments += tiles.fragments;
    }
}

}  // namespace tessera::detail
