// A recorded frame as the tiles will run it: draws with their memory, clears in words, accumulations, and
// what becomes of each buffer.
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "engine/plan/draw_plan.h"
#include "engine/record/recording.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/geometry.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

/// How a buffer goes through a frame.
struct AttachmentOps {
  bool used = false;     ///< tiles work on it
  bool touched = false;  ///< a command changes it
  bool load = false;     ///< tiles start from what the frame buffer holds
  bool store = false;    ///< tiles end in the planes
  bool keep = false;
  /// The whole buffer ends as one word that no pixel of a draw can have changed: nothing is stored.
  bool ends_fast_cleared = false;
  std::array<std::uint32_t, 4> clear_values{};  ///< of each of the buffer's attachments
};

/// Used for one frame after the other: its memory is kept.
struct FrameCommands {
  std::vector<DrawPlan> plan_memory;   ///< of each recorded draw; and, from frames before, of more
  std::vector<const DrawPlan*> plans;  ///< of draws that can change something
  std::vector<std::size_t> plan_draw;  ///< the recorded draw of each plan
  /// The tiles' first draw of each plan, and one past the last: polygons that are not all filled are several.
  std::vector<std::uint32_t> first_tile_draw;
  std::vector<GeometryDraw> geometry;
  std::vector<TileDraw> tile_draws;
  std::vector<std::size_t> tile_draw_plan;  ///< of each
  std::vector<TileClear> clears;
  std::vector<TileAccumulation> accumulations;
  std::vector<std::uint32_t>
      first_plan_at;  ///< of each recorded draw, and one past the last: the first plan from there on
  std::vector<std::uint32_t> clears_until;  ///< of each recorded clear, likewise
  AttachmentOps color, depth, stencil, accumulation;

  void reset();

  bool stores() const { return color.store || depth.store || stencil.store || accumulation.store; }
  const AttachmentOps& attachment_ops(Buffer which) const {
    switch (which) {
      case Buffer::color: return color;
      case Buffer::depth: return depth;
      case Buffer::stencil: return stencil;
      default: return accumulation;
    }
  }
};

/// Plans every draw that can change a pixel and every clear that can matter. `presented`: the colour goes to
/// an image too. Throws Error where a buffer that the frame needs was not kept by the frame before.
/// @param commands  are replaced
void plan_frame(FrameCommands& commands, FrameRecording& recording, bool presented,
                std::deque<DrawBuffers>& buffers, WorkerPool& worker_pool);

/// The styles in which a plan's elements are drawn, in the order of its tile draws; none: as they are.
std::span<const PolygonMode> styles_of(const DrawPlan& plan);

/// Fills in the tiles' view of the draws; after the vertex stage's memory is there.
void build_tile_draws(FrameCommands& commands, const PixelPathFrame& frame);

}  // namespace tessera::detail
