// Recording of bitmaps and images. All arguments are checked here.
#include <cmath>
#include <string>

#include "engine/record/checks.h"
#include "engine/record/recording.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/runtime/worker_pool.h"

namespace tessera {
using namespace detail;
namespace {

/// Makes the checks common to bitmaps and images, and sets the default stride.
/// @param memory_name  argument that holds the pixels, named in errors
/// @param row_bytes    minimum size of a row
void check_pixels(const char* function, RecordedPixels& pixels, const char* memory_name,
                  std::int64_t row_bytes) {
  PixelRectangle& texels = pixels.rectangle;
  require_range({function, ": width"}, texels.width, 1, kMaxFrameBufferSize);
  require_range({function, ": height"}, texels.height, 1, kMaxFrameBufferSize);
  if (texels.top_row == nullptr)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": " + memory_name + " is null");
  if (texels.stride_bytes == 0) texels.stride_bytes = static_cast<std::ptrdiff_t>(row_bytes);
  const bool rows_overlap = texels.stride_bytes < row_bytes && texels.stride_bytes > -row_bytes;
  if (texels.height > 1 && rows_overlap)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": stride_bytes is " +
                                                 std::to_string(texels.stride_bytes) + ", a row takes " +
                                                 std::to_string(row_bytes) + " bytes");
  require_finite({function, ": position"}, {texels.x, texels.y});
  require_range({function, ": depth"}, pixels.depth, 0, 1);
}

void record(FrameRecording& recording, const char* function, const RecordedPixels& pixels,
            const FragmentState& state) {
  translate_bad_alloc(function, [&] {
    RecordedDraw draw{
        .mesh = {}, .state = draw_state(state), .scene_state = &recording.scene_state(), .pixels = pixels};
    check_fragment_state(function, draw.state, *recording.target);
    recording.draws.push_back(std::move(draw));
  });
}

}  // namespace

void Frame::draw_bitmap(const Bitmap& bitmap, const FragmentState& state) {
  constexpr const char* kFunction = "Frame::draw_bitmap";
  const FloatingPointMode mode;
  RecordedPixels pixels{.rectangle = {.x = bitmap.x,
                                      .y = bitmap.y,
                                      .width = bitmap.width,
                                      .height = bitmap.height,
                                      .top_row = bitmap.bits,
                                      .stride_bytes = bitmap.stride_bytes},
                        .depth = bitmap.depth,
                        .color = bitmap.color};
  check_pixels(kFunction, pixels, "bits", (std::int64_t{bitmap.width} + 7) / 8);
  require_finite({kFunction, ": color"}, bitmap.color);
  pixels.rectangle.x = std::floor(pixels.rectangle.x);
  pixels.rectangle.y = std::floor(pixels.rectangle.y);
  record(*recording_, kFunction, pixels, state);
}

void Frame::draw_image(const PixelImage& image, const FragmentState& state) {
  constexpr const char* kFunction = "Frame::draw_image";
  const FloatingPointMode mode;
  require_range({kFunction, ": channels"}, image.channels, 1, 4);
  RecordedPixels pixels{.rectangle = {.x = image.x,
                                      .y = image.y,
                                      .zoom_x = image.zoom_x,
                                      .zoom_y = image.zoom_y,
                                      .width = image.width,
                                      .height = image.height,
                                      .top_row = image.pixels,
                                      .stride_bytes = image.stride_bytes,
                                      .channels = image.channels},
                        .depth = image.depth,
                        .color = {}};
  check_pixels(kFunction, pixels, "pixels", std::int64_t{image.width} * image.channels);
  require_finite({kFunction, ": zoom"}, {image.zoom_x, image.zoom_y});
  record(*recording_, kFunction, pixels, state);
}

}  // namespace tessera
