// The second stage of a frame: its elements are sorted into the tiles that they may touch. Where the bins of
// all tiles would take more memory than is allowed, they are made for one part of the frame after the other,
// and those parts rendered in between: a tile needs no bins but its own, so its pixels are the same.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/runtime/frame_progress.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/draw_range.h"
#include "raster/binning.h"

namespace tessera::detail {

/// Some rows of tiles, or some tiles of one row: their numbers follow each other. Columns [x0, x1), rows [y0,
/// y1).
struct TileRange {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int count() const { return (x1 - x0) * (y1 - y0); }
  int first(const TileGrid& grid) const { return y0 * grid.columns() + x0; }
};

class BinStage {
 public:
  /// For one frame after the other, in the same memory.
  ///
  /// @param limit  bytes that the bins may take together; beside them 8 bytes a tile and 8 for every 64
  /// batches begun say what they hold
  BinStage(std::size_t limit, WorkerPool& worker_pool, InstructionSet isa)
      : limit_bytes_(limit), worker_pool_(worker_pool), isa_(isa) {}
  BinStage(const BinStage&) = delete;
  BinStage& operator=(const BinStage&) = delete;

  /// `commands` are used until the next frame begins. Throws std::bad_alloc.
  void begin(const FrameCommands& commands, const TileGrid& grid, int samples);

  std::size_t batch_count() const { return batch_count_; }
  /// Fills the bins of some tiles. False if there are several and their bins would pass the limit. A single
  /// tile is always filled: if its bins would pass the limit they will be made while it is rendered, a batch
  /// at a time.
  bool fill(const TileRange& tiles, FrameProgress& progress);
  /// What was filled last, if that fitted. It stays in one place. Tiles are looked through before they are
  /// rendered.
  BinBatches& batches() { return batches_; }
  /// What was filled last, all batches together; complete if it did not fit, too.
  const BinCounts& counts() const { return counts_; }

 private:
  struct alignas(64) WorkerCounts {
    BinCounts counts;
  };

  void prepare_draws(int samples);
  void start_budget();
  void bin(Bins& bins, std::size_t begin, std::size_t end) const;
  void fill_one_by_one(const TileRange& tile);

  std::size_t limit_bytes_;
  WorkerPool& worker_pool_;
  InstructionSet isa_;
  std::vector<Bins> bins_;
  BinBudget budget_;              ///< of bins_
  bool budget_is_exact_ = false;  ///< the budget tells, to the byte, what they take
  const FrameCommands* commands_ = nullptr;
  TileGrid grid_{};
  std::vector<BinDraw> draws_;
  std::vector<PixelRect> draw_rects_;  ///< of the draws, in the whole frame
  std::vector<std::size_t>
      first_element_;  ///< of each draw, counted through the frame; a bitmap or an image counts as one
  DrawRanges polygon_ranges_;  ///< triangles whose polygons are faced together, or moved
  std::size_t batch_count_ = 1;
  BinBatches batches_;
  std::vector<WorkerCounts> worker_counts_;
  BinCounts counts_;
};

}  // namespace tessera::detail
