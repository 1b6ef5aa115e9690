// What stands behind a Renderer: the working memory of frames, and the stages that a frame runs through.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "engine/bin_stage.h"
#include "engine/draw_range.h"
#include "engine/frame_commands.h"
#include "engine/frame_watch.h"
#include "engine/normal_stage.h"
#include "engine/parallel.h"
#include "engine/tile_stage.h"
#include "shading/tile_renderer.h"

namespace tessera {

/// What the workers' tiles need besides depth.
struct TileMemory {
  int colors = 1;  ///< tiles
  bool normals = false, stencil = false, accumulation = false, samples = false;
  bool operator==(const TileMemory&) const = default;
};

struct alignas(64) WorkerCounts : StripCounts {};

struct RendererState {
  RendererOptions options;
  Isa isa = Isa::scalar;
  Parallel parallel;
  FrameCommands commands;
  std::deque<DrawBuffers> draw_buffers;
  DrawRanges ranges;  // of the tasks that run
  NormalStage normal_stage;
  BinStage bin_stage;
  std::vector<TileRange> parts_left;  // to be rendered, from the last one to the next
  StripMemory strip_memory;
  ShowMemory show_memory;
  std::vector<TileWorkspace> workspaces;  // one for each worker
  std::optional<TileMemory> prepared;     // what all of them have, and maybe more
  std::vector<WorkerCounts> worker_counts;

  RendererState(RendererOptions o, Isa i)
      : options(std::move(o)),
        isa(i),
        parallel(options.threads, options.executor, options.task_order),
        bin_stage(options.bin_memory, parallel, isa) {}

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
  void cut_draws(const Count& count, std::size_t each);
  void process_geometry(FrameWatch& watch);
  void prepare_workspaces(const TileMemory& memory);
  /// All tiles at once if their bins are filled, else part by part, as many at a time as fit.
  void render_parts(bool is_filled, const TileStage& stage, FrameStats& stats, FrameWatch& watch);
  void look_through_tiles(const TileStage& stage, const TileRange& tiles, const FrameStats& stats,
                          FrameWatch& watch);
  void render_tiles(const TileStage& stage, const TileRange& tiles, FrameStats& stats, FrameWatch& watch);
  int tile_size_for(const FrameBufferFormat& format) const;
};

}  // namespace tessera
