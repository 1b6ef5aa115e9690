// What stands behind a Renderer: the working memory of frames, and the stages that a frame runs through.
#pragma once

#include <deque>
#include <vector>

#include "engine/bin_stage.h"
#include "engine/frame_commands.h"
#include "engine/frame_watch.h"
#include "engine/parallel.h"
#include "engine/tile_stage.h"
#include "shading/tile_renderer.h"

namespace tessera {

/// What the workers' tiles need besides colour and depth.
struct TileMemory {
  bool normals = false, stencil = false, accumulation = false, samples = false;
};

struct RendererState {
  RendererOptions options;
  Isa isa = Isa::scalar;
  Parallel parallel;
  std::deque<DrawBuffers> draw_buffers;
  std::vector<Bins> bins;
  std::vector<TileWorkspace> workspaces;  // one for each worker

  explicit RendererState(RendererOptions o) : options(std::move(o)), parallel(options.threads, options.executor, options.task_order) {}

  FrameStats run(FrameRecording& recording, const ImageTarget* image);

  /// Logs what is worth saying of a frame.
  void report(const FrameStats& stats) const;

  /// `message()` is only made where somebody listens.
  template <class Message>
  void log(LogLevel level, const Message& message) const {
    if (options.log) options.log(level, message());
  }

 private:
  void check_indices(const FrameCommands& commands, FrameWatch& watch);
  void process_geometry(FrameCommands& commands, FrameWatch& watch);
  void prepare_workspaces(const TileMemory& memory);
  /// All tiles at once if their bins are filled, else part by part, as many at a time as fit.
  void render_parts(BinStage& bin_stage, bool is_filled, const TileStage& stage, FrameStats& stats, FrameWatch& watch);
  /// What the bins of tiles hold, row by row.
  std::vector<TileLoad> tile_loads(const TileStage& stage, const TileRange& tiles);
  void render_tiles(const TileStage& stage, const TileRange& tiles, FrameStats& stats, FrameWatch& watch);
  int tile_size_for(const FrameBufferFormat& format) const;
};

}  // namespace tessera
