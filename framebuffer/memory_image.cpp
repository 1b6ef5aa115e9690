#include "framebuffer/memory_image.h"

#include <algorithm>

#include "framebuffer/check.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kBankBytes = 0x2000;
constexpr std::size_t kCgaBanks = 2, kHerculesBanks = 4;
constexpr std::size_t kBytePlanes = 4;

struct Extent {
  std::size_t width, height, bits;
};
Extent extent_of(const MemoryShape& shape) noexcept {
  return {static_cast<std::size_t>(shape.width), static_cast<std::size_t>(shape.height),
          static_cast<std::size_t>(shape.bits)};
}

/// Bytes of a row of packed pixels of `bits` bits.
std::size_t packed_row_bytes(const Extent& extent, std::size_t bits) noexcept {
  return (extent.width * bits + 7) / 8;
}
std::size_t pixel_bytes(const Extent& extent) noexcept { return (extent.bits + 7) / 8; }

/// Offset of row y of packed pixels in memory of `banks` banks (1: no banks).
std::size_t packed_row_offset(std::size_t y, std::size_t row_bytes, std::size_t banks) noexcept {
  return banks == 1 ? y * row_bytes : y % banks * kBankBytes + y / banks * row_bytes;
}

void write_packed(const Extent& extent, std::size_t banks, const std::uint32_t* words, std::uint8_t* memory) {
  const std::size_t row_bytes = packed_row_bytes(extent, extent.bits);
  const std::size_t per_byte = 8 / extent.bits;
  const std::uint32_t mask = (1u << extent.bits) - 1;
  for (std::size_t y = 0; y < extent.height; ++y) {
    std::uint8_t* const row = memory + packed_row_offset(y, row_bytes, banks);
    for (std::size_t x = 0; x < extent.width; ++x) {
      const std::size_t shift = 8 - extent.bits * (x % per_byte + 1);
      row[x / per_byte] |= static_cast<std::uint8_t>((words[y * extent.width + x] & mask) << shift);
    }
  }
}

void write_planes(const Extent& extent, const std::uint32_t* words, std::uint8_t* memory) {
  const std::size_t row_bytes = packed_row_bytes(extent, 1);
  for (std::size_t k = 0; k < extent.bits; ++k)
    for (std::size_t y = 0; y < extent.height; ++y) {
      std::uint8_t* const row = memory + (k * extent.height + y) * row_bytes;
      for (std::size_t x = 0; x < extent.width; ++x)
        row[x / 8] |= static_cast<std::uint8_t>((words[y * extent.width + x] >> k & 1u) << (7 - x % 8));
    }
}

void write_byte_planes(const Extent& extent, const std::uint32_t* words, std::uint8_t* memory) {
  const std::size_t row_bytes = extent.width / kBytePlanes;
  for (std::size_t y = 0; y < extent.height; ++y)
    for (std::size_t x = 0; x < extent.width; ++x)
      memory[(x % kBytePlanes * extent.height + y) * row_bytes + x / kBytePlanes] =
          static_cast<std::uint8_t>(words[y * extent.width + x]);
}

void write_bytes(const Extent& extent, ByteOrder order, const std::uint32_t* words, std::uint8_t* memory) {
  const std::size_t bytes = pixel_bytes(extent);
  const std::uint32_t mask = (1u << extent.bits) - 1;
  for (std::size_t i = 0; i < extent.width * extent.height; ++i)
    for (std::size_t k = 0; k < bytes; ++k) {
      const std::size_t at = order == ByteOrder::little ? k : bytes - 1 - k;
      memory[i * bytes + at] = static_cast<std::uint8_t>((words[i] & mask) >> (8 * k));
    }
}

}  // namespace

std::size_t memory_image_bytes(const MemoryShape& shape) noexcept {
  const Extent extent = extent_of(shape);
  switch (shape.layout) {
    case MemoryLayout::packed: return packed_row_bytes(extent, extent.bits) * extent.height;
    case MemoryLayout::cga_banks: return kCgaBanks * kBankBytes;
    case MemoryLayout::hercules_banks: return kHerculesBanks * kBankBytes;
    case MemoryLayout::planes: return packed_row_bytes(extent, 1) * extent.height * extent.bits;
    case MemoryLayout::byte_planes: return extent.width * extent.height;
    case MemoryLayout::bytes: return extent.width * extent.height * pixel_bytes(extent);
    case MemoryLayout::character_cells: return 0;
  }
  return 0;
}

void write_memory_image(const MemoryShape& shape, std::span<const std::uint32_t> words,
                        std::span<std::uint8_t> memory) noexcept {
  const Extent extent = extent_of(shape);
  TESSERA_ASSERT(words.size() == extent.width * extent.height);
  TESSERA_ASSERT(memory.size() == memory_image_bytes(shape));
  std::fill(memory.begin(), memory.end(), std::uint8_t{0});
  switch (shape.layout) {
    case MemoryLayout::packed: return write_packed(extent, 1, words.data(), memory.data());
    case MemoryLayout::cga_banks: return write_packed(extent, kCgaBanks, words.data(), memory.data());
    case MemoryLayout::hercules_banks:
      return write_packed(extent, kHerculesBanks, words.data(), memory.data());
    case MemoryLayout::planes: return write_planes(extent, words.data(), memory.data());
    case MemoryLayout::byte_planes: return write_byte_planes(extent, words.data(), memory.data());
    case MemoryLayout::bytes: return write_bytes(extent, shape.byte_order, words.data(), memory.data());
    case MemoryLayout::character_cells: TESSERA_ASSERT(false && "character cells hold no pixels");
  }
}

}  // namespace tessera::detail
