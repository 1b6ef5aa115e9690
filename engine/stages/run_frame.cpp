// A frame, stage by stage: plan, vertices, bins, tiles, store.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include "engine/record/recording.h"
#include "engine/runtime/renderer_state.h"
#include "engine/stages/capture_stage.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kVerticesPerTask = 512, kElementsPerTask = 4096;
constexpr int kTilesPerTask = 8;  // to be looked through
// How much of a frame is done after the stages before the tiles, for a progress bar.
constexpr double kElementsDone = 0.03, kNormalsDone = 0.08, kVerticesDone = 0.15, kFlatColorsDone = 0.2,
                 kBinsDone = 0.3;

/// Seconds since it was last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void count_triangles(FrameStats& stats, const BinCounts& counts) {
  stats.triangles_in = counts.triangles_in;
  stats.dropped_non_finite = counts.non_finite;
  stats.trivially_rejected = counts.outside;
  stats.culled = counts.culled;
  stats.zero_area = counts.zero_area;
  stats.clipped = counts.clipped;
  stats.binned = counts.binned;
  stats.bin_entries = counts.entries;
}

/// How much of a frame is done after so many of its tiles.
double done_after(int tiles, const FrameStats& stats) {
  return std::lerp(kBinsDone, 1.0, static_cast<double>(tiles) / static_cast<double>(stats.tiles));
}

/// What of the frame a strip is, from its lower left corner.
Rect strip_rect(const TileStrip& strip, const TileGrid& grid) {
  const int size = grid.tile_size, x0 = strip.first_column * size, y0 = strip.row * size;
  const int x1 = std::min((strip.last_column + 1) * size, grid.width_px),
            y1 = std::min(y0 + size, grid.height_px);
  return {x0, grid.height_px - y1, x1 - x0, y1 - y0};
}

/// @pre several tiles
std::array<TileRange, 2> split_range(const TileRange& tiles) {
  TileRange first = tiles, second = tiles;
  if (tiles.y1 - tiles.y0 > 1) first.y1 = second.y0 = std::midpoint(tiles.y0, tiles.y1);
  else first.x1 = second.x0 = std::midpoint(tiles.x0, tiles.x1);
  return {first, second};
}

/// What a buffer holds after all its tiles were rendered.
void commit_attachments(const AttachmentOps& attachment_ops, std::span<Attachment> attachments) {
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    Attachment& stored = attachments[i];
    if (attachment_ops.store) stored.content = Attachment::Content::planes;
    else if (attachment_ops.keep && attachment_ops.ends_fast_cleared)
      stored.fast_clear(attachment_ops.clear_values[i]);
    else if (!attachment_ops.keep && attachment_ops.touched) stored.content = Attachment::Content::undefined;
    stored.materialize_external_memory();
  }
}

/// And after some: those of the planes that were stored are new. What was lost stays lost.
void commit_interrupted(const AttachmentOps& attachment_ops, std::span<Attachment> attachments) {
  for (Attachment& stored : attachments)
    if (attachment_ops.store && stored.content == Attachment::Content::fast_cleared)
      stored.content = Attachment::Content::planes;
}

/// Takes the memory for what will be stored, with what tiles that are never rendered hold.
void reserve_planes(const AttachmentOps& attachment_ops, std::span<Attachment> attachments) {
  if (!attachment_ops.store) return;
  for (Attachment& stored : attachments) {
    if (!stored.planes.allocated()) stored.planes.allocate(stored.clear_value);
    else if (stored.content == Attachment::Content::fast_cleared) stored.planes.fill(stored.clear_value);
  }
}

}  // namespace

int RendererState::tile_size_for(const FrameBufferFormat& format) const {
  if (options.tile_size != 0) return options.tile_size;
  if (format.samples > 1) return 64;  // the samples of a larger one leave the cache
  // Large tiles repeat less setup; small ones keep more threads busy.
  const double pixels = static_cast<double>(format.width) * format.height;
  return pixels / worker_pool.threads() >= 64 * 128 * 128 / 4 ? 128 : 64;
}

