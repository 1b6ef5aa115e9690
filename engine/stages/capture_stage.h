// Captures: tiles are rendered once more per requested quantity, with the coverage, depth and order of the
// frame, and with numbers or normals in place of colours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/plan/frame_commands.h"
#include "engine/record/recording.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

class CaptureStage {
 public:
  /// `frame` and `commands` must outlive it. Throws std::bad_alloc.
  CaptureStage(const FrameCommands& commands, const TileFrame& frame, const Capture& capture,
               bool count_fragments, InstructionSet isa);

  bool needs_normals() const { return !capture_.normals.empty(); }
  bool any() const { return !passes_.empty(); }
  /// Whether tiles without elements have pixels to write. Counts alone need no such tiles.
  bool fills_spans() const { return any() && passes_.front().kind != PassKind::fragments; }
  /// Renders a tile once per pass. Distinct tiles may run concurrently, each in its own workspace.
  /// @param load_tests  load_tests() restores the tile's depth and stencil from before the frame
  /// @return  number of fragments, if they are counted
  template <class LoadTests>
  std::uint64_t render_tile(int row, int column, TileWorkspace& workspace,
                            const LoadTests& load_tests) const {
    std::uint64_t fragments = 0;
    for (const Pass& pass : passes_) {
      load_tests();
      fragments += render_pass(pass, row, column, workspace);
    }
    return fragments;
  }

 private:
  enum class PassKind : std::uint8_t { draw_ids, primitive_ids, normals, fragments };
  struct Pass {
    PassKind kind;
    TileFrame frame;
    std::vector<TileDraw> draws;
    std::vector<TileClear> clears;
    std::vector<FragmentOps> ops;  ///< tests of the draws with fragment operations
  };
  void number_primitives(std::span<const GeometryDraw> draws);
  void add_pass(PassKind kind, const FrameCommands& commands, const TileFrame& frame, InstructionSet isa);
  /// Makes a draw of a pass write the pass's quantity in place of its colours.
  /// @param tile_draw  its number among the frame's
  void change_output(Pass& pass, TileDraw& draw, const FrameCommands& commands, std::size_t tile_draw) const;
  std::uint64_t render_pass(const Pass& pass, int row, int column, TileWorkspace& workspace) const;
  void write_ids(std::span<std::uint32_t> to, int x0, int y0, TileWorkspace& workspace) const;
  void write_normals(int x0, int y0, TileWorkspace& workspace) const;

  Capture capture_;
  TileGrid grid_;
  RenderTile* render_;
  LightingProgram normal_program_;           ///< has no lights: only normalizes normals
  std::vector<std::uint32_t> triangle_ids_;  ///< 0, 1, 2, ... up to the longest mesh
  /// Per draw: the polygon of each triangle; empty if each triangle is a polygon.
  std::vector<std::vector<std::uint32_t>> polygon_ids_;
  std::vector<Pass> passes_;
};

}  // namespace tessera::detail
