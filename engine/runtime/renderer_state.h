// What stands behind a Renderer: the working memory of frames, and the stages that a frame runs through.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/runtime/frame_progress.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/bin_stage.h"
#include "engine/stages/draw_range.h"
#include "engine/stages/normal_stage.h"
#include "engine/stages/tile_stage.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

/// What the workers' tiles need besides depth.
struct WorkspaceRequirements {
  int colors = 1;  ///< tiles
  bool normals = false, stencil = false, accumulation = false, samples = false;
  bool operator==(const WorkspaceRequirements&) const = default;
};

struct alignas(64) WorkerCounts : StripCounts {};

struct RendererState {
  RendererOptions options;
  InstructionSet isa = InstructionSet::scalar;
  WorkerPool worker_pool;
  FrameCommands commands;
  std::deque<DrawBuffers> draw_buffers;
  DrawRanges ranges;  // of the tasks that run
  NormalStage normal_stage;
  BinStage bin_stage;
  std::vector<TileRange> pending_ranges;  // to be rendered, from the last one to the next
  StripScratch strip_scratch;
  ScanOutCache scan_out_cache;
  std::vector<TileWorkspace> workspaces;                       // one for each worker
  std::optional<WorkspaceRequirements> prepared_requirements;  // what all of them have, and maybe more
  std::vector<WorkerCounts> worker_counts;

  RendererState(RendererOptions o, InstructionSet i)
      : options(std::move(o)),
        isa(i),
        worker_pool(options.threads, options.executor, options.debug.task_order),
        bin_stage(options.bin_memory, worker_pool, isa) {}

  FrameStats run(FrameRecording& recording, const ImageTarget* image);

  /// Logs what is worth saying of a frame.
  void report(const FrameStats& stats) const;

  /// `message()` is only made where somebody listens.
  template <class Message>
  void log(LogLevel level, const Message& message) const {
    if (options.log) options.log(level, message());
  }

 private:
  /// Makes `ranges` of as many as `count(draw)` of each draw.
  template <class Count>
  void split_draws(const Count& count, std::size_t each);
  void process_geometry(FrameProgress& progress);
  void prepare_workspaces(const WorkspaceRequirements& memory);
  /// All tiles at once if their bins are filled, else part by part, as many at a time as fit.
  void render_ranges(bool is_filled, const TileStage& stage, FrameStats& stats, FrameProgress& progress);
  void index_bin_batches(const TileStage& stage, const TileRange& tiles, const FrameStats& stats,
                         FrameProgress& progress);
  void render_tiles(const TileStage& stage, const TileRange& tiles, FrameStats& stats,
                    FrameProgress& progress);
  int tile_size_for(const FrameBufferFormat& format) const;
};

}  // namespace tessera::detail