void RendererState::process_geometry(FrameProgress& progress) {
  for (const GeometryDraw& draw : commands.geometry) prepare_geometry(draw);
  split_draws([](const GeometryDraw& draw) { return draw.assembles() ? draw.mesh->elements : 0; },
              kElementsPerTask);
  progress.begin_stage(FrameStage::vertices, kElementsDone, ranges.size());
  worker_pool.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    progress.task(worker, [&] { assemble_elements(commands.geometry[range.draw], range.first, range.last); });
  });
  normal_stage.run(commands.geometry, worker_pool, progress, kNormalsDone);
  split_draws([](const GeometryDraw& draw) { return draw.mesh->vertices; }, kVerticesPerTask);
  progress.begin_stage(FrameStage::vertices, kVerticesDone, ranges.size());
  worker_pool.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    progress.task(worker,
                  [&] { process_vertices(commands.geometry[range.draw], range.first, range.last, isa); });
  });
  split_draws(
      [](const GeometryDraw& draw) { return draw.plan->has_per_triangle_colors() ? draw.mesh->elements : 0; },
      kVerticesPerTask);
  progress.begin_stage(FrameStage::flat_colors, kFlatColorsDone, ranges.size());
  worker_pool.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    progress.task(worker,
                  [&] { compute_flat_colors(commands.geometry[range.draw], range.first, range.last, isa); });
  });
}

void RendererState::prepare_workspaces(const WorkspaceRequirements& memory) {
  // One core does this alone, and most frames want what the one before them did.
  if (prepared_requirements == memory) return;
  while (workspaces.size() < static_cast<std::size_t>(worker_pool.threads())) workspaces.emplace_back();
  for (TileWorkspace& workspace : workspaces) {
    workspace.allocate_colors(memory.colors);
    if (memory.normals) workspace.allocate_normals();
    if (memory.stencil) workspace.allocate_stencil();
    if (memory.accumulation) workspace.allocate_accumulation();
    if (memory.samples) workspace.allocate_samples();
  }
  prepared_requirements = memory;
}

template <class Count>
void RendererState::split_draws(const Count& count, std::size_t each) {
  ranges.split(
      commands.geometry.size(), [&](std::size_t d) { return count(commands.geometry[d]); }, each);
}

void RendererState::index_bin_batches(const TileStage& stage, const TileRange& tiles, const FrameStats& stats,
                                      FrameProgress& progress) {
  const int first = tiles.first(stage.grid()), last = first + tiles.count();
  const auto tasks = static_cast<std::size_t>((tiles.count() + kTilesPerTask - 1) / kTilesPerTask);
  progress.begin_stage(FrameStage::binning, done_after(first, stats), tasks);
  worker_pool.for_each(tasks, [&](std::size_t task, int worker) {
    const int begin = first + static_cast<int>(task) * kTilesPerTask;
    progress.task(worker,
                  [&] { bin_stage.batches().index_batches(begin, std::min(kTilesPerTask, last - begin)); });
  });
}

void RendererState::render_tiles(const TileStage& stage, const TileRange& tiles, FrameStats& stats,
                                 FrameProgress& progress) {
  worker_counts.assign(static_cast<std::size_t>(worker_pool.threads()), {});
  index_bin_batches(stage, tiles, stats, progress);
  stage.build_strips(tiles, worker_pool, strip_scratch);
  const std::vector<TileStrip>& strips = strip_scratch.strips;
  progress.begin_stage(FrameStage::tiles, done_after(tiles.first(stage.grid()) + tiles.count(), stats),
                       strips.size());
  worker_pool.for_each(strips.size(), [&](std::size_t i, int worker) {
    progress.task(worker, strip_rect(strips[i], stage.grid()), [&] {
      stage.render(strips[i], workspaces[static_cast<std::size_t>(worker)],
                   worker_counts[static_cast<std::size_t>(worker)]);
    });
  });
  for (const WorkerCounts& c : worker_counts) {
    stats.shaded_pixels += c.shaded_pixels;
    stats.tiles_touched += c.touched;
    stats.fragments += c.fragments;
  }
}

void RendererState::render_ranges(bool is_filled, const TileStage& stage, FrameStats& stats,
                                  FrameProgress& progress) {
  StopWatch clock;
  std::vector<TileRange>& left = pending_ranges;
  left.clear();
  const auto split = [&](const TileRange& tiles) {
    const auto [first, second] = split_range(tiles);
    left.insert(left.end(), {second, first});
  };
  const TileRange whole{0, 0, stage.grid().columns(), stage.grid().rows()};
  is_filled ? left.push_back(whole) : split(whole);
  while (!left.empty()) {
    const TileRange tiles = left.back();
    left.pop_back();
    if (!is_filled) {
      progress.begin_stage(FrameStage::binning, done_after(tiles.first(stage.grid()), stats),
                           bin_stage.batch_count());
      is_filled = bin_stage.fill(tiles, progress);
      ++stats.bin_passes;
    }
    stats.binning_seconds += clock.lap();
    if (!is_filled) {
      split(tiles);
      continue;
    }
    render_tiles(stage, tiles, stats, progress);
    stats.tile_seconds += clock.lap();
    is_filled = false;
  }
}

