// A frame, stage by stage: plan, vertices, bins, tiles, store.
#include <algorithm>
#include <chrono>
#include <span>
#include <string>

#include "engine/capture_stage.h"
#include "engine/recording.h"
#include "engine/renderer_state.h"
#include "raster/polygon_offset.h"
#include "raster/sample_positions.h"

namespace tessera {
namespace {

constexpr std::size_t kVerticesPerTask = 512;
constexpr std::size_t kTrianglesPerBatch = 1024;
// What the stages are of a frame, for a progress bar.
constexpr double kVertexShare = 0.15, kFaceShare = 0.05, kBinningShare = 0.1, kTileShare = 0.7;

/// Ranges of elements of several draws, cut into tasks.
struct Range {
  std::size_t draw, first, last;
};
std::vector<Range> cut_into_tasks(const std::vector<GeometryDraw>& draws, bool triangles) {
  std::vector<Range> tasks;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    if (triangles && !draws[d].plan->colors_triangles()) continue;
    const std::size_t count = triangles ? draws[d].mesh->elements : draws[d].mesh->vertices;
    for (std::size_t first = 0; first < count; first += kVerticesPerTask) tasks.push_back({d, first, std::min(count, first + kVerticesPerTask)});
  }
  return tasks;
}

void bin_elements(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first, std::uint32_t last, Isa isa) {
  switch (draw.topology) {
    case Topology::points: return bin_points(bins, grid, draw, first, last);
    case Topology::lines: return bin_lines(bins, grid, draw, first, last);
    case Topology::triangles: break;
  }
  if (draw.modes != nullptr) return bin_polygons(bins, grid, draw, first, last, isa);
  bin_triangles(bins, grid, draw, first, last, isa);
}

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

/// What a buffer holds after all its tiles were rendered.
void settle(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    StoredBuffer& stored = parts[i];
    if (traffic.store)
      stored.content = StoredBuffer::Content::planes;
    else if (traffic.keep && traffic.ends_uniform)
      stored.become_uniform(traffic.uniform_words[i]);
    else if (!traffic.keep && traffic.touched)
      stored.content = StoredBuffer::Content::lost;
    stored.settle_lent_memory();
  }
}

/// And after some: those of the planes that were stored are new. What was lost stays lost.
void settle_interrupted(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  for (StoredBuffer& stored : parts)
    if (traffic.store && stored.content == StoredBuffer::Content::uniform) stored.content = StoredBuffer::Content::planes;
}

