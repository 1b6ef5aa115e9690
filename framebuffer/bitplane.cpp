#include "framebuffer/bitplane.h"

#include <cstring>

namespace tessera::detail {

BitplaneStack::BitplaneStack(int width_px, int height_px, int plane_count) noexcept
    : width_px_(width_px), height_px_(height_px), plane_count_(plane_count) {
  TESSERA_ASSERT(width_px >= 1 && height_px >= 1 && plane_count >= 0 && plane_count <= kMaxPlanes);
  const std::size_t row_lines = (static_cast<std::size_t>(width_px) + kLinePixels - 1) / kLinePixels;
  // Odd: an even number of lines, especially a power of two, would map a pixel's bits in all planes to a few
  // cache sets.
  const std::size_t plane_lines = row_lines * static_cast<std::size_t>(height_px) | 1;
  stride_bytes_ = static_cast<std::ptrdiff_t>(row_lines * kPlaneAlignment);
  plane_stride_bytes_ = plane_lines * kPlaneAlignment;
}

void BitplaneStack::allocate(std::uint32_t value) {
  if (allocated() || plane_count_ == 0) return;
  std::uint8_t* memory = external_memory_;
  if (memory == nullptr)
    memory = static_cast<std::uint8_t*>(::operator new (needed_bytes(), std::align_val_t{kPlaneAlignment}));
  memory_.reset(memory);
  fill(value);
}

void BitplaneStack::fill_rows(int y0, int y1, std::uint32_t value) noexcept {
  const std::size_t whole_bytes = static_cast<std::size_t>(width_px_) / 8;
  const int rest_px = width_px_ % 8;
  for (int k = 0; k < plane_count_; ++k) {
    const std::uint8_t byte = (value >> k & 1) != 0 ? 0xff : 0;
    for (int y = y0; y < y1; ++y) {
      std::uint8_t* row = plane(k) + y * stride_bytes_;
      std::memset(row, byte, whole_bytes);
      std::memset(row + whole_bytes, 0, static_cast<std::size_t>(stride_bytes_) - whole_bytes);
      if (rest_px != 0) row[whole_bytes] = static_cast<std::uint8_t>(byte << (8 - rest_px));
    }
  }
}

std::uint32_t BitplaneStack::pixel(int x, int y) const noexcept {
  TESSERA_ASSERT(x >= 0 && x < width_px_ && y >= 0 && y < height_px_);
  const std::ptrdiff_t offset = y * stride_bytes_ + x / 8;
  std::uint32_t value = 0;
  for (int k = 0; k < plane_count_; ++k) value |= (plane(k)[offset] >> (7 - x % 8) & 1u) << k;
  return value;
}

void BitplaneStack::set_pixel(int x, int y, std::uint32_t value) noexcept {
  TESSERA_ASSERT(x >= 0 && x < width_px_ && y >= 0 && y < height_px_);
  const std::ptrdiff_t offset = y * stride_bytes_ + x / 8;
  for (int k = 0; k < plane_count_; ++k) {
    std::uint8_t& byte = plane(k)[offset];
    const int bit = 7 - x % 8;
    byte = static_cast<std::uint8_t>((byte & ~(1u << bit)) | (value >> k & 1u) << bit);
  }
}

}  // namespace tessera::detail
