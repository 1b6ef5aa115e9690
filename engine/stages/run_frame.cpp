// A frame from its recorded commands to the stored planes.
#include <algorithm>
#include <span>
#include <string>

#include "engine/buffers/diffuse_colors.h"
#include "engine/plan/tile_draws.h"
#include "engine/plan/work_counts.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/renderer_state.h"
#include "engine/stages/frame_context.h"

namespace tessera::detail {
namespace {

/// Allocates the planes that will be stored, and fills them with the contents of tiles that are never
/// rendered.
void reserve_attachments(const AttachmentOps& ops, std::span<Attachment> attachments) {
  if (!ops.stores()) return;
  for (Attachment& stored : attachments) {
    if (!stored.planes.allocated()) stored.planes.allocate(stored.clear_value);
    else if (stored.content == Attachment::Content::fast_cleared) stored.planes.fill(stored.clear_value);
  }
}

/// State after all tiles were rendered.
void commit_attachments(const AttachmentOps& ops, std::span<Attachment> attachments) {
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    Attachment& stored = attachments[i];
    switch (ops.store) {
      case StoreOp::none: break;
      case StoreOp::store: stored.content = Attachment::Content::planes; break;
      case StoreOp::fast_clear: stored.fast_clear(ops.clear_values[i]); break;
      case StoreOp::discard: stored.content = Attachment::Content::undefined; break;
    }
    stored.materialize_external_memory();
  }
}

/// Whether the frame leaves other contents than it found.
bool changes(const AttachmentOps& ops) { return ops.stores() || ops.store == StoreOp::fast_clear; }

/// State after a frame that was cancelled or threw: tiles that were stored are kept, so a fast-cleared
/// attachment becomes `planes`; an undefined one stays undefined.
void commit_interrupted(const AttachmentOps& ops, std::span<Attachment> attachments) {
  for (Attachment& stored : attachments)
    if (ops.stores() && stored.content == Attachment::Content::fast_cleared)
      stored.content = Attachment::Content::planes;
}

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

}  // namespace

FrameStats RendererState::run(FrameRecording& recording, const ImageTarget* image) {
  const FloatingPointMode mode;
  const FrameBufferFormat& format = recording.target->format;
  FrameContext frame(recording, image, {format.width, format.height, tile_size_for(format)}, options,
                     worker_pool.threads());
  draw_measurer.begin_frame(recording.draws.size(), measured_workers());
  work_counts = {};
  plan(frame);            // draws -> effects and tile draws; buffers -> load and store operations
  reserve_planes(frame);  // the planes that will be stored, before anything changes
  run_geometry(frame);    // vertices -> window positions and varyings
  run_binning(frame);     // triangles -> bins of tiles
  run_tiles(frame);       // bins -> pixels; in several parts if the bins exceed their memory
  commit_buffers(frame);
  return finish(frame);
}

std::size_t RendererState::measured_workers() const {
  return options.debug.measure_draws ? static_cast<std::size_t>(worker_pool.threads()) : 0;
}

int RendererState::tile_size_for(const FrameBufferFormat& format) const {
  if (options.tile_size != 0) return options.tile_size;
  if (format.samples > 1) return 64;  // the samples of a larger tile exceed the cache
  // Large tiles repeat less setup; small tiles keep more threads busy.
  constexpr int kMinLargeTilesPerThread = 16;
  const double pixels = static_cast<double>(format.width) * format.height;
  return pixels / worker_pool.threads() >= kMinLargeTilesPerThread * 128 * 128 ? 128 : 64;
}

void RendererState::plan(FrameContext& frame) {
  plan_frame(commands, frame.recording, frame.image != nullptr, {.elide = options.elide, .isa = isa},
             draw_buffers, &worker_pool);
  for (const GeometryDraw& draw : commands.geometry) frame.stats.vertices += draw.mesh->vertices;
  frame.stats.tiles = static_cast<std::uint64_t>(frame.grid.count());
  frame.stats.tile_size = frame.grid.tile_size;
}

void RendererState::reserve_planes(FrameContext& frame) {
  for (const Buffer which : kBuffers)
    reserve_attachments(commands.attachments[which], frame.target.attachments(which));
  if (frame.target.diffusion && (changes(commands.attachments.color) || frame.image != nullptr)) {
    reserve_diffused_colors(frame.target);
    if (frame.image != nullptr) scan_out_cache.prepare(frame.target, frame.image->order, isa);
  }
  frame.stats.plan_seconds = frame.clock.lap();
}

void RendererState::run_binning(FrameContext& frame) {
  bin_stage.begin(commands, frame.grid, frame.target.format.samples);
  frame.progress.begin_stage(FrameStage::binning, kBinsDone, bin_stage.batch_count());
  frame.bins_filled = bin_stage.fill({0, 0, frame.grid.columns(), frame.grid.rows()}, frame.progress);
  count_triangles(frame.stats, bin_stage.counts());
  frame.stats.bin_passes = 1;
  build_tile_draws(commands, {.layout = frame.target.layout,
                              .depth_format = frame.target.depth_format,
                              .samples = frame.target.format.samples,
                              .shade_immediately = !options.debug.defer_shading,
                              .isa = isa});
  frame.stats.binning_seconds = frame.clock.lap();
}

void RendererState::commit_buffers(FrameContext& frame) {
  for (const Buffer which : kBuffers)
    commit_attachments(commands.attachments[which], frame.target.attachments(which));
  if (frame.target.diffusion) finish_diffusion(frame);
}

void RendererState::finish_diffusion(FrameContext& frame) {
  FrameBufferState& target = frame.target;
  if (changes(commands.attachments.color) || frame.image != nullptr)
    diffuse_colors(target, frame.image, scan_out_cache.scan_out ? &*scan_out_cache.scan_out : nullptr);
  else if (commands.attachments.color.store == StoreOp::discard)
    target.diffused.content = Attachment::Content::undefined;
  frame.stats.tile_seconds += frame.clock.lap();
}

void RendererState::commit_interrupted_buffers(FrameContext& frame) {
  for (const Buffer which : kBuffers)
    commit_interrupted(commands.attachments[which], frame.target.attachments(which));
  if (frame.target.diffusion && commands.attachments.color.stores() &&
      frame.target.color.content == Attachment::Content::planes)
    diffuse_colors(frame.target, nullptr, nullptr);
}

FrameStats RendererState::finish(FrameContext& frame) {
  draw_measurer.finish();
  if (options.debug.measure_draws && options.debug.count_fragments)
    work_counts = count_work({.commands = commands,
                              .recording = frame.recording,
                              .target = frame.target,
                              .draws = draw_measurer.results(),
                              .stats = frame.stats,
                              .presented = frame.image != nullptr});
  if (options.trace) options.trace(frame.trace.tasks());
  return frame.stats;
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
