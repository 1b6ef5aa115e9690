// The tile stage: tiles are loaded, rendered, scanned out and stored.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/plan/frame_commands.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/bin_stage.h"
#include "engine/stages/capture_stage.h"
#include "framebuffer/bit_transpose.h"
#include "framebuffer/scan_out.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

/// Neighbouring tiles of a row, rendered by one worker. Compact, because strips are sorted serially.
struct TileStrip {
  std::int16_t row = 0;
  std::int16_t first_column = 0;
  std::int16_t last_column = 0;
  bool cleared = false;         ///< no triangle touches the tiles: they show the last clear
  std::uint8_t load_class = 0;  ///< class of the number of triangles; monotonic
};
static_assert(kMaxFrameBufferSize / kMinTileSize <= std::numeric_limits<std::int16_t>::max());

/// The strips of a frame, and working memory. Kept from frame to frame.
struct StripScratch {
  std::vector<TileStrip> sorted;  ///< by decreasing load
  std::vector<TileStrip> strips;  ///< result of build_strips()
};

struct StripCounts {
  std::uint64_t rendered = 0;          ///< tiles in tile memory
  std::uint64_t touched = 0;           ///< tiles
  std::uint64_t shaded_pixels = 0;     ///< colour evaluations
  std::uint64_t hidden_triangles = 0;  ///< sum over tiles of triangles that were left out as hidden
  std::uint64_t fragments = 0;         ///< pixels
  std::uint64_t non_finite_fragments = 0;
};

/// Scan-out tables, kept from frame to frame.
struct ScanOutCache {
  std::optional<ScanOut> scan_out;
  /// Sets `scan_out` for the stored colours of a buffer. Throws std::bad_alloc only.
  void prepare(const FrameBufferState& target, PixelOrder order, InstructionSet isa);

  std::vector<std::uint8_t> cleared_row;  ///< a row of the picture after the last clear
};

class TileStage {
 public:
  /// Tiles write the pixels of `image`, which may be null, and the planes of `target`. All arguments must
  /// outlive the stage.
  TileStage(const FrameCommands& commands, const TileFrame& frame, FrameBufferState& target,
            const ImageTarget* image, const CaptureStage& capture, ScanOutCache& scan_out_cache,
            InstructionSet isa);

  const TileGrid& grid() const { return frame_.grid; }
  /// Number of tiles whose colours a workspace collects before storing them together. Depth, stencil and
  /// accumulation are rarely stored: tile by tile.
  int buffered_tiles() const { return buffered_tiles_; }
  /// Orders strips for WorkerPool::for_each().
  /// - Within a worker's share, the number of triangles decreases (to within 25 %): long strips start first.
  /// - Shares have equal numbers of strips of every load class, up to one.
  /// - Strips of a class within a share are neighbours, and mostly the same from frame to frame.
  /// - The order changes no bit.
  /// @param memory  receives `strips`; `sorted` is overwritten
  void build_strips(const TileRange& tiles, const WorkerPool& workers, StripScratch& memory) const;
  /// Renders a strip and adds to `counts`. Distinct strips may run concurrently, each in its own workspace.
  void render(const TileStrip& strip, TileWorkspace& workspace, StripCounts& counts) const;

 private:
  void render_tile_at(int row, int column, TileWorkspace& workspace, StripCounts& counts) const;
  void load_accumulation(const TilePlace& place, const AccumulatedPixels& levels) const;
  void scan_out(int x0, int y0, TileWorkspace& workspace) const;
  void load(const AttachmentOps& ops, const Attachment& stored, std::uint32_t* words,
            const TilePlace& place) const;
  void store(const AttachmentOps& ops, Attachment& stored, const std::uint32_t* words,
             const TilePlace& place) const;
  void fill_cleared(const TileStrip& strip) const;
  std::uint8_t* target_pixel(int x, int y) const;

  const FrameCommands& commands_;
  const TileFrame& frame_;
  FrameBufferState& target_;
  const ImageTarget* image_;
  const CaptureStage& capture_;
  PixelRect target_region_;  ///< pixels of the image that are written
  ScanOutCache& scan_out_cache_;
  RenderTile* render_;
  StorePlanesFn* store_planes_;
  LoadPlanesFn* load_planes_;
  int buffered_tiles_;
  bool copies_cleared_row_ = false;  ///< tiles without triangles are copied from scan_out_cache_.cleared_row
};

}  // namespace tessera::detail
