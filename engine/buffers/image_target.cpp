#include "engine/buffers/image_target.h"

#include <cstddef>
#include <string>

#include "engine/plan/draw_plan.h"
#include "engine/record/checks.h"

namespace tessera::detail {

void check_image_target(const ImageTarget& target, const FrameBufferFormat& format, const char* function) {
  if (target.pixels == nullptr)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target's pixels are a null pointer");
  if (target.width != format.width || target.height != format.height)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target is " + std::to_string(target.width) + " x " +
                    std::to_string(target.height) + " pixels, the frame buffer is " +
                    std::to_string(format.width) + " x " + std::to_string(format.height));
  const std::ptrdiff_t row = std::ptrdiff_t{4} * target.width;
  const bool rows_overlap = row_stride(target) < row && row_stride(target) > -row;
  if (target.height > 1 && rows_overlap)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": the target's stride is " +
                                                 std::to_string(target.stride_bytes) +
                                                 " bytes, a row takes " + std::to_string(row));
  require_enum({function, ": the target's order"}, target.order, PixelOrder::bgra8);
  if (target.region && (target.region->width < 0 || target.region->height < 0))
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target's region is " + std::to_string(target.region->width) +
                    " x " + std::to_string(target.region->height) + " pixels, must not be negative");
}

PixelRect target_region(const ImageTarget& target) {
  const PixelRect whole{0, 0, target.width, target.height};
  if (!target.region) return whole;
  const PixelRect region = intersect(whole, raster_rect(*target.region, target.height));
  return region.empty() ? PixelRect{} : region;
}

PixelRect pixels_of_region(const std::optional<Rect>& region, const FrameBufferFormat& format,
                           const char* function) {
  if (!region) return {0, 0, format.width, format.height};
  const Rect& r = *region;
  const bool is_in_width = r.x >= 0 && r.width >= 0 && r.x <= format.width - r.width;
  const bool is_in_height = r.y >= 0 && r.height >= 0 && r.y <= format.height - r.height;
  if (!is_in_width || !is_in_height)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the region is " + std::to_string(r.width) + " x " +
                    std::to_string(r.height) + " pixels at (" + std::to_string(r.x) + ", " +
                    std::to_string(r.y) + "), must lie in the frame buffer of " +
                    std::to_string(format.width) + " x " + std::to_string(format.height));
  return raster_rect(r, format.height);
}

}  // namespace tessera::detail
