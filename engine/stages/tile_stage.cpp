#include "engine/stages/tile_stage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/buffers/image_target.h"

namespace tessera::detail {
namespace {

bool covers_frame(const TileClear& clear, const TileGrid& grid) {
  return clear.rect == PixelRect{0, 0, grid.width_px, grid.height_px};
}

constexpr std::size_t kLoadClasses = 4 * 64;
static_assert(kLoadClasses - 1 <= std::numeric_limits<std::uint8_t>::max());
/// Four classes per power of two: loads of one class differ by less than 25 %. Monotonic.
std::uint8_t load_class_of(std::uint64_t triangles) {
  if (triangles < 8) return static_cast<std::uint8_t>(triangles);
  const int highest_bit = std::bit_width(triangles) - 1;
  return static_cast<std::uint8_t>(4 * highest_bit - 4 +
                                   static_cast<int>(triangles >> (highest_bit - 2) & 3));
}

/// Distributes the strips of one load class, sorted[begin, end), over the shares. Place p in the order of
/// loads is place p / shares of share p % shares: shares have equal numbers of every class, up to one, and
/// loads do not increase within a share. Neighbouring strips go to the same share.
void distribute(const std::vector<TileStrip>& sorted, std::size_t begin, std::size_t end, std::size_t shares,
                std::vector<TileStrip>& distributed) {
  // With fewer strips than shares, only the shares from begin % shares on receive one.
  const std::size_t served = std::min(end - begin, shares);
  const std::size_t first_share = served < shares ? begin % shares : 0;
  for (std::size_t k = 0, next = begin; k < served; ++k) {
    const std::size_t share = (first_share + k) % shares;
    const std::size_t first_place = begin + (share + shares - begin % shares) % shares;
    std::size_t at = first_of_share(sorted.size(), shares, share) + first_place / shares;
    for (std::size_t place = first_place; place < end; place += shares) distributed[at++] = sorted[next++];
  }
}

}  // namespace

void ScanOutCache::prepare(const FrameBufferState& target, PixelOrder order, InstructionSet isa) {
  const ColorLayout& layout = target.stored_layout;
  const Palette* const palette = layout.index ? &target.palette : nullptr;
  if (scan_out) scan_out->set(layout, palette, order);
  else scan_out.emplace(layout, palette, order, isa);
}

TileStage::TileStage(const FrameCommands& commands, const TileFrame& frame, FrameBufferState& target,
                     const ImageTarget* image, const CaptureStage& capture, ScanOutCache& scan_out_cache,
                     InstructionSet isa)
    : commands_(commands),
      frame_(frame),
      target_(target),
      image_(image),
      capture_(capture),
      scan_out_cache_(scan_out_cache),
      render_(render_tile(isa)),
      store_planes_(store_planes_for(isa)),
      load_planes_(load_planes_for(isa)),
      buffered_tiles_(commands.attachments.color.stores() ? tiles_per_store(isa, frame.grid.tile_size) : 1) {
  if (image == nullptr) return;
  target_region_ = target_region(*image);
  scan_out_cache.prepare(target, image->order, isa);
  // If only the picture is needed and its background is one colour, tiles without triangles bypass tile
  // memory.
  const bool only_picture_needed = !capture.fills_spans() && !commands.attachments.any_stores();
  const bool background_is_cleared = !commands.clears.empty() && !commands.attachments.color.loads();
  const bool clears_are_uniform =
      std::all_of(commands.clears.begin(), commands.clears.end(),
                  [&](const TileClear& c) { return covers_frame(c, frame.grid) && !c.dithered; });
  const bool background_is_uniform =
      background_is_cleared && clears_are_uniform && commands.accumulations.empty();
  copies_cleared_row_ = only_picture_needed && background_is_uniform;
  if (!copies_cleared_row_) return;
  std::uint32_t word = 0;
  for (const TileClear& clear : commands.clears)
    if (clear.color) word = clear.packed_color;
  std::uint32_t words[kMaxTileSize];
  std::fill(std::begin(words), std::end(words), word);
  scan_out_cache.cleared_row.resize(4 * static_cast<std::size_t>(frame.grid.width_px));
  for (int x = 0; x < frame.grid.width_px; x += kMaxTileSize)
    scan_out_cache.scan_out->row(words, std::min(kMaxTileSize, frame.grid.width_px - x),
                                 scan_out_cache.cleared_row.data() + std::ptrdiff_t{4} * x);
}

void TileStage::build_strips(const TileRange& tiles, const WorkerPool& workers, StripScratch& memory) const {
  const TileGrid& grid = frame_.grid;
  const BinBatches& batches = *frame_.batches;
  const auto is_cleared = [&](int row, int column) {
    return copies_cleared_row_ && batches.known_empty(row * grid.columns() + column);
  };
  // Tiles that share a cache line of a plane go to one worker.
  const int tiles_per_line = commands_.attachments.any_stores() ? kLinePixels / grid.tile_size : 1;
  // Per class: number of strips, later the place of its next strip in `sorted`.
  std::array<std::uint32_t, kLoadClasses> next{};
  memory.strips.clear();
  for (int row = tiles.y0; row < tiles.y1; ++row) {
    for (int column = tiles.x0, end; column < tiles.x1; column = end) {
      const bool cleared = is_cleared(row, column);
      end = std::min((column / tiles_per_line + 1) * tiles_per_line, tiles.x1);
      while (cleared && end < tiles.x1 && is_cleared(row, end)) ++end;
      std::uint64_t triangles = 0;
      for (int c = column; c < end; ++c) triangles += batches.element_count(row * grid.columns() + c);
      memory.strips.push_back({.row = static_cast<std::int16_t>(row),
                               .first_column = static_cast<std::int16_t>(column),
                               .last_column = static_cast<std::int16_t>(end - 1),
                               .cleared = cleared,
                               .load_class = load_class_of(triangles)});
      ++next[memory.strips.back().load_class];
    }
  }
  std::uint32_t count = 0;
  for (std::size_t w = kLoadClasses; w-- > 0;) count += std::exchange(next[w], count);
  memory.sorted.resize(count);
  for (const TileStrip& strip : memory.strips) memory.sorted[next[strip.load_class]++] = strip;
  const std::size_t shares = workers.workers_for(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    const auto load_class = memory.sorted[begin].load_class;
    end = next[load_class];
    distribute(memory.sorted, begin, end, shares, memory.strips);
  }
}

void TileStage::render(const TileStrip& strip, TileWorkspace& workspace, StripCounts& counts) const {
  if (strip.cleared) return fill_cleared(strip);
  std::array<const std::uint32_t*, kLinePixels / kMinTileSize> colors;
  const int size = frame_.grid.tile_size;
  for (int first = strip.first_column; first <= strip.last_column; first += buffered_tiles_) {
    const auto count = static_cast<std::size_t>(std::min(buffered_tiles_, strip.last_column + 1 - first));
    for (std::size_t t = 0; t < count; ++t) {
      colors[t] = workspace.select_color(t);
      render_tile_at(strip.row, first + static_cast<int>(t), workspace, counts);
    }
    if (commands_.attachments.color.stores())
      store_planes_({colors.data(), count}, {first * size, strip.row * size, size, 0}, target_.color.planes,
                    ~0u);
  }
}

void TileStage::render_tile_at(int row, int column, TileWorkspace& workspace, StripCounts& counts) const {
  const TileGrid& grid = frame_.grid;
  const int size = grid.tile_size;
  const int x0 = column * size, y0 = row * size;
  const bool shown = !intersect(target_region_, {x0, y0, x0 + size, y0 + size}).empty();
  const bool captured = capture_.renders(row, column);
  if (!shown && !captured && !commands_.attachments.any_stores()) return;
  const TilePlace color_place{x0, y0, size, 0};
  const TilePlace depth_place{x0, y0, size, stored_depth_from_key(target_.depth_format, 0)};
  auto* depth_words = reinterpret_cast<std::uint32_t*>(workspace.depth());
  auto* stencil_words =
      commands_.attachments.stencil.used() ? reinterpret_cast<std::uint32_t*>(workspace.stencil()) : nullptr;
  const auto load_tests = [&] {
    load(commands_.attachments.depth, target_.depth, depth_words, depth_place);
    load(commands_.attachments.stencil, target_.stencil, stencil_words, color_place);
  };
  if (captured) counts.fragments += capture_.render_tile(row, column, workspace, load_tests);
  load(commands_.attachments.color, target_.color, workspace.color(), color_place);
  load_tests();
  if (commands_.attachments.accumulation.used()) load_accumulation(color_place, workspace.accumulation());
  const TileCounts tile = render_(frame_, row * grid.columns() + column, workspace);
  ++counts.rendered;
  counts.shaded_pixels += tile.shaded_pixels;
  counts.non_finite_fragments += tile.non_finite_fragments;
  counts.hidden_triangles += tile.hidden_triangles;
  counts.touched += tile.touched ? 1 : 0;
  if (shown) scan_out(x0, y0, workspace);
  store(commands_.attachments.depth, target_.depth, depth_words, depth_place);
  store(commands_.attachments.stencil, target_.stencil, stencil_words, color_place);
  if (commands_.attachments.accumulation.stores())
    for (std::size_t c = 0; c < 4; ++c)
      store(commands_.attachments.accumulation, target_.accumulation[c],
            reinterpret_cast<const std::uint32_t*>(workspace.accumulation()[c]), color_place);
}

void TileStage::scan_out(int x0, int y0, TileWorkspace& workspace) const {
  const int size = frame_.grid.tile_size;
  const PixelRect in_frame =
      intersect({x0, y0, x0 + size, y0 + size}, {0, 0, frame_.grid.width_px, frame_.grid.height_px});
  const PixelRect region = intersect(in_frame, target_region_);
  const int width = in_frame.x1 - x0, height = in_frame.y1 - y0;
  if (region == in_frame) {
    scan_out_cache_.scan_out->tile(workspace.color(), size, width, height, target_pixel(x0, y0),
                                   row_stride(*image_));
    return;
  }
  // The edge of the region crosses the tile: convert the whole tile, then copy the part inside.
  std::uint8_t pixels[4 * kMaxTileSize * kMaxTileSize];
  scan_out_cache_.scan_out->tile(workspace.color(), size, width, height, pixels, std::ptrdiff_t{4} * size);
  for (int y = region.y0; y < region.y1; ++y)
    std::memcpy(target_pixel(region.x0, y), pixels + 4 * ((y - y0) * size + region.x0 - x0),
                4 * static_cast<std::size_t>(region.x1 - region.x0));
}

void TileStage::load(const AttachmentOps& ops, const Attachment& stored, std::uint32_t* words,
                     const TilePlace& place) const {
  if (!ops.loads()) return;
  if (stored.content == Attachment::Content::fast_cleared)
    std::fill_n(words, place.tile_size * place.tile_size, stored.clear_value ^ place.flip);
  else load_planes_(words, place, stored.planes);
}

void TileStage::store(const AttachmentOps& ops, Attachment& stored, const std::uint32_t* words,
                      const TilePlace& place) const {
  if (ops.stores()) store_planes_({&words, 1}, place, stored.planes, ~0u);
}

void TileStage::load_accumulation(const TilePlace& place, const AccumulatedPixels& levels) const {
  if (!commands_.attachments.accumulation.loads()) return;
  for (std::size_t c = 0; c < 4; ++c) {
    auto* const words = reinterpret_cast<std::uint32_t*>(levels[c]);
    load(commands_.attachments.accumulation, target_.accumulation[c], words, place);
    const int bits = target_.format.accumulation_bits;
    const int pixels = place.tile_size * place.tile_size;
    for (int i = 0; i < pixels; ++i) levels[c][i] = accumulation_level_from_stored(words[i], bits);
  }
}

void TileStage::fill_cleared(const TileStrip& strip) const {
  const int size = frame_.grid.tile_size;
  const PixelRect region = intersect(
      target_region_,
      {strip.first_column * size, strip.row * size, (strip.last_column + 1) * size, (strip.row + 1) * size});
  if (region.empty()) return;
  for (int y = region.y0; y < region.y1; ++y)
    std::memcpy(target_pixel(region.x0, y), scan_out_cache_.cleared_row.data(),
                4 * static_cast<std::size_t>(region.x1 - region.x0));
}

std::uint8_t* TileStage::target_pixel(int x, int y) const {
  return static_cast<std::uint8_t*>(image_->pixels) + y * row_stride(*image_) + std::ptrdiff_t{4} * x;
}

}  // namespace tessera::detail
