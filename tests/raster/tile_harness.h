// Renders single tiles without the engine: draws and bins are filled by the test.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "shading/tile_renderer.h"

namespace tessera::test {
using namespace detail;

inline std::string name_of(InstructionSet isa) {
  if (isa == InstructionSet::avx512) return "avx512";
  return isa == InstructionSet::avx2 ? "avx2" : "scalar";
}

class TileHarness {
 public:
  TileHarness(int width_px, int height_px, int tile_size, DepthFormat depth_format = DepthFormat::none) {
    frame_.grid = {width_px, height_px, tile_size};
    frame_.layout = rgb_layout(24);
    frame_.depth_format = depth_format;
    bins_.reset(frame_.grid.count());
  }

  /// Adds a draw. Defaults: the whole frame buffer, one colour, no depth.
  TileDraw& add_draw(const WindowVertex* vertices) {
    TileDraw draw;
    draw.vertices = vertices;
    draw.rect = {0, 0, frame_.grid.width_px, frame_.grid.height_px};
    draws_.push_back(draw);
    return draws_.back();
  }
  void clear_draws() {
    draws_.clear();
    bins_.reset(frame_.grid.count());
  }
  /// Adds triangle `id` of a draw to a tile's bin.
  void push(int tile, std::size_t draw, std::uint32_t id) {
    bins_.push(tile, static_cast<std::uint32_t>(draw), id);
  }
  Bins& bins() { return bins_; }
  TileFrame& frame() { return frame_; }
  std::size_t draw_count() const { return draws_.size(); }
  TileDraw& draw(std::size_t i) { return draws_[i]; }

  /// Renders a tile over a background.
  TileCounts render(InstructionSet isa, int tile, std::uint32_t color = 0, std::int32_t depth = 0) {
    const auto pixels = static_cast<std::size_t>(frame_.grid.tile_size * frame_.grid.tile_size);
    std::fill_n(workspace_.color(), pixels, color);
    if (frame_.depth_format != DepthFormat::none) std::fill_n(workspace_.depth(), pixels, depth);
    for (TileDraw& draw : draws_) draw.path = choose_pixel_path(pixel_path_frame(frame_, isa), draw);
    frame_.draws = draws_.data();
    frame_.draw_count = static_cast<std::uint32_t>(draws_.size());
    batches_.set({&bins_, 1}, frame_.grid.count());
    batches_.index_batches(tile, 1);
    frame_.batches = &batches_;
    if (frame_.samples > 1) workspace_.allocate_samples();
    frame_.loads_color = frame_.loads_depth = true;
    return render_tile(isa)(frame_, tile, workspace_);
  }
  TileWorkspace& workspace() { return workspace_; }
  /// Packed colour of a pixel of the tile rendered last.
  std::uint32_t color(int x, int y) { return workspace_.color()[tile_index(x, y, frame_.grid.tile_size)]; }
  /// Packed colour of one sample. @pre several samples, and a triangle in the tile
  std::uint32_t sample_color(int sample, int x, int y) const {
    return workspace_.sample_color(sample)[tile_index(x, y, frame_.grid.tile_size)];
  }
  std::int32_t depth(int x, int y) { return workspace_.depth()[tile_index(x, y, frame_.grid.tile_size)]; }
  std::vector<std::uint32_t> colors() {
    return {workspace_.color(), workspace_.color() + frame_.grid.tile_size * frame_.grid.tile_size};
  }
  std::vector<std::int32_t> depths() {
    return {workspace_.depth(), workspace_.depth() + frame_.grid.tile_size * frame_.grid.tile_size};
  }

 private:
  TileFrame frame_;
  std::vector<TileDraw> draws_;
  Bins bins_;
  BinBatches batches_;
  TileWorkspace workspace_;
};

}  // namespace tessera::test