FrameStats RendererState::run(FrameRecording& recording, const ImageTarget* image) {
  const FloatingPointMode mode;
  StopWatch clock;
  FrameStats stats;
  FrameTrace trace(options.trace ? worker_pool.threads() : 0);
  FrameProgress progress(options.progress, trace);
  FrameBufferState& target = *recording.target;
  plan_frame(commands, recording, image != nullptr, draw_buffers, worker_pool);

  // Memory for what will be stored is taken before anything changes.
  for (const Buffer which : kBuffers)
    reserve_planes(commands.attachment_ops(which), target.attachments(which));

  for (const GeometryDraw& draw : commands.geometry) stats.vertices += draw.mesh->vertices;
  const TileGrid grid{target.format.width, target.format.height, tile_size_for(target.format)};
  stats.tiles = static_cast<std::uint64_t>(grid.count());
  stats.tile_size = grid.tile_size;
  stats.plan_seconds = clock.lap();

  process_geometry(progress);
  stats.vertex_seconds = clock.lap();
  bin_stage.begin(commands, grid, target.format.samples);
  progress.begin_stage(FrameStage::binning, kBinsDone, bin_stage.batch_count());
  const bool is_filled = bin_stage.fill({0, 0, grid.columns(), grid.rows()}, progress);
  count_triangles(stats, bin_stage.counts());
  stats.bin_passes = 1;
  build_tile_draws(commands, {.layout = target.layout,
                              .depth_format = target.depth_format,
                              .samples = target.format.samples,
                              .shade_immediately = !options.defer_shading,
                              .isa = isa});
  stats.binning_seconds = clock.lap();

  TileFrame frame;
  frame.grid = grid;
  frame.layout = target.layout;
  for (const DrawPlan* plan : commands.plans)
    if (plan->uses_palette()) frame.palette_search = target.ensure_palette_search();
  frame.depth_format = target.depth_format;
  frame.draws = commands.tile_draws.data();
  frame.draw_count = static_cast<std::uint32_t>(commands.tile_draws.size());
  frame.clears = commands.clears.data();
  frame.clear_count = static_cast<std::uint32_t>(commands.clears.size());
  frame.accumulations = commands.accumulations.data();
  frame.accumulation_count = static_cast<std::uint32_t>(commands.accumulations.size());
  frame.batches = &bin_stage.batches();
  frame.shade_immediately = !options.defer_shading;
  frame.samples = target.format.samples;
  frame.loads_color = commands.color.load;
  frame.loads_depth = commands.depth.load;
  frame.loads_stencil = commands.stencil.load;
  const CaptureStage capture(commands, frame, recording.capture, options.count_fragments, isa);
  if (commands.stores() || image || !commands.plans.empty() || capture.any()) {
    const TileStage stage(commands, frame, target, image, capture, scan_out_cache, isa);
    prepare_workspaces({.colors = stage.buffered_tiles(),
                        .normals = capture.needs_normals(),
                        .stencil = commands.stencil.used,
                        .accumulation = commands.accumulation.used,
                        .samples = frame.samples > 1});
    try {
      render_ranges(is_filled, stage, stats, progress);
    } catch (...) {
      for (const Buffer which : kBuffers)
        commit_interrupted(commands.attachment_ops(which), target.attachments(which));
      throw;
    }
  }
  for (const Buffer which : kBuffers)
    commit_attachments(commands.attachment_ops(which), target.attachments(which));
  if (options.trace) options.trace(trace.tasks());
  return stats;
}

void RendererState::report(const FrameStats& stats) const {
  if (stats.dropped_non_finite > 0)
    log(LogLevel::warning, [&] {
      return std::to_string(stats.dropped_non_finite) +
             " triangles, lines or points with a NaN or infinite vertex were dropped";
    });
  log(LogLevel::debug, [&] {
    return "frame: " + std::to_string(stats.triangles_in) + " triangles, lines and points, " +
           std::to_string(stats.tiles_touched) + " of " + std::to_string(stats.tiles) + " tiles of " +
           std::to_string(stats.tile_size) + " pixels, " + std::to_string(stats.shaded_pixels) +
           " shaded pixels";
  });
}

}  // namespace tessera::detail
