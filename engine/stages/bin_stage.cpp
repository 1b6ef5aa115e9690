#include "engine/stages/bin_stage.h"

#include <algorithm>

#include "engine/plan/tile_draws.h"
#include "raster/polygon_offset.h"
#include "raster/sample_positions.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kTrianglesPerBatch = 1024;
/// Upper bound of a triangle's memory in the bins of a single tile: its entry and its clipped pieces, in
/// lists that grow by doubling. Triangles of an outlined polygon share their entries.
constexpr std::size_t kMaxBytesPerTriangle = 8192;

void bin_elements(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                  std::uint32_t last, InstructionSet isa) {
  switch (draw.topology) {
    case Topology::points: return bin_points(bins, grid, draw, first, last);
    case Topology::lines: return bin_lines(bins, grid, draw, first, last);
    case Topology::triangles: break;
  }
  if (draw.modes != nullptr) return bin_polygons(bins, grid, draw, first, last, isa);
  bin_triangles(bins, grid, draw, first, last, isa);
}

/// Inputs of binning, except the polygon modes.
BinDraw bin_draw(const GeometryDraw& geometry, std::uint32_t first_tile_draw, int samples) {
  const DrawPlan& plan = *geometry.plan;
  BinDraw draw;
  draw.draw = first_tile_draw;
  draw.topology = plan.topology;
  draw.point_line_size = plan.topology == Topology::points ? plan.point_size : plan.line_width;
  draw.samples = samples;
  draw.vertices = geometry.buffers->vertices.data();
  draw.indices = geometry.indices();
  draw.outcodes = geometry.buffers->outcodes.data();
  draw.any_outcode = geometry.buffers->any_outcode;
  draw.keep_front = plan.keep_front;
  draw.keep_back = plan.keep_back;
  draw.front_is_clockwise = plan.front_is_clockwise;
  draw.facing = geometry.facing();
  draw.rect = plan.rect;
  draw.sample_reach = sample_reach(samples);
  draw.transform = &plan.transform;
  draw.positions = geometry.mesh->positions;
  draw.components = geometry.mesh->components;
  if (plan.vertex_stage != nullptr && plan.vertex_stage->writes.clip)
    draw.clip_positions = geometry.buffers->staged.clip.data();
  draw.attributes = geometry.buffers->attributes.data();
  draw.attribute_count = draw.attribute_stride = plan.varyings.count;
  return draw;
}

void set_polygon_modes(BinDraw& draw, const GeometryDraw& geometry) {
  const DrawPlan& plan = *geometry.plan;
  PolygonModes& modes = geometry.buffers->modes;
  modes = {.mode = {plan.mode[0], plan.mode[1]},
           .line_width = plan.line_width,
           .point_size = plan.point_size,
           .triangles = geometry.mesh->triangles_per_polygon(),
           .boundary = geometry.buffers->boundary.data()};
  std::uint32_t number = draw.draw;
  for (const PolygonMode mode : polygon_modes_of(plan)) modes.draw[static_cast<int>(mode)] = number++;
  draw.modes = &modes;
}

}  // namespace

void BinStage::begin(const FrameCommands& commands, const TileGrid& grid, int samples) {
  commands_ = &commands;
  grid_ = grid;
  first_element_.assign(1, 0);
  for (const GeometryDraw& draw : commands.geometry)
    first_element_.push_back(first_element_.back() + (draw.plan->pixel_rectangle ? 1 : draw.mesh->elements));
  batch_count_ = std::clamp<std::size_t>(first_element_.back() / kTrianglesPerBatch, 1,
                                         4 * static_cast<std::size_t>(worker_pool_.threads()));
  if (bins_.size() < batch_count_) bins_.resize(batch_count_);
  prepare_draws(samples);
}

void BinStage::prepare_draws(int samples) {
  draws_.clear();
  draw_rects_.clear();
  for (std::size_t d = 0; d < commands_->geometry.size(); ++d) {
    const GeometryDraw& geometry = commands_->geometry[d];
    if (geometry.has_polygon_offsets()) geometry.buffers->depth_offsets.resize(geometry.mesh->elements);
    BinDraw draw = bin_draw(geometry, commands_->first_tile_draw[d], samples);
    if (geometry.plan->outlines) set_polygon_modes(draw, geometry);
    draws_.push_back(draw);
    draw_rects_.push_back(draw.rect);
  }
  compute_polygon_values();
}

