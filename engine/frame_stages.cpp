// A frame, stage by stage: plan, vertices, bins, tiles, store.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include "engine/capture_stage.h"
#include "engine/recording.h"
#include "engine/renderer_state.h"

namespace tessera {
namespace {

constexpr std::size_t kVerticesPerTask = 512, kElementsPerTask = 4096;
constexpr int kTilesPerTask = 8;  // to be looked through
// How much of a frame is done after the stages before the tiles, for a progress bar.
constexpr double kElementsDone = 0.03, kNormalsDone = 0.08, kVerticesDone = 0.15, kFacesDone = 0.2,
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
  stats.outside = counts.outside;
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
Rect pixels_of(const TileStrip& strip, const TileGrid& grid) {
  const int size = grid.tile_size, x0 = strip.first_column * size, y0 = strip.row * size;
  const int x1 = std::min((strip.last_column + 1) * size, grid.width_px),
            y1 = std::min(y0 + size, grid.height_px);
  return {x0, grid.height_px - y1, x1 - x0, y1 - y0};
}

/// @pre several tiles
std::array<TileRange, 2> halves(const TileRange& tiles) {
  TileRange first = tiles, second = tiles;
  if (tiles.y1 - tiles.y0 > 1) first.y1 = second.y0 = std::midpoint(tiles.y0, tiles.y1);
  else first.x1 = second.x0 = std::midpoint(tiles.x0, tiles.x1);
  return {first, second};
}

/// What a buffer holds after all its tiles were rendered.
void settle(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    StoredBuffer& stored = parts[i];
    if (traffic.store) stored.content = StoredBuffer::Content::planes;
    else if (traffic.keep && traffic.ends_uniform) stored.become_uniform(traffic.uniform_words[i]);
    else if (!traffic.keep && traffic.touched) stored.content = StoredBuffer::Content::lost;
    stored.settle_lent_memory();
  }
}

/// And after some: those of the planes that were stored are new. What was lost stays lost.
void settle_interrupted(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  for (StoredBuffer& stored : parts)
    if (traffic.store && stored.content == StoredBuffer::Content::uniform)
      stored.content = StoredBuffer::Content::planes;
}

/// Takes the memory for what will be stored, with what tiles that are never rendered hold.
void prepare_planes(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  if (!traffic.store) return;
  for (StoredBuffer& stored : parts) {
    if (!stored.planes.allocated()) stored.planes.allocate(stored.word);
    else if (stored.content == StoredBuffer::Content::uniform) stored.planes.fill(stored.word);
  }
}

}  // namespace

int RendererState::tile_size_for(const FrameBufferFormat& format) const {
  if (options.tile_size != 0) return options.tile_size;
  if (format.samples > 1) return 64;  // the samples of a larger one leave the cache
  // Large tiles repeat less setup; small ones keep more threads busy.
  const double pixels = static_cast<double>(format.width) * format.height;
  return pixels / parallel.threads() >= 64 * 128 * 128 / 4 ? 128 : 64;
}

void RendererState::process_geometry(FrameWatch& watch) {
  for (const GeometryDraw& draw : commands.geometry) prepare_geometry(draw);
  cut_draws([](const GeometryDraw& draw) { return draw.assembles() ? draw.mesh->elements : 0; },
            kElementsPerTask);
  watch.begin_stage(FrameStage::vertices, kElementsDone, ranges.size());
  parallel.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    watch.task(worker, [&] { assemble_elements(commands.geometry[range.draw], range.first, range.last); });
  });
  normal_stage.run(commands.geometry, parallel, watch, kNormalsDone);
  cut_draws([](const GeometryDraw& draw) { return draw.mesh->vertices; }, kVerticesPerTask);
  watch.begin_stage(FrameStage::vertices, kVerticesDone, ranges.size());
  parallel.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    watch.task(worker,
               [&] { process_vertices(commands.geometry[range.draw], range.first, range.last, isa); });
  });
  cut_draws([](const GeometryDraw& draw) { return draw.plan->colors_triangles() ? draw.mesh->elements : 0; },
            kVerticesPerTask);
  watch.begin_stage(FrameStage::faces, kFacesDone, ranges.size());
  parallel.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    watch.task(worker,
               [&] { process_triangles(commands.geometry[range.draw], range.first, range.last, isa); });
  });
}

void RendererState::prepare_workspaces(const TileMemory& memory) {
  // One core does this alone, and most frames want what the one before them did.
  if (prepared == memory) return;
  while (workspaces.size() < static_cast<std::size_t>(parallel.threads())) workspaces.emplace_back();
  for (TileWorkspace& workspace : workspaces) {
    workspace.allocate_colors(memory.colors);
    if (memory.normals) workspace.allocate_normals();
    if (memory.stencil) workspace.allocate_stencil();
    if (memory.accumulation) workspace.allocate_accumulation();
    if (memory.samples) workspace.allocate_samples();
  }
  prepared = memory;
}

template <class Count>
void RendererState::cut_draws(const Count& count, std::size_t each) {
  ranges.cut(
      commands.geometry.size(), [&](std::size_t d) { return count(commands.geometry[d]); }, each);
}

