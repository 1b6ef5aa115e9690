// The last stage of a frame: tiles are loaded, rendered, and stored where somebody will read them.
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

/// Neighbouring tiles of a row that one worker takes.
struct TileStrip {
  std::int16_t row = 0, first_column = 0,
               last_column = 0;  // few bytes: one core sorts them while the others wait
  bool cleared = false;          ///< no triangle touches them: they show the last clear
  std::uint8_t load_class = 0;   ///< class of how many triangles do; more of them are never of a lower class
};
static_assert(kMaxFrameBufferSize / kMinTileSize <= std::numeric_limits<std::int16_t>::max());

/// The strips of a frame, and what is needed on the way to them. Kept from frame to frame.
struct StripScratch {
  std::vector<TileStrip> sorted;  ///< from the heaviest to the lightest
  std::vector<TileStrip> strips;  ///< row by row, and then as build_strips() leaves them
};

struct StripCounts {
  std::uint64_t touched = 0, shaded_pixels = 0, fragments = 0;  ///< tiles, pixels, pixels
};

/// What one frame after the other is shown by.
struct ScanOutCache {
  std::optional<ScanOut> scan_out;
  std::vector<std::uint8_t> cleared_row;  ///< a row of the picture after the last clear
};

class TileStage {
 public:
  /// All but the image's pixels and the target's planes is only read. `image` may be null.
  ///
  /// @param scan_out_cache  used as long as this lives
  TileStage(const FrameCommands& commands, const TileFrame& frame, FrameBufferState& target,
            const ImageTarget* image, const CaptureStage& capture, ScanOutCache& scan_out_cache,
            InstructionSet isa);

  const TileGrid& grid() const { return frame_.grid; }
  /// Tiles whose colours a workspace keeps until they are stored together. Depth, stencil and accumulation
  /// are seldom stored: tile by tile.
  int buffered_tiles() const { return buffered_tiles_; }
  /// For workers.for_each(): in each share strips with most triangles come first, give or take a quarter, so
  /// that nobody waits for one that began last; and each share has as many of every load_class, or one more.
  /// Where there are many more of a load_class than workers, those of a share are neighbours, much the same
  /// ones as in a like frame before. Their order changes no bit.
  ///
  /// @param memory  whose `strips` they become; its `sorted` is used
  void build_strips(const TileRange& tiles, const WorkerPool& workers, StripScratch& memory) const;
  /// Distinct strips may be rendered at the same time, each in a workspace of its own; adds to `counts`.
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
  PixelRect target_region_;  ///< of the image
  ScanOutCache& scan_out_cache_;
  RenderTile* render_;
  StorePlanesFn* store_planes_;
  LoadPlanesFn* load_planes_;
  int buffered_tiles_;
  bool copies_cleared_row_ = false;  ///< a tile without triangles is part of scan_out_cache_.cleared_row
};

}  // namespace tessera::detail
