// A recorded frame as the stages run it: draws with their memory, clears as stored words, accumulations, and
// the load and store operations of the attachments.
#pragma once

#include <deque>
#include <vector>

#include "engine/plan/attachment_ops.h"
#include "engine/plan/draw_plan.h"
#include "engine/plan/live_commands.h"
#include "engine/record/recording.h"
#include "engine/runtime/worker_pool.h"
#include "engine/stages/geometry.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

/// Memory is kept from frame to frame.
struct FrameCommands {
  std::vector<DrawPlan> plan_memory;   ///< per recorded draw; excess plans are of earlier frames
  std::vector<const DrawPlan*> plans;  ///< plans of draws that can change a pixel
  std::vector<std::size_t> plan_draw;  ///< per plan: its recorded draw
  /// Per plan, and one past the last: its first tile draw. A plan has one tile draw per polygon mode.
  std::vector<std::uint32_t> first_tile_draw;
  std::vector<GeometryDraw> geometry;
  std::vector<TileDraw> tile_draws;
  std::vector<std::size_t> tile_draw_plan;  ///< per tile draw: its plan
  std::vector<TileClear> clears;
  std::vector<std::uint32_t> clear_patterns;  ///< packed colours of dithered clears
  std::vector<std::size_t> clear_record;      ///< per clear: its recorded clear
  std::vector<TileAccumulation> accumulations;
  std::vector<std::size_t> accumulation_record;  ///< per accumulation: its recorded accumulation
  LiveCommands live;                             ///< memory of plan_frame()
  /// Per recorded draw, and one past the last: index of the first plan of this or a later draw.
  std::vector<std::uint32_t> first_plan_at;
  /// Per recorded clear, and one past the last: index of the first tile clear of this or a later clear.
  std::vector<std::uint32_t> first_clear_at;
  FrameAttachments attachments;

  void reset();
};

/// The geometry of a planned draw.
GeometryDraw geometry_draw(const RecordedDraw& draw, const DrawPlan& plan, FrameBufferState& target,
                           DrawBuffers& buffers);

/// Plans every draw, clear and accumulation that can change a pixel. With PlanOptions::elide, commands whose
/// result nothing reads are left out; attachments are loaded and stored as with them.
/// @param commands   is replaced
/// @param presented  the colour goes to an image
/// @param options    of every draw; captures are taken from `recording`
/// @param worker_pool  plans many draws in parallel; null: serial
/// @throws Error  if the frame loads a buffer that the frame before did not keep
void plan_frame(FrameCommands& commands, FrameRecording& recording, bool presented, PlanOptions options,
                std::deque<DrawBuffers>& buffers, WorkerPool* worker_pool);

}  // namespace tessera::detail