/// Takes the memory for what will be stored, with what tiles that are never rendered hold.
void prepare_planes(const BufferTraffic& traffic, std::span<StoredBuffer> parts) {
  if (!traffic.store) return;
  for (StoredBuffer& stored : parts) {
    if (!stored.planes.allocated())
      stored.planes.allocate(stored.word);
    else if (stored.content == StoredBuffer::Content::uniform)
      stored.planes.fill(stored.word);
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

void RendererState::process_geometry(FrameCommands& commands, FrameWatch& watch) {
  for (const GeometryDraw& draw : commands.geometry) prepare_geometry(draw);
  const std::vector<Range> vertices = cut_into_tasks(commands.geometry, false);
  watch.begin_stage(kVertexShare, vertices.size());
  parallel.for_each(vertices.size(), [&](std::size_t i, int) {
    process_vertices(commands.geometry[vertices[i].draw], vertices[i].first, vertices[i].last, isa);
    watch.task_done();
  });
  const std::vector<Range> triangles = cut_into_tasks(commands.geometry, true);
  watch.begin_stage(kFaceShare, triangles.size());
  parallel.for_each(triangles.size(), [&](std::size_t i, int) {
    process_triangles(commands.geometry[triangles[i].draw], triangles[i].first, triangles[i].last, isa);
    watch.task_done();
  });
}

std::vector<BinDraw> RendererState::prepare_bins(const FrameCommands& commands, int samples) {
  std::vector<BinDraw> draws;
  for (std::size_t d = 0; d < commands.geometry.size(); ++d) {
    const GeometryDraw& geometry = commands.geometry[d];
    const DrawPlan& plan = *geometry.plan;
    BinDraw draw;
    draw.draw = commands.first_tile_draw[d];
    draw.topology = plan.topology;
    draw.size = plan.topology == Topology::points ? plan.point_size : plan.line_width;
    draw.samples = samples;
    draw.vertices = geometry.buffers->vertices.data();
    draw.indices = geometry.indices();
    draw.codes = geometry.buffers->codes.data();
    draw.any_code = geometry.buffers->any_code;
    draw.keep_front = plan.keep_front;
    draw.keep_back = plan.keep_back;
    draw.front_is_clockwise = plan.front_is_clockwise;
    draw.facing = geometry.facing();
    draw.rect = plan.rect;
    draw.sample_reach = sample_reach(samples);
    draw.transform = &plan.transform;
    draw.positions = geometry.mesh->positions;
    draw.components = geometry.mesh->components;
    draw.attributes = geometry.buffers->attributes.data();
    draw.attribute_count = draw.attribute_stride = plan.attribute_count;
    if (plan.outlines) {
      PolygonModes& modes = geometry.buffers->modes;
      modes = {.style = {plan.style[0], plan.style[1]}, .line_width = plan.line_width, .point_size = plan.point_size, .triangles = geometry.mesh->polygon_triangles(),
               .boundary = geometry.buffers->boundary.data()};
      std::uint32_t number = draw.draw;
      for (const PolygonStyle style : styles_of(plan)) modes.draw[static_cast<int>(style)] = number++;
      draw.modes = &modes;
    }
    draws.push_back(draw);
  }
  std::vector<Range> polygons;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const std::size_t count = draws[d].facing != nullptr ? commands.geometry[d].mesh->elements : 0;
    for (std::size_t first = 0; first < count; first += kTrianglesPerBatch) polygons.push_back({d, first, std::min(count, first + kTrianglesPerBatch)});
  }
  parallel.for_each(polygons.size(), [&](std::size_t i, int) {
    const Range& range = polygons[i];
    const GeometryDraw& geometry = commands.geometry[range.draw];
    const std::size_t each = geometry.mesh->polygon_triangles();
    face_polygons(draws[range.draw], each, range.first, range.last, geometry.buffers->facing.data());
    const DrawPlan& plan = *geometry.plan;
    if (plan.has_offset()) offset_polygons(draws[range.draw], each, plan.offset_factor, plan.offset_units, range.first, range.last, geometry.buffers->depth_offsets.data());
  });
  return draws;
}

std::size_t RendererState::fill_bins(const FrameCommands& commands, const TileGrid& grid, int samples, FrameWatch& watch) {
  std::vector<std::size_t> first_element{0};  // of each draw, counted through the frame; a bitmap or an image counts as one
  for (const GeometryDraw& draw : commands.geometry) first_element.push_back(first_element.back() + (draw.plan->texels ? 1 : draw.mesh->elements));
  const std::size_t total = first_element.back();
  const std::size_t batches = std::clamp<std::size_t>(total / kTrianglesPerBatch, 1, 4 * static_cast<std::size_t>(parallel.threads()));
  if (bins.size() < batches) bins.resize(batches);
  const std::vector<BinDraw> draws = prepare_bins(commands, samples);
  watch.begin_stage(kBinningShare, batches);
  parallel.for_each(batches, [&](std::size_t b, int) {
    bins[b].reset(grid.count());
    const std::size_t begin = total * b / batches, end = total * (b + 1) / batches;
    for (std::size_t d = 0; d < draws.size(); ++d) {
      const std::size_t low = std::max(begin, first_element[d]), high = std::min(end, first_element[d + 1]);
      if (low >= high) continue;
      if (commands.plans[d].texels)
        bin_pixels(bins[b], grid, draws[d].draw, draws[d].rect);
      else
        bin_elements(bins[b], grid, draws[d], static_cast<std::uint32_t>(low - first_element[d]), static_cast<std::uint32_t>(high - first_element[d]), isa);
    }
    watch.task_done();
  });
  return batches;
}

void RendererState::render_tiles(const TileStage& stage, const TileMemory& memory, FrameStats& stats, FrameWatch& watch) {
  struct alignas(64) WorkerCounts : StripCounts {};
  std::vector<WorkerCounts> counts(static_cast<std::size_t>(parallel.threads()));
  while (workspaces.size() < counts.size()) workspaces.emplace_back();
  for (TileWorkspace& workspace : workspaces) {
    if (memory.normals) workspace.allocate_normals();
    if (memory.stencil) workspace.allocate_stencil();
    if (memory.accumulation) workspace.allocate_accumulation();
    if (memory.samples) workspace.allocate_samples();
  }
  const std::vector<TileStrip> strips = stage.strips();
  watch.begin_stage(kTileShare, strips.size());
  parallel.for_each(strips.size(), [&](std::size_t i, int worker) {
    stage.render(strips[i], workspaces[static_cast<std::size_t>(worker)], counts[static_cast<std::size_t>(worker)]);
    watch.task_done();
  });
  for (const WorkerCounts& c : counts) {
    stats.shaded_pixels += c.shaded_pixels;
    stats.tiles_touched += c.touched;
    stats.fragments += c.fragments;
  }
}

FrameStats RendererState::run(FrameRecording& recording, const ImageTarget* image) {
  const FloatingPointMode mode;
  StopWatch clock;
  FrameStats stats;
  FrameWatch watch(options.progress);
  FrameBufferState& target = *recording.target;
  FrameCommands commands = plan_frame(recording, image != nullptr, draw_buffers);

  // Memory for what will be stored is taken before anything changes.
  for (const Buffer which : kBuffers) prepare_planes(commands.traffic(which), target.parts(which));

  for (const GeometryDraw& draw : commands.geometry) stats.vertices += draw.mesh->vertices;
  const TileGrid grid{target.format.width, target.format.height, tile_size_for(target.format)};
  stats.tiles = static_cast<std::uint64_t>(grid.count());
  stats.tile_size = grid.tile_size;
  stats.plan_seconds = clock.lap();

  process_geometry(commands, watch);
  stats.vertex_seconds = clock.lap();
  const std::size_t batches = fill_bins(commands, grid, target.format.samples, watch);
  connect_draws(commands);
  stats.binning_seconds = clock.lap();

  TileFrame frame;
  frame.grid = grid;
  frame.layout = target.layout;
  for (const DrawPlan& plan : commands.plans)
    if (plan.looks_up_colors()) frame.palette_search = target.search();
  frame.depth_kind = target.depth_kind;
  frame.draws = commands.tile_draws.data();
  frame.draw_count = static_cast<std::uint32_t>(commands.tile_draws.size());
  frame.clears = commands.clears.data();
  frame.clear_count = static_cast<std::uint32_t>(commands.clears.size());
  frame.accumulations = commands.accumulations.data();
  frame.accumulation_count = static_cast<std::uint32_t>(commands.accumulations.size());
  frame.bins = bins.data();
  frame.bin_count = static_cast<std::uint32_t>(batches);
  frame.shade_at_once = !options.defer_shading;
  frame.samples = target.format.samples;
  frame.loads_color = commands.color.load;
  frame.loads_depth = commands.depth.load;
  frame.loads_stencil = commands.stencil.load;
  const CaptureStage capture(commands, frame, recording.capture, options.count_fragments, isa);
  if (commands.stores() || image || !commands.plans.empty() || capture.any()) {
    try {
      render_tiles(TileStage(commands, frame, target, image, capture, isa), {capture.needs_normals(), commands.stencil.used, commands.accumulation.used, frame.samples > 1}, stats, watch);
    } catch (...) {
      for (const Buffer which : kBuffers) settle_interrupted(commands.traffic(which), target.parts(which));
      throw;
    }
  }
  for (const Buffer which : kBuffers) settle(commands.traffic(which), target.parts(which));
  stats.tile_seconds = clock.lap();

  for (std::size_t b = 0; b < batches; ++b) {
    const BinCounts& c = bins[b].counts;
    stats.triangles_in += c.triangles_in;
    stats.dropped_non_finite += c.non_finite;
    stats.outside += c.outside;
    stats.culled += c.culled;
    stats.zero_area += c.zero_area;
    stats.clipped += c.clipped;
    stats.binned += c.binned;
    stats.bin_entries += c.entries;
  }
  return stats;
}

void RendererState::report(const FrameStats& stats) const {
  if (stats.dropped_non_finite > 0)
    log(LogLevel::warning, [&] { return std::to_string(stats.dropped_non_finite) + " triangles, lines or points with a NaN or infinite vertex were dropped"; });
  log(LogLevel::debug, [&] {
    return "frame: " + std::to_string(stats.triangles_in) + " triangles, lines and points, " + std::to_string(stats.tiles_touched) + " of " + std::to_string(stats.tiles) + " tiles of " +
           std::to_string(stats.tile_size) + " pixels, " + std::to_string(stats.shaded_pixels) + " shaded pixels";
  });
}

}  // namespace tessera