void BinStage::compute_polygon_values() {
  polygon_ranges_.split(
      draws_.size(),
      [&](std::size_t d) {
        const GeometryDraw& geometry = commands_->geometry[d];
        const bool has_values = draws_[d].facing != nullptr || geometry.has_polygon_offsets();
        return has_values ? geometry.mesh->elements : 0;
      },
      kTrianglesPerBatch);
  worker_pool_.for_each(polygon_ranges_.size(), [&](std::size_t i, int worker) {
    const DrawRange range = polygon_ranges_[i];
    draw_measurer_.run(worker, commands_->plan_draw[range.draw], &DrawMeasurement::binning_seconds,
                       [&] { compute_polygon_values(range); });
  });
}

void BinStage::compute_polygon_values(const DrawRange& range) const {
  const GeometryDraw& geometry = commands_->geometry[range.draw];
  const std::size_t each = geometry.mesh->triangles_per_polygon();
  if (geometry.facing() != nullptr)
    classify_polygon_facing(draws_[range.draw], each, range.first, range.last,
                            geometry.buffers->facing.data());
  const DrawPlan& plan = *geometry.plan;
  if (geometry.has_polygon_offsets())
    offset_polygons(draws_[range.draw], each, plan.offset_factor, plan.offset_units, range.first, range.last,
                    geometry.buffers->depth_offsets.data());
}

bool BinStage::fill(const TileRange& tiles, FrameProgress& progress) {
  const PixelRect pixels{tiles.x0 * grid_.tile_size, tiles.y0 * grid_.tile_size, tiles.x1 * grid_.tile_size,
                         tiles.y1 * grid_.tile_size};
  for (std::size_t d = 0; d < draws_.size(); ++d) draws_[d].rect = intersect(draw_rects_[d], pixels);
  // Serial: visits every batch, unless the last fill was complete and fitted.
  if (!budget_is_exact_) start_budget();
  budget_is_exact_ = false;
  worker_counts_.assign(static_cast<std::size_t>(worker_pool_.threads()), {});
  const std::size_t elements = first_element_.back();
  worker_pool_.for_each(batch_count_, [&](std::size_t b, int worker) {
    progress.task(worker, [&] {
      bins_[b].reset(tiles.count(), tiles.first(grid_), &budget_);
      bin(bins_[b], elements * b / batch_count_, elements * (b + 1) / batch_count_, worker);
      worker_counts_[static_cast<std::size_t>(worker)].counts += bins_[b].counts;
    });
  });
  counts_ = {};
  for (const WorkerCounts& of_worker : worker_counts_) counts_ += of_worker.counts;
  if (!budget_.refused()) {
    budget_is_exact_ = true;
    batches_.set({bins_.data(), batch_count_}, tiles.count(), tiles.first(grid_));
    return true;
  }
  // Release the memory: the next ranges may need it for other batches.
  for (Bins& bins : bins_) bins = Bins();
  if (tiles.count() > 1) return false;
  fill_one_by_one(tiles);
  return true;
}

void BinStage::start_budget() {
  std::size_t taken = 0;
  for (const Bins& bins : bins_) taken += bins.bytes();
  budget_.start(limit_bytes_, taken);
}

void BinStage::fill_one_by_one(const TileRange& tile) {
  const std::size_t elements = first_element_.back();
  const std::size_t each = std::max<std::size_t>(limit_bytes_ / kMaxBytesPerTriangle, 1);
  const auto count = static_cast<std::uint32_t>((elements + each - 1) / each);
  batches_.set_streamed(bins_.front(), count,
                        [this, first_tile = tile.first(grid_), elements, each](std::uint32_t b) {
                          bins_.front().reset(1, first_tile);
                          // A pass over a single tile has one task, so no other worker measures as worker 0.
                          bin(bins_.front(), b * each, std::min(elements, (b + 1) * each), 0);
                        });
}

void BinStage::bin(Bins& bins, std::size_t begin, std::size_t end, int worker) const {
  for (std::size_t d = 0; d < draws_.size(); ++d) {
    const std::size_t low = std::max(begin, first_element_[d]);
    const std::size_t high = std::min(end, first_element_[d + 1]);
    if (low >= high) continue;
    const std::size_t draw = commands_->plan_draw[d];
    const BinCounts before = bins.counts;
    draw_measurer_.run(worker, draw, &DrawMeasurement::binning_seconds, [&] {
      bin_draw_range(bins, {d, low - first_element_[d], high - first_element_[d]});
    });
    draw_measurer_.count_elements(worker, draw, before, bins.counts);
  }
}

void BinStage::bin_draw_range(Bins& bins, const DrawRange& range) const {
  const BinDraw& draw = draws_[range.draw];
  if (commands_->plans[range.draw]->pixel_rectangle) {
    if (!draw.rect.empty()) bin_pixels(bins, grid_, draw.draw, draw.rect);
  } else {
    bin_elements(bins, grid_, draw, static_cast<std::uint32_t>(range.first),
                 static_cast<std::uint32_t>(range.last), isa_);
  }
}

}  // namespace tessera::detail
