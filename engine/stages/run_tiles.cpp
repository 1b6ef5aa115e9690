// The tile stage: all tiles at once if their bins are filled, else in parts whose bins fit in memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/runtime/renderer_state.h"
#include "engine/stages/capture_stage.h"
#include "engine/stages/frame_context.h"

namespace tessera::detail {
namespace {

constexpr int kTilesPerTask = 8;  // tiles whose batches one task indexes

/// Share of the frame that is done after this number of tiles.
double done_after(int tiles, const FrameStats& stats) {
  return std::lerp(kBinsDone, 1.0, static_cast<double>(tiles) / static_cast<double>(stats.tiles));
}

/// Pixels of a strip in the frame, origin lower left.
Rect strip_rect(const TileStrip& strip, const TileGrid& grid) {
  const int size = grid.tile_size;
  const int x0 = strip.first_column * size;
  const int y0 = strip.row * size;
  const int x1 = std::min((strip.last_column + 1) * size, grid.width_px);
  const int y1 = std::min(y0 + size, grid.height_px);
  return {x0, grid.height_px - y1, x1 - x0, y1 - y0};
}

/// Whether tiles keep the depths of a draw's visible fragments for its stage.
bool keeps_stage_depth(const DrawPlan* plan) {
  return plan->fragment_stage && plan->deferred && plan->fragment_stage->stage.reads.depth;
}

/// Halves the rows, or the columns of a single row.
/// @pre several tiles
std::array<TileRange, 2> split_range(const TileRange& tiles) {
  TileRange first = tiles, second = tiles;
  if (tiles.y1 - tiles.y0 > 1) first.y1 = second.y0 = std::midpoint(tiles.y0, tiles.y1);
  else first.x1 = second.x0 = std::midpoint(tiles.x0, tiles.x1);
  return {first, second};
}

}  // namespace

TileFrame RendererState::tile_frame(FrameContext& frame) {
  TileFrame tiles;
  tiles.stage_failure = &frame.stage_failure;
  tiles.grid = frame.grid;
  tiles.layout = frame.target.layout;
  for (const DrawPlan* plan : commands.plans)
    if (plan->uses_palette()) tiles.palette_search = frame.target.ensure_palette_search();
  tiles.depth_format = frame.target.depth_format;
  tiles.draws = commands.tile_draws.data();
  tiles.draw_count = static_cast<std::uint32_t>(commands.tile_draws.size());
  tiles.clears = commands.clears.data();
  tiles.clear_count = static_cast<std::uint32_t>(commands.clears.size());
  tiles.clear_patterns = commands.clear_patterns.data();
  if (frame.target.dither) {
    tiles.clear_pattern_rows = frame.target.dither->pattern().size();
    tiles.clear_pattern_columns = frame.target.dither->pattern().columns();
  }
  tiles.accumulations = commands.accumulations.data();
  tiles.accumulation_count = static_cast<std::uint32_t>(commands.accumulations.size());
  tiles.batches = &bin_stage.batches();
  tiles.shade_immediately = !options.debug.defer_shading;
  tiles.samples = frame.target.format.samples;
  tiles.meter_pass = options.debug.measure_draws ? MeterPass::costs : MeterPass::none;
  tiles.loads_color = commands.attachments.color.loads();
  tiles.loads_depth = commands.attachments.depth.loads();
  tiles.loads_stencil = commands.attachments.stencil.loads();
  return tiles;
}

void RendererState::prepare_workspaces(const WorkspaceRequirements& memory) {
  // Serial; most frames have the requirements of the frame before.
  if (prepared_requirements == memory) return;
  while (workspaces.size() < static_cast<std::size_t>(worker_pool.threads())) workspaces.emplace_back();
  for (TileWorkspace& workspace : workspaces) {
    workspace.allocate_colors(memory.colors);
    if (memory.normals) workspace.allocate_normals();
    if (memory.stencil) workspace.allocate_stencil();
    if (memory.accumulation) workspace.allocate_accumulation();
    if (memory.samples) workspace.allocate_samples();
    if (memory.stage_depth) workspace.allocate_stage_depth();
  }
  prepared_requirements = memory;
}

void RendererState::run_tiles(FrameContext& frame) {
  const TileFrame tiles = tile_frame(frame);
  const CaptureStage capture(commands, tiles, frame.recording.capture, options.debug.count_fragments, isa);
  const bool has_output = commands.attachments.any_stores() || frame.image != nullptr;
  if (!has_output && commands.plans.empty() && !capture.any()) return;
  // Colours that error diffusion reduces are shown after the last tile.
  const ImageTarget* const image = frame.target.diffusion ? nullptr : frame.image;
  const TileStage stage(commands, tiles, frame.target, image, capture, scan_out_cache, isa);
  prepare_workspaces(
      {.colors = stage.buffered_tiles(),
       .normals = capture.needs_normals(),
       .stencil = commands.attachments.stencil.used(),
       .accumulation = commands.attachments.accumulation.used(),
       .samples = tiles.samples > 1,
       .stage_depth = std::any_of(commands.plans.begin(), commands.plans.end(), keeps_stage_depth)});
  for (std::size_t w = 0; w < measured_workers(); ++w)
    workspaces[w].set_meter(draw_measurer.tile_meter(static_cast<int>(w)));
  try {
    render_parts(frame, stage);
  } catch (...) {
    commit_interrupted_buffers(frame);
    throw;
  }
}

void RendererState::render_parts(FrameContext& frame, const TileStage& stage) {
  std::vector<TileRange>& pending = pending_ranges;
  pending.clear();
  const auto split = [&](const TileRange& tiles) {
    const auto [first, second] = split_range(tiles);
    pending.insert(pending.end(), {second, first});
  };
  bool is_filled = frame.bins_filled;
  const TileRange whole{0, 0, frame.grid.columns(), frame.grid.rows()};
  if (is_filled) pending.push_back(whole);
  else split(whole);
  while (!pending.empty()) {
    const TileRange tiles = pending.back();
    pending.pop_back();
    if (!is_filled) {
      frame.progress.begin_stage(FrameStage::binning, done_after(tiles.first(frame.grid), frame.stats),
                                 bin_stage.batch_count());
      is_filled = bin_stage.fill(tiles, frame.progress);
      ++frame.stats.bin_passes;
    }
    frame.stats.binning_seconds += frame.clock.lap();
    if (!is_filled) {
      split(tiles);
      continue;
    }
    render_tiles(frame, stage, tiles);
    frame.stats.tile_seconds += frame.clock.lap();
    is_filled = false;
  }
}

void RendererState::index_bin_batches(FrameContext& frame, const TileRange& tiles) {
  const int first = tiles.first(frame.grid), last = first + tiles.count();
  const auto tasks = static_cast<std::size_t>((tiles.count() + kTilesPerTask - 1) / kTilesPerTask);
  frame.progress.begin_stage(FrameStage::binning, done_after(first, frame.stats), tasks);
  worker_pool.for_each(tasks, [&](std::size_t task, int worker) {
    const int begin = first + static_cast<int>(task) * kTilesPerTask;
    frame.progress.task(
        worker, [&] { bin_stage.batches().index_batches(begin, std::min(kTilesPerTask, last - begin)); });
  });
}

void RendererState::render_tiles(FrameContext& frame, const TileStage& stage, const TileRange& tiles) {
  worker_counts.assign(static_cast<std::size_t>(worker_pool.threads()), {});
  index_bin_batches(frame, tiles);
  stage.build_strips(tiles, worker_pool, strip_scratch);
  const std::vector<TileStrip>& strips = strip_scratch.strips;
  frame.progress.begin_stage(FrameStage::tiles,
                             done_after(tiles.first(frame.grid) + tiles.count(), frame.stats), strips.size());
  worker_pool.for_each(strips.size(), [&](std::size_t i, int worker) {
    frame.progress.task(worker, strip_rect(strips[i], frame.grid), [&] {
      stage.render(strips[i], workspaces[static_cast<std::size_t>(worker)],
                   worker_counts[static_cast<std::size_t>(worker)]);
      if (frame.stage_failure.any()) frame.stage_failure.rethrow();
    });
  });
  for (const WorkerCounts& counts : worker_counts) {
    frame.stats.shaded_pixels += counts.shaded_pixels;
    frame.stats.non_finite_fragments += counts.non_finite_fragments;
    frame.stats.hidden_triangles += counts.hidden_triangles;
    frame.stats.tiles_rendered += counts.rendered;
    frame.stats.tiles_touched += counts.touched;
    frame.stats.fragments += counts.fragments;
  }
}

}  // namespace tessera::detail
