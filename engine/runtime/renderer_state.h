// State of a Renderer: working memory that is kept from frame to frame, and the steps of a frame.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/runtime/draw_measurer.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/bin_stage.h"
#include "engine/stages/draw_range.h"
#include "engine/stages/normal_stage.h"
#include "engine/stages/tile_stage.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

struct FrameContext;

// Share of the frame that is done after each step, for progress callbacks. Tiles are the rest.
inline constexpr double kElementsDone = 0.03;
inline constexpr double kNormalsDone = 0.08;
inline constexpr double kVerticesDone = 0.15;
inline constexpr double kFlatColorsDone = 0.2;
inline constexpr double kBinsDone = 0.3;

/// Memory that a tile workspace needs in addition to depth.
struct WorkspaceRequirements {
  int colors = 1;  ///< number of tiles whose colours are collected before they are stored
  bool normals = false;
  bool stencil = false;
  bool accumulation = false;
  bool samples = false;
  bool stage_depth = false;
  bool operator==(const WorkspaceRequirements&) const = default;
};

/// Counts of one worker, in a separate cache line.
struct alignas(64) WorkerCounts : StripCounts {};

struct RendererState {
  RendererOptions options;
  InstructionSet isa = InstructionSet::scalar;
  WorkerPool worker_pool;
  FrameCommands commands;
  std::deque<DrawBuffers> draw_buffers;
  DrawRanges ranges;  ///< tasks of the current geometry pass
  DrawMeasurer draw_measurer;
  WorkCounts work_counts;  ///< work of the last frame
  NormalStage normal_stage;
  BinStage bin_stage;
  std::vector<TileRange> pending_ranges;  ///< parts of the frame still to be rendered; the last one is next
  StripScratch strip_scratch;
  ScanOutCache scan_out_cache;
  std::vector<TileWorkspace> workspaces;                       ///< per worker
  std::optional<WorkspaceRequirements> prepared_requirements;  ///< met by all workspaces
  std::vector<WorkerCounts> worker_counts;                     ///< per worker

  RendererState(RendererOptions renderer_options, InstructionSet instruction_set)
      : options(std::move(renderer_options)),
        isa(instruction_set),
        worker_pool(options.threads, options.executor, options.debug.task_order),
        bin_stage(options.bin_memory, worker_pool, draw_measurer, isa) {}

  /// Renders a frame. The recording keeps its commands.
  /// @param image  may be null
  FrameStats run(FrameRecording& recording, const ImageTarget* image);

  /// Logs the counts of a frame.
  void report(const FrameStats& stats) const;

  /// Calls `message()` only if there is a log.
  template <class Message>
  void log(LogLevel level, const Message& message) const {
    if (options.log) options.log(level, message());
  }

 private:
  struct GeometryPass {
    FrameStage stage;
    double done;             ///< share of the frame that is done at the end of the pass
    std::size_t range_size;  ///< vertices or elements per task
    bool is_of_vertices = false;
  };

  // The steps of run(), in order.
  void plan(FrameContext& frame);
  void reserve_planes(FrameContext& frame);
  void run_geometry(FrameContext& frame);
  void run_binning(FrameContext& frame);
  void run_tiles(FrameContext& frame);
  void commit_buffers(FrameContext& frame);
  /// Reduces the finished colours of a buffer with error diffusion, and shows them.
  void finish_diffusion(FrameContext& frame);
  FrameStats finish(FrameContext& frame);

  // Parts of the steps.
  int tile_size_for(const FrameBufferFormat& format) const;
  /// Number of workers that measure draws; 0: draws are not measured.
  std::size_t measured_workers() const;
  /// Calls work(draw, first, last) for ranges of count(draw) items of each draw, in parallel.
  template <class Count, class Work>
  void run_ranges(FrameContext& frame, const GeometryPass& pass, const Count& count, const Work& work);
  TileFrame tile_frame(FrameContext& frame);
  void prepare_workspaces(const WorkspaceRequirements& memory);
  void render_parts(FrameContext& frame, const TileStage& stage);
  void index_bin_batches(FrameContext& frame, const TileRange& tiles);
  void render_tiles(FrameContext& frame, const TileStage& stage, const TileRange& tiles);
  void commit_interrupted_buffers(FrameContext& frame);
};

}  // namespace tessera::detail