void RendererState::look_through_tiles(const TileStage& stage, const TileRange& tiles,
                                       const FrameStats& stats, FrameWatch& watch) {
  const int first = tiles.first(stage.grid()), last = first + tiles.count();
  const auto tasks = static_cast<std::size_t>((tiles.count() + kTilesPerTask - 1) / kTilesPerTask);
  watch.begin_stage(FrameStage::binning, done_after(first, stats), tasks);
  parallel.for_each(tasks, [&](std::size_t task, int worker) {
    const int begin = first + static_cast<int>(task) * kTilesPerTask;
    watch.task(worker,
               [&] { bin_stage.batches().look_through(begin, std::min(kTilesPerTask, last - begin)); });
  });
}

void RendererState::render_tiles(const TileStage& stage, const TileRange& tiles, FrameStats& stats,
                                 FrameWatch& watch) {
  worker_counts.assign(static_cast<std::size_t>(parallel.threads()), {});
  look_through_tiles(stage, tiles, stats, watch);
  stage.cut_into_strips(tiles, parallel, strip_memory);
  const std::vector<TileStrip>& strips = strip_memory.strips;
  watch.begin_stage(FrameStage::tiles, done_after(tiles.first(stage.grid()) + tiles.count(), stats),
                    strips.size());
  parallel.for_each(strips.size(), [&](std::size_t i, int worker) {
    watch.task(worker, pixels_of(strips[i], stage.grid()), [&] {
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

void RendererState::render_parts(bool is_filled, const TileStage& stage, FrameStats& stats,
                                 FrameWatch& watch) {
  StopWatch clock;
  std::vector<TileRange>& left = parts_left;
  left.clear();
  const auto split = [&](const TileRange& tiles) {
    const auto [first, second] = halves(tiles);
    left.insert(left.end(), {second, first});
  };
  const TileRange whole{0, 0, stage.grid().columns(), stage.grid().rows()};
  is_filled ? left.push_back(whole) : split(whole);
  while (!left.empty()) {
    const TileRange tiles = left.back();
    left.pop_back();
    if (!is_filled) {
      watch.begin_stage(FrameStage::binning, done_after(tiles.first(stage.grid()), stats),
                        bin_stage.batch_count());
      is_filled = bin_stage.fill(tiles, watch);
      ++stats.bin_passes;
    }
    stats.binning_seconds += clock.lap();
    if (!is_filled) {
      split(tiles);
      continue;
    }
    render_tiles(stage, tiles, stats, watch);
    stats.tile_seconds += clock.lap();
    is_filled = false;
  }
}

FrameStats RendererState::run(FrameRecording& recording, const ImageTarget* image) {
  const FloatingPointMode mode;
  StopWatch clock;
  FrameStats stats;
  FrameTrace trace(options.trace ? parallel.threads() : 0);
  FrameWatch watch(options.progress, trace);
  FrameBufferState& target = *recording.target;
  plan_frame(commands, recording, image != nullptr, draw_buffers, parallel);

  // Memory for what will be stored is taken before anything changes.
  for (const Buffer which : kBuffers) prepare_planes(commands.traffic(which), target.parts(which));

  for (const GeometryDraw& draw : commands.geometry) stats.vertices += draw.mesh->vertices;
  const TileGrid grid{target.format.width, target.format.height, tile_size_for(target.format)};
  stats.tiles = static_cast<std::uint64_t>(grid.count());
  stats.tile_size = grid.tile_size;
  stats.plan_seconds = clock.lap();

  process_geometry(watch);
  stats.vertex_seconds = clock.lap();
  bin_stage.begin(commands, grid, target.format.samples);
  watch.begin_stage(FrameStage::binning, kBinsDone, bin_stage.batch_count());
  const bool is_filled = bin_stage.fill({0, 0, grid.columns(), grid.rows()}, watch);
  count_triangles(stats, bin_stage.counts());
  stats.bin_passes = 1;
  connect_draws(commands);
  stats.binning_seconds = clock.lap();

  TileFrame frame;
  frame.grid = grid;
  frame.layout = target.layout;
  for (const DrawPlan* plan : commands.plans)
    if (plan->looks_up_colors()) frame.palette_search = target.search();
  frame.depth_kind = target.depth_kind;
  frame.draws = commands.tile_draws.data();
  frame.draw_count = static_cast<std::uint32_t>(commands.tile_draws.size());
  frame.clears = commands.clears.data();
  frame.clear_count = static_cast<std::uint32_t>(commands.clears.size());
  frame.accumulations = commands.accumulations.data();
  frame.accumulation_count = static_cast<std::uint32_t>(commands.accumulations.size());
  frame.batches = &bin_stage.batches();
  frame.shade_at_once = !options.defer_shading;
  frame.samples = target.format.samples;
  frame.loads_color = commands.color.load;
  frame.loads_depth = commands.depth.load;
  frame.loads_stencil = commands.stencil.load;
  const CaptureStage capture(commands, frame, recording.capture, options.count_fragments, isa);
  if (commands.stores() || image || !commands.plans.empty() || capture.any()) {
    const TileStage stage(commands, frame, target, image, capture, show_memory, isa);
    prepare_workspaces({.colors = stage.kept_tiles(),
                        .normals = capture.needs_normals(),
                        .stencil = commands.stencil.used,
                        .accumulation = commands.accumulation.used,
                        .samples = frame.samples > 1});
    try {
      render_parts(is_filled, stage, stats, watch);
    } catch (...) {
      for (const Buffer which : kBuffers) settle_interrupted(commands.traffic(which), target.parts(which));
      throw;
    }
  }
  for (const Buffer which : kBuffers) settle(commands.traffic(which), target.parts(which));
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

}  // namespace tessera
