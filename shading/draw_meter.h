// Time and pixels that each draw of a frame takes in the tiles of one worker.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::detail {

/// Cost of a draw in tiles.
struct DrawCost {
  double seconds = 0;
  std::uint64_t tiles = 0;          ///< tiles whose bins hold elements of the draw
  std::uint64_t shaded_pixels = 0;  ///< colour evaluations
  std::uint64_t fragments = 0;      ///< pixels covered before any test
};

/// Quantities that a pass over a tile measures.
enum class MeterPass : std::uint8_t {
  none,      ///< nothing: no clock is read
  costs,     ///< all of DrawCost except fragments
  fragments  ///< fragments only: the pass evaluates a colour for each
};

/// Assigns the time and the pixels of a tile to the draws of a frame. The tile renderer reports each change
/// of the draw that it works on: at the markers of bins, and between batches of deferred shading. The clock
/// is read at these changes only.
class DrawMeter {
 public:
  static constexpr std::uint32_t kNoDraw = 0xffffffffu;

  /// Forgets all costs. Throws std::bad_alloc.
  void begin_frame(std::size_t draws);
  std::span<const DrawCost> costs() const { return costs_; }

  // `shaded_pixels` is the number of colour evaluations in the tile so far.

  /// @pre `pass` is not none
  void begin_tile(MeterPass pass);
  /// Begins the elements of `draw` in the bins of the tile. Draws do not decrease within a tile.
  void begin_draw(std::uint32_t draw, std::uint64_t shaded_pixels);
  /// The time and pixels that follow belong to `draw`. kNoDraw: to none.
  void switch_to(std::uint32_t draw, std::uint64_t shaded_pixels);
  std::uint32_t current() const { return current_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<DrawCost> costs_;  // per draw
  MeterPass pass_ = MeterPass::none;
  std::uint32_t current_ = kNoDraw;
  std::uint32_t last_begun_ = kNoDraw;
  std::uint64_t shaded_pixels_ = 0;  // at the last change
  Clock::time_point since_;          // time of the last change
};

}  // namespace tessera::detail
