#include "engine/buffers/diffuse_colors.h"

#include <algorithm>
#include <utility>

#include "engine/buffers/image_target.h"
#include "framebuffer/bit_transpose.h"
#include "framebuffer/tile_grid.h"

namespace tessera::detail {
namespace {

constexpr int kBandRows = kMinTileSize;

/// Calls use(x, y, index in tile memory, count) for the pixels of a tile, in pieces that are adjacent there.
template <class Use>
void for_each_piece(int columns, int rows, const Use& use) {
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; x += kBlockSize)
      use(x, y, tile_index(x, y, kBandRows), std::min(kBlockSize, columns - x));
}

void show_row(const ImageTarget& image, const ScanOut& scan_out, const std::uint32_t* stored, int y) {
  const PixelRect region = target_region(image);
  if (y < region.y0 || y >= region.y1) return;
  auto* const row = static_cast<std::uint8_t*>(image.pixels) + y * row_stride(image);
  scan_out.row(stored + region.x0, region.x1 - region.x0, row + std::ptrdiff_t{4} * region.x0);
}

}  // namespace

void FrameBufferState::build_dither() {
  if (format.dither == Dither::none) return;
  if (!is_error_diffusion(format.dither)) {
    dithered_color.pattern.clear();
    dither =
        std::make_unique<ColorDither>(format.dither, dither_light(), stored_layout, palette, format.height);
    return;
  }
  diffusion = std::make_unique<ErrorDiffusion>(ErrorDiffusionOptions{.kind = format.dither,
                                                                     .stored = stored_layout,
                                                                     .palette = &palette,
                                                                     .light = dither_light(),
                                                                     .width = format.width});
  diffusion_band.resize(2 * static_cast<std::size_t>(format.width) * kBandRows);
}

void reserve_diffused_colors(FrameBufferState& state) {
  state.diffused.planes.allocate(state.diffused.clear_value);
}

void diffuse_colors(FrameBufferState& state, const ImageTarget* image, const ScanOut* scan_out) noexcept {
  const int width = state.format.width, height = state.format.height;
  const InstructionSet isa = available_isas().front();
  LoadPlanesFn* const load = load_planes_for(isa);
  StorePlanesFn* const store = store_planes_for(isa);
  std::uint32_t* const drawn = state.diffusion_band.data();
  std::uint32_t* const stored = drawn + std::ptrdiff_t{width} * kBandRows;
  alignas(kTileAlignment) std::uint32_t tile[kBandRows * kBandRows] = {};
  const bool is_constant = state.color.content == Attachment::Content::fast_cleared;
  if (is_constant) std::fill_n(drawn, std::ptrdiff_t{width} * kBandRows, state.color.clear_value);
  state.diffusion->begin_picture();
  for (int y0 = 0; y0 < height; y0 += kBandRows) {
    const int rows = std::min(kBandRows, height - y0);
    for (int x0 = 0; x0 < width && !is_constant; x0 += kBandRows) {
      load(tile, {x0, y0, kBandRows, 0}, state.color.planes);
      for_each_piece(std::min(kBandRows, width - x0), rows, [&](int x, int y, int index, int count) {
        std::copy_n(tile + index, count, drawn + std::ptrdiff_t{y} * width + x0 + x);
      });
    }
    for (int y = 0; y < rows; ++y) {
      state.diffusion->row(drawn + std::ptrdiff_t{y} * width, stored + std::ptrdiff_t{y} * width);
      if (image != nullptr) show_row(*image, *scan_out, stored + std::ptrdiff_t{y} * width, y0 + y);
    }
    for (int x0 = 0; x0 < width; x0 += kBandRows) {
      for_each_piece(std::min(kBandRows, width - x0), rows, [&](int x, int y, int index, int count) {
        std::copy_n(stored + std::ptrdiff_t{y} * width + x0 + x, count, tile + index);
      });
      const std::uint32_t* const tiles[] = {tile};
      store({tiles, 1}, {x0, y0, kBandRows, 0}, state.diffused.planes, ~0u);
    }
  }
  state.diffused.content = Attachment::Content::planes;
}

}  // namespace tessera::detail
