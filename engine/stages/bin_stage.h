// The binning stage: elements are sorted into the tiles that they may touch. If the bins of all tiles would
// exceed their memory, the frame is binned and rendered in parts. A tile needs no bins but its own, so its
// pixels are the same.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/runtime/draw_measurer.h"
#include "engine/runtime/frame_progress.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/draw_range.h"
#include "raster/binning.h"

namespace tessera::detail {

/// Whole rows of tiles, or tiles of one row, so that their numbers are consecutive. Columns [x0, x1), rows
/// [y0, y1).
struct TileRange {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int count() const { return (x1 - x0) * (y1 - y0); }
  int first(const TileGrid& grid) const { return y0 * grid.columns() + x0; }
};

class BinStage {
 public:
  /// @param limit  bytes of all bins together. Their index takes more: per tile, 8 bytes, and 8 bytes for
  ///               every 64 batches
  BinStage(std::size_t limit, WorkerPool& worker_pool, DrawMeasurer& draw_measurer, InstructionSet isa)
      : limit_bytes_(limit), worker_pool_(worker_pool), draw_measurer_(draw_measurer), isa_(isa) {}
  BinStage(const BinStage&) = delete;
  BinStage& operator=(const BinStage&) = delete;

  /// Starts a frame. `commands` must stay unchanged until the next frame. Throws std::bad_alloc.
  void begin(const FrameCommands& commands, const TileGrid& grid, int samples);

  std::size_t batch_count() const { return batch_count_; }
  /// Fills the bins of some tiles.
  /// A single tile always succeeds: bins that exceed the limit are made while it is rendered, one batch at a
  /// time.
  /// @return  false if there are several tiles and their bins would exceed the limit
  bool fill(const TileRange& tiles, FrameProgress& progress);
  /// The bins filled last, at a constant address. Tiles must be indexed before they are rendered.
  BinBatches& batches() { return batches_; }
  /// Counts of the last fill(); complete even if it returned false.
  const BinCounts& counts() const { return counts_; }

 private:
  struct alignas(64) WorkerCounts {
    BinCounts counts;
  };

  void prepare_draws(int samples);
  /// Computes the facing and the depth offset of polygons that need a common one.
  void compute_polygon_values();
  void compute_polygon_values(const DrawRange& range) const;
  void start_budget();
  /// Bins elements [begin, end) of the frame.
  void bin(Bins& bins, std::size_t begin, std::size_t end, int worker) const;
  /// Bins elements [begin, end) of a draw.
  void bin_draw_range(Bins& bins, const DrawRange& range) const;
  void fill_one_by_one(const TileRange& tile);

  std::size_t limit_bytes_;
  WorkerPool& worker_pool_;
  DrawMeasurer& draw_measurer_;
  InstructionSet isa_;
  std::vector<Bins> bins_;
  BinBudget budget_;              ///< memory of bins_
  bool budget_is_exact_ = false;  ///< the budget equals the bytes in use
  const FrameCommands* commands_ = nullptr;
  TileGrid grid_{};
  std::vector<BinDraw> draws_;
  std::vector<PixelRect> draw_rects_;  ///< per draw: its rectangle in the whole frame
  /// Per draw, and one past the last: its first element in the frame. A bitmap or an image counts as one
  /// element.
  std::vector<std::size_t> first_element_;
  DrawRanges polygon_ranges_;  ///< triangles whose polygons have a common facing or offset
  std::size_t batch_count_ = 1;
  BinBatches batches_;
  std::vector<WorkerCounts> worker_counts_;
  BinCounts counts_;
};

}  // namespace tessera::detail
