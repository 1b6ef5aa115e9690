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
  /// Whether passes render the tile.
  bool renders(int row, int column) const {
    return any() && (passes_.back().kind == PassKind::fragments || !captured_pixels(row, column).empty());
  }
  /// Renders a tile once per pass. Distinct tiles may run concurrently, each in its own workspace.
  /// @param load_tests  load_tests() restores the tile's depth and stencil from before the frame
  /// @return  number of fragments, if they are counted
  template <class LoadTests>
  std::uint64_t render_tile(int row, int column, TileWorkspace& workspace,
                            const LoadTests& load_tests) const {
    std::uint64_t fragments = 0;
    const bool is_captured = !captured_pixels(row, column).empty();
    for (const Pass& pass : passes_) {
      if (!is_captured && pass.kind != PassKind::fragments) continue;
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
  /// Pixels of a tile that are written to the spans, in raster space.
  PixelRect captured_pixels(int row, int column) const {
    const int size = grid_.tile_size;
    return intersect(region_, {column * size, row * size, (column + 1) * size, (row + 1) * size});
  }
  /// Index of a pixel of the region in the spans.
  std::size_t span_index(int x, int y) const {
    const auto width = static_cast<std::size_t>(region_.x1 - region_.x0);
    return static_cast<std::size_t>(y - region_.y0) * width + static_cast<std::size_t>(x - region_.x0);
  }
  /// Index of a pixel of the frame in the memory of its tile.
  int tile_index_of(int x, int y) const {
    return tile_index(x % grid_.tile_size, y % grid_.tile_size, grid_.tile_size);
  }
  void write_ids(std::span<std::uint32_t> to, const PixelRect& pixels, TileWorkspace& workspace) const;
  void write_normals(const PixelRect& pixels, TileWorkspace& workspace) const;

  Capture capture_;
  TileGrid grid_;
  PixelRect region_;  ///< pixels that are captured
  RenderTile* render_;
  LightingProgram normal_program_;           ///< has no lights: only normalizes normals
  std::vector<std::uint32_t> triangle_ids_;  ///< 0, 1, 2, ... up to the longest mesh
  /// Per draw: the polygon of each triangle; empty if each triangle is a polygon.
  std::vector<std::vector<std::uint32_t>> polygon_ids_;
  std::vector<Pass> passes_;
};

}  // namespace tessera::detail
