// Functions of FrameBuffer that read the planes back, as a whole or in part.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/buffers/image_target.h"
#include "engine/buffers/view_depth.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/runtime/renderer_state.h"
#include "framebuffer/accumulation.h"
#include "framebuffer/bit_transpose.h"
#include "framebuffer/scan_out.h"

namespace tessera {
using namespace detail;
namespace {

constexpr int kBandRows = 32;  // planes are loaded in tiles of this size

/// Pixels that a call reads, and the workers that do it.
struct Reading {
  const char* function;
  PixelRect pixels;     ///< raster space, within the frame buffer
  WorkerPool* workers;  ///< null: the calling thread

  int width() const { return pixels.x1 - pixels.x0; }
  int height() const { return pixels.y1 - pixels.y0; }
  int first_band() const { return pixels.y0 / kBandRows; }
  std::size_t band_count() const {
    if (pixels.empty()) return 0;
    return static_cast<std::size_t>((pixels.y1 + kBandRows - 1) / kBandRows - first_band());
  }
  /// Calls task(i, worker) for every i below `count`, in FloatingPointMode.
  template <class Task>
  void for_each(std::size_t count, const Task& task) const {
    if (workers != nullptr) return workers->for_each(count, task);
    for (std::size_t i = 0; i < count; ++i) task(i, 0);
  }
};

/// Loads the rows of a band that lie in `pixels`.
/// @param band  kBandRows rows of pixels.x1 - pixels.x0 words
void load_band(LoadPlanesFn* load, const BitplaneStack& planes, const PixelRect& pixels, int y0,
               std::uint32_t* band) {
  alignas(kPlaneAlignment) std::uint32_t tile[kBandRows * kBandRows];
  const int rows = std::min(kBandRows, planes.height_px() - y0);
  const std::ptrdiff_t width = pixels.x1 - pixels.x0;
  for (int x0 = pixels.x0 / kBandRows * kBandRows; x0 < pixels.x1; x0 += kBandRows) {
    load(tile, {x0, y0, kBandRows, 0}, planes);
    const int begin = std::max(pixels.x0, x0);
    const int end = std::min(pixels.x1, x0 + kBandRows);
    for (int y = std::max(0, pixels.y0 - y0); y < std::min(rows, pixels.y1 - y0); ++y)
      for (int x = begin, next; x < end; x = next) {
        next = std::min((x / kBlockSize + 1) * kBlockSize, end);
        std::copy_n(tile + tile_index(x - x0, y, kBandRows), next - x, band + y * width + (x - pixels.x0));
      }
  }
}

/// Calls use(words, y) for every row that is read; y counts from the top of the region. Calls for distinct
/// rows may be concurrent.
template <class Use>
void for_each_row(const Attachment& buffer, const Reading& reading, const Use& use) {
  const PixelRect& pixels = reading.pixels;
  const auto width = static_cast<std::size_t>(reading.width());
  const std::size_t bands = reading.band_count();
  const std::size_t workers = reading.workers != nullptr ? reading.workers->workers_for(bands) : 1;
  translate_bad_alloc(reading.function, [&] {
    LoadPlanesFn* const load = load_planes_for(available_isas().front());
    std::vector<std::uint32_t> memory(workers * width * kBandRows, buffer.clear_value);
    reading.for_each(bands, [&](std::size_t i, int worker) {
      std::uint32_t* const band = memory.data() + static_cast<std::size_t>(worker) * width * kBandRows;
      const int y0 = (reading.first_band() + static_cast<int>(i)) * kBandRows;
      if (buffer.content != Attachment::Content::fast_cleared)
        load_band(load, buffer.planes, pixels, y0, band);
      for (int y = std::max(pixels.y0, y0); y < std::min(pixels.y1, y0 + kBandRows); ++y)
        use(std::span<const std::uint32_t>(band + static_cast<std::size_t>(y - y0) * width, width),
            static_cast<std::size_t>(y - pixels.y0));
    });
  });
}

template <class T>
void require_pixels(std::span<T> span, const Reading& reading, std::size_t components = 1) {
  const std::size_t pixels =
      static_cast<std::size_t>(reading.width()) * static_cast<std::size_t>(reading.height());
  if (span.size() != components * pixels)
    throw Error(ErrorCode::invalid_argument,
                std::string(reading.function) + ": the span holds " + std::to_string(span.size()) +
                    " elements, the pixels to read are " + std::to_string(pixels) +
                    (components > 1 ? " of " + std::to_string(components) + " components" : ""));
}

/// Reads a buffer of one value per pixel: value = convert(word).
template <class T, class Convert>
void read_values(FrameBufferState& state, Buffer which, std::span<T> values, const Reading& reading,
                 const Convert& convert) {
  require_pixels(values, reading);
  const FloatingPointMode mode;
  for_each_row(require_readable(state, which, reading.function), reading,
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 std::transform(row.begin(), row.end(), values.data() + y * row.size(), convert);
               });
}

constexpr auto kStoredWord = [](std::uint32_t word) { return word; };

}  // namespace

