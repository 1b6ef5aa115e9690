#include "engine/tile_stage.h"

#include <algorithm>
#include <cstring>

namespace tessera {
namespace {

constexpr int kPlaneLinePixels = 512;  // one cache line of a plane: stored by one thread

bool covers_frame(const TileClear& clear, const TileGrid& grid) {
  return clear.rect.x0 == 0 && clear.rect.y0 == 0 && clear.rect.x1 == grid.width_px && clear.rect.y1 == grid.height_px;
}

}  // namespace

TileStage::TileStage(const FrameCommands& commands, const TileFrame& frame, FrameBufferState& target, const ImageTarget* image, Isa isa)
    : commands_(commands), frame_(frame), target_(target), image_(image), render_(render_tile(isa)), store_planes_(store_planes_for(isa)),
      load_planes_(load_planes_for(isa)) {
  if (image == nullptr) return;
  scan_out_.emplace(target.layout, target.layout.index ? &target.palette : nullptr, image->order == PixelOrder::rgba8 ? ByteOrder::rgba8 : ByteOrder::bgra8, isa);
  // Where the picture is all that is wanted, and starts from a clear of all of it, a tile without triangles need not go
  // through tile memory.
  const bool uniform = !commands.color.store && !commands.depth.store && !commands.color.load && !commands.clears.empty() &&
                       std::all_of(commands.clears.begin(), commands.clears.end(), [&](const TileClear& c) { return covers_frame(c, frame.grid); });
  if (!uniform) return;
  std::uint32_t word = 0;
  for (const TileClear& clear : commands.clears) word = clear.color ? clear.color_word : word;
  const std::vector<std::uint32_t> words(static_cast<std::size_t>(frame.grid.width_px), word);
  cleared_row_.resize(4 * words.size());
  scan_out_->row(words.data(), frame.grid.width_px, cleared_row_.data());
}

bool TileStage::untouched(int tile) const {
  for (std::uint32_t b = 0; b < frame_.bin_count; ++b)
    if (frame_.bins[b].first(tile) != Bins::kNone) return false;
  return true;
}

std::vector<TileStrip> TileStage::strips() const {
  const TileGrid& grid = frame_.grid;
  // Tiles that share a cache line of a plane belong to one worker.
  const bool planes = commands_.color.store || commands_.depth.store;
  const int length = planes ? kPlaneLinePixels / grid.tile_size : 1;
  std::vector<TileStrip> strips;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); column = strips.back().last_column + 1) {
      TileStrip strip{row, column, std::min(column + length, grid.columns()) - 1};
      if (!cleared_row_.empty() && untouched(row * grid.columns() + column)) {
        strip.cleared = true;
        while (strip.last_column + 1 < grid.columns() && untouched(row * grid.columns() + strip.last_column + 1)) ++strip.last_column;
      } else {
        for (int c = column; c <= strip.last_column; ++c)
          for (std::uint32_t b = 0; b < frame_.bin_count; ++b) strip.triangles += frame_.bins[b].triangles(row * grid.columns() + c);
      }
      strips.push_back(strip);
    }
  }
  std::stable_sort(strips.begin(), strips.end(), [](const TileStrip& a, const TileStrip& b) { return a.triangles > b.triangles; });
  return strips;
}

std::uint64_t TileStage::render(const TileStrip& strip, TileWorkspace& workspace, std::uint64_t& shaded_pixels) const {
  if (strip.cleared) {
    fill_cleared(strip);
    return 0;
  }
  std::uint64_t touched = 0;
  for (int column = strip.first_column; column <= strip.last_column; ++column) touched += render_tile_at(strip.row, column, workspace, shaded_pixels) ? 1 : 0;
  return touched;
}

bool TileStage::render_tile_at(int row, int column, TileWorkspace& workspace, std::uint64_t& shaded_pixels) const {
  const TileGrid& grid = frame_.grid;
  const int size = grid.tile_size, x0 = column * size, y0 = row * size;
  const TilePlace color_place{x0, y0, size, 0}, depth_place{x0, y0, size, depth_word_from_key(target_.depth_kind, 0)};
  auto* depth_words = reinterpret_cast<std::uint32_t*>(workspace.depth());
  load(commands_.color, target_.color, workspace.color(), color_place);
  load(commands_.depth, target_.depth, depth_words, depth_place);
  const TileCounts counts = render_(frame_, row * grid.columns() + column, workspace);
  shaded_pixels += counts.shaded_pixels;
  if (image_)
    scan_out_->tile(workspace.color(), size, std::min(size, grid.width_px - x0), std::min(size, grid.height_px - y0), shown_at(x0, y0), image_->stride_bytes);
  if (commands_.color.store) store_planes_(workspace.color(), color_place, target_.color.planes, ~0u);
  if (commands_.depth.store) store_planes_(depth_words, depth_place, target_.depth.planes, ~0u);
  return counts.touched;
}

void TileStage::load(const BufferTraffic& traffic, const StoredBuffer& stored, std::uint32_t* words, const TilePlace& place) const {
  if (!traffic.used || !traffic.load) return;
  if (stored.content == StoredBuffer::Content::uniform)
    std::fill_n(words, place.tile_size * place.tile_size, stored.word ^ place.flip);
  else
    load_planes_(words, place, stored.planes);
}

void TileStage::fill_cleared(const TileStrip& strip) const {
  const int size = frame_.grid.tile_size, x0 = strip.first_column * size;
  const int width = std::min((strip.last_column + 1) * size, frame_.grid.width_px) - x0, end = std::min((strip.row + 1) * size, frame_.grid.height_px);
  for (int y = strip.row * size; y < end; ++y) std::memcpy(shown_at(x0, y), cleared_row_.data(), std::size_t{4} * static_cast<std::size_t>(width));
}

std::uint8_t* TileStage::shown_at(int x, int y) const {
  return static_cast<std::uint8_t*>(image_->pixels) + y * image_->stride_bytes + std::ptrdiff_t{4} * x;
}

}  // namespace tessera