WorkerPool* FrameBuffer::worker_pool(Renderer* renderer, const char* function) {
  if (renderer == nullptr) return nullptr;
  if (!renderer->state_)
    throw Error(ErrorCode::invalid_state, std::string(function) + ": the renderer was moved from");
  return &renderer->state_->worker_pool;
}

void FrameBuffer::read_color(const ImageTarget& target, Renderer* workers) const {
  constexpr const char* kFunction = "FrameBuffer::read_color";
  check_image_target(target, state_->format, kFunction);
  const FloatingPointMode mode;
  const auto scan_out = translate_bad_alloc(kFunction, [&] {
    return ScanOut(state_->stored_layout, state_->stored_layout.index ? &state_->palette : nullptr,
                   target.order, available_isas().front());
  });
  const Reading reading{kFunction, target_region(target), worker_pool(workers, kFunction)};
  for_each_row(require_readable(*state_, Buffer::color, kFunction), reading,
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 auto* const pixels =
                     static_cast<std::uint8_t*>(target.pixels) +
                     (reading.pixels.y0 + static_cast<std::ptrdiff_t>(y)) * row_stride(target) +
                     std::ptrdiff_t{4} * reading.pixels.x0;
                 scan_out.row(row.data(), reading.width(), pixels);
               });
}

void FrameBuffer::read_packed_colors(std::span<std::uint32_t> words, const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_packed_colors";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  read_values(*state_, Buffer::color, words, reading, kStoredWord);
}

void FrameBuffer::read_depth(std::span<float> depth, const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_depth";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  read_values(*state_, Buffer::depth, depth, reading, [format = state_->depth_format](std::uint32_t word) {
    return static_cast<float>(dequantize_depth(format, word));
  });
}

void FrameBuffer::read_stored_depths(std::span<std::uint32_t> words, const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_stored_depths";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  read_values(*state_, Buffer::depth, words, reading, kStoredWord);
}

void FrameBuffer::read_view_depth(std::span<float> depth, const Camera& camera, float background,
                                  const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_view_depth";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  require_pixels(depth, reading);
  const FloatingPointMode mode;
  const ViewDepth distance(camera, background, kFunction);
  read_values(*state_, Buffer::depth, depth, reading,
              [&distance, format = state_->depth_format](std::uint32_t word) {
                return distance.at(dequantize_depth(format, word));
              });
}

void FrameBuffer::read_stencil(std::span<std::uint8_t> stencil, const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_stencil";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  read_values(*state_, Buffer::stencil, stencil, reading,
              [](std::uint32_t word) { return static_cast<std::uint8_t>(word); });
}

void FrameBuffer::read_accumulation(std::span<float> rgba, const ReadOptions& options) const {
  constexpr const char* kFunction = "FrameBuffer::read_accumulation";
  const Reading reading{kFunction, pixels_of_region(options.region, state_->format, kFunction),
                        worker_pool(options.workers, kFunction)};
  require_pixels(rgba, reading, 4);
  require_readable(*state_, Buffer::accumulation, kFunction);
  const int bits = state_->format.accumulation_bits;
  const FloatingPointMode mode;
  for (std::size_t c = 0; c < 4; ++c)
    for_each_row(state_->accumulation[c], reading, [&](std::span<const std::uint32_t> row, std::size_t y) {
      // The lowest level lies one step below -1.
      for (std::size_t x = 0; x < row.size(); ++x)
        rgba[4 * (y * row.size() + x) + c] = static_cast<float>(
            std::max(accumulation_level_from_stored(row[x], bits) / accumulation_one(bits), -1.0));
    });
}

}  // namespace tessera
