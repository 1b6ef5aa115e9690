// One rule covers every RGB layout: extract a component from the packed pixel, scale it to 0 .. 255 in fixed
// point, insert it in its byte. Luminance is an RGB layout whose three components are the same bits.
#include "framebuffer/scan_out.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/scan_out.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "framebuffer/check.h"
#include "framebuffer/prefetch_lines.h"
#include "framebuffer/tile_grid.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using PackedTag = hn::ScalableTag<std::uint32_t>;
using PackedVec = hn::Vec<PackedTag>;

static_assert(std::endian::native == std::endian::little);  // first byte of a pixel: lowest of its 32 bits

/// RGB or luminance layout without alpha.
struct ComponentPixels {
  ScanOutRule rule;

  PackedVec operator()(PackedTag d, PackedVec packed_pixels) const noexcept {
    auto pixels = hn::Set(d, 0xff000000u);
    for (const ScanOutRule::Component& c : rule.components) {
      const auto level = hn::And(hn::ShiftRightSame(packed_pixels, c.shift), hn::Set(d, c.mask));
      const auto shown =
          hn::ShiftRight<16>(hn::Add(hn::Mul(level, hn::Set(d, c.scale)), hn::Set(d, 1u << 15)));
      pixels = hn::Or(pixels, hn::ShiftLeftSame(shown, c.byte_shift));
    }
    return pixels;
  }
};

/// RGB or luminance layout with stored alpha.
struct AlphaPixels {
  ScanOutRule rule;

  PackedVec operator()(PackedTag d, PackedVec packed_pixels) const noexcept {
    const auto top = hn::Set(d, 0xff000000u);
    return hn::Or(hn::AndNot(top, ComponentPixels{rule}(d, packed_pixels)),
                  hn::And(hn::ShiftLeftSame(packed_pixels, rule.alpha_shift), top));
  }
};

/// 24-bit RGB to bgra8: the stored byte order; only alpha is set.
struct BlueFirstPixels {
  PackedVec operator()(PackedTag d, PackedVec packed_pixels) const noexcept {
    return hn::Or(packed_pixels, hn::Set(d, 0xff000000u));
  }
};
/// 24-bit RGB to rgba8: red and blue exchanged.
struct RedFirstPixels {
  PackedVec operator()(PackedTag d, PackedVec packed_pixels) const noexcept {
#if HWY_TARGET == HWY_SCALAR
    const auto red = hn::And(hn::ShiftRight<16>(packed_pixels), hn::Set(d, 0xffu));
    const auto green = hn::And(packed_pixels, hn::Set(d, 0xff00u));
    const auto blue = hn::ShiftLeft<16>(hn::And(packed_pixels, hn::Set(d, 0xffu)));
    return hn::Or(hn::Or(red, blue), hn::Or(green, hn::Set(d, 0xff000000u)));
#else
    const hn::Repartition<std::uint8_t, PackedTag> bytes;
    alignas(16) static constexpr std::uint8_t kRedFirst[16] = {2,  1, 0, 3,  6,  5,  4,  7,
                                                               10, 9, 8, 11, 14, 13, 12, 15};
    const auto exchanged =
        hn::TableLookupBytes(hn::BitCast(bytes, packed_pixels), hn::LoadDup128(bytes, kRedFirst));
    return hn::Or(hn::BitCast(d, exchanged), hn::Set(d, 0xff000000u));
#endif
  }
};

/// Palette lookup.
struct IndexPixels {
  const std::uint32_t* pixels;
  std::uint32_t mask, last;

  PackedVec operator()(PackedTag d, PackedVec packed_pixels) const noexcept {
    const auto index = hn::Min(hn::And(packed_pixels, hn::Set(d, mask)), hn::Set(d, last));
    return hn::GatherIndex(d, pixels, hn::BitCast(hn::RebindToSigned<PackedTag>(), index));
  }
};

/// Loads one vector of a row of pixels. Groups of 4 pixels are kStep apart.
template <int kStep>
HWY_INLINE PackedVec load_pixels(PackedTag d, const std::uint32_t* packed_pixels) noexcept {
#if HWY_TARGET == HWY_SCALAR
  return hn::Load(d, packed_pixels);
#else
  if constexpr (kStep == kBlockSize || HWY_LANES(std::uint32_t) <= kBlockSize) {
    return hn::LoadU(d, packed_pixels);
  } else {
    const hn::Half<PackedTag> half;
    if constexpr (HWY_LANES(std::uint32_t) == 2 * kBlockSize) {
      return hn::Combine(d, hn::LoadU(half, packed_pixels + kStep), hn::LoadU(half, packed_pixels));
    } else {
      const hn::Half<hn::Half<PackedTag>> quarter;
      return hn::Combine(
          d,
          hn::Combine(half, hn::LoadU(quarter, packed_pixels + 3 * kStep),
                      hn::LoadU(quarter, packed_pixels + 2 * kStep)),
          hn::Combine(half, hn::LoadU(quarter, packed_pixels + kStep), hn::LoadU(quarter, packed_pixels)));
    }
  }
#endif
}

/// Stores pixels at an address of any alignment.
HWY_INLINE void store_pixels(PackedVec pixels, std::uint8_t* to) noexcept {
#if HWY_TARGET == HWY_SCALAR
  const std::uint32_t pixel = hn::GetLane(pixels);
  std::memcpy(to, &pixel, sizeof pixel);
#else
  const hn::Repartition<std::uint8_t, PackedTag> bytes;
  hn::StoreU(hn::BitCast(bytes, pixels), bytes, to);
#endif
}

/// Converts one row. Groups of 4 pixels are kStep apart: kBlockPixels in a tile, kBlockSize in a plain row.
template <int kStep, class Pixels>
HWY_INLINE void scan_out_row_with(const Pixels& pixels, const std::uint32_t* packed_pixels, int width_px,
                                  std::uint8_t* row) noexcept {
  const PackedTag d;
  constexpr int kLanes = static_cast<int>(HWY_LANES(std::uint32_t));
  constexpr int kUnit = std::max(kLanes, kBlockSize);  // pixels per iteration
  int x = 0;
  for (; x + kUnit <= width_px; x += kUnit, packed_pixels += kUnit / kBlockSize * kStep, row += 4 * kUnit)
    for (int i = 0; i < kUnit; i += kLanes)
      store_pixels(pixels(d, load_pixels<kStep>(d, packed_pixels + i)), row + 4 * i);
  // The remainder goes through a buffer: neither pixels beyond the last one nor bytes beyond the row are
  // touched.
  const int rest_px = width_px - x;
  if (rest_px <= 0) return;
  HWY_ALIGN std::uint32_t rest[kUnit] = {};
  for (int i = 0; i < rest_px; ++i) rest[i] = packed_pixels[i / kBlockSize * kStep + i % kBlockSize];
  for (int i = 0; i < kUnit; i += kLanes) hn::Store(pixels(d, hn::Load(d, rest + i)), d, rest + i);
  std::memcpy(row, rest, static_cast<std::size_t>(rest_px) * sizeof rest[0]);
}

#if HWY_TARGET == HWY_AVX3
/// Converts four rows, four blocks at a time. The rows of a block are the quarters of a vector; four blocks
/// exchange quarters to form 16 pixels of each row.
template <class Pixels>
HWY_INLINE void scan_out_block_row_with(const Pixels& pixels, const std::uint32_t* packed_pixels,
                                        int width_px, std::uint8_t* first_row,
                                        std::ptrdiff_t stride_bytes) noexcept {
  const PackedTag d;
  constexpr int kUnit = 4 * kBlockSize;
  int x = 0;
  for (; x + kUnit <= width_px; x += kUnit) {
    const auto block = [&](int i) HWY_ATTR {
      return pixels(d, hn::Load(d, packed_pixels + (x / kBlockSize + i) * kBlockPixels)).raw;
    };
    const __m512i b0 = block(0), b1 = block(1), b2 = block(2), b3 = block(3);
    // upper01: rows 0 1 of block 0, rows 0 1 of block 1. lower01: rows 2 3 of both.
    const __m512i upper01 = _mm512_shuffle_i64x2(b0, b1, _MM_SHUFFLE(1, 0, 1, 0));
    const __m512i upper23 = _mm512_shuffle_i64x2(b2, b3, _MM_SHUFFLE(1, 0, 1, 0));
    const __m512i lower01 = _mm512_shuffle_i64x2(b0, b1, _MM_SHUFFLE(3, 2, 3, 2));
    const __m512i lower23 = _mm512_shuffle_i64x2(b2, b3, _MM_SHUFFLE(3, 2, 3, 2));
    const auto store = [&](__m512i row, int y) HWY_ATTR {
      store_pixels(PackedVec{row}, first_row + y * stride_bytes + std::ptrdiff_t{4} * x);
    };
    store(_mm512_shuffle_i64x2(upper01, upper23, _MM_SHUFFLE(2, 0, 2, 0)), 0);
    store(_mm512_shuffle_i64x2(upper01, upper23, _MM_SHUFFLE(3, 1, 3, 1)), 1);
    store(_mm512_shuffle_i64x2(lower01, lower23, _MM_SHUFFLE(2, 0, 2, 0)), 2);
    store(_mm512_shuffle_i64x2(lower01, lower23, _MM_SHUFFLE(3, 1, 3, 1)), 3);
  }
  if (x == width_px) return;
  for (int y = 0; y < kBlockSize; ++y)
    scan_out_row_with<kBlockPixels>(pixels, packed_pixels + x * kBlockSize + y * kBlockSize, width_px - x,
                                    first_row + y * stride_bytes + std::ptrdiff_t{4} * x);
}
#endif

template <class Pixels>
HWY_INLINE void scan_out_tile_with(const Pixels& pixels, const std::uint32_t* tile, int tile_size,
                                   int width_px, int height_px, std::uint8_t* first_row,
                                   std::ptrdiff_t stride_bytes) noexcept {
  // Prefetch the next four rows while four are written. Never rows of other tiles: other cores may be writing
  // those.
  const auto prefetch = [&](int y) HWY_ATTR {
    if (y < height_px)
      prefetch_lines(first_row + y * stride_bytes, stride_bytes, 4 * width_px,
                     std::min(kBlockSize, height_px - y));
  };
  prefetch(0);
  for (int y = 0; y < height_px; y += kBlockSize) {
    prefetch(y + kBlockSize);
    const std::uint32_t* const packed_pixels = tile + tile_index(0, y, tile_size);
    std::uint8_t* const to = first_row + y * stride_bytes;
#if HWY_TARGET == HWY_AVX3
    if (y + kBlockSize <= height_px) {
      scan_out_block_row_with(pixels, packed_pixels, width_px, to, stride_bytes);
      continue;
    }
#endif
    for (int row = 0; row < std::min(kBlockSize, height_px - y); ++row)
      scan_out_row_with<kBlockPixels>(pixels, packed_pixels + row * kBlockSize, width_px,
                                      to + row * stride_bytes);
  }
}

/// Calls `scan` with the converter that implements the rule.
template <class Scan>
HWY_INLINE void with_pixels(const ScanOutRule& rule, const Scan& scan) noexcept {
  if (rule.index) return scan(IndexPixels{rule.pixels, rule.index_mask, rule.last_index});
  if (rule.alpha_shift >= 0) return scan(AlphaPixels{rule});
  const auto& [r, g, b] = rule.components;
  const bool has_byte_masks = (r.mask & g.mask & b.mask) == 255;
  const bool is_rgb8 = has_byte_masks && r.shift == 16 && g.shift == 8 && b.shift == 0;
  if (is_rgb8 && b.byte_shift == 0) return scan(BlueFirstPixels{});
  if (is_rgb8) return scan(RedFirstPixels{});
  scan(ComponentPixels{rule});
}

}  // namespace

void scan_out_tile(const ScanOutRule& rule, const std::uint32_t* tile, int tile_size, int width_px,
                   int height_px, std::uint8_t* first_row, std::ptrdiff_t stride_bytes) noexcept {
  TESSERA_ASSERT(width_px >= 0 && width_px <= tile_size && height_px >= 0 && height_px <= tile_size);
  with_pixels(rule, [&](const auto& pixels) HWY_ATTR {
    scan_out_tile_with(pixels, tile, tile_size, width_px, height_px, first_row, stride_bytes);
  });
}

void scan_out_row(const ScanOutRule& rule, const std::uint32_t* packed_pixels, int width_px,
                  std::uint8_t* row) noexcept {
  TESSERA_ASSERT(width_px >= 0);
  with_pixels(rule, [&](const auto& pixels)
                        HWY_ATTR { scan_out_row_with<kBlockSize>(pixels, packed_pixels, width_px, row); });
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

static ScanOutRule::Component component_rule(std::uint32_t mask, int shift, int byte_shift) {
  // Rounding is exact: mask is odd, so 255 v / mask is at least 1 / (2 mask) away from a half. v times the
  // rounding error of the scale is below 1 / 512 for mask < 255, and 0 for mask = 255.
  return {.shift = shift, .mask = mask, .scale = ((255u << 16) + mask / 2) / mask, .byte_shift = byte_shift};
}

ScanOut::ScanOut(const ColorLayout& layout, const Palette* palette, PixelOrder order,
                 [[maybe_unused]] InstructionSet isa)
    : tile_fn_(TESSERA_KERNEL(isa, scan_out_tile)), row_fn_(TESSERA_KERNEL(isa, scan_out_row)) {
  set(layout, palette, order);
}

void ScanOut::set(const ColorLayout& layout, const Palette* palette, PixelOrder order) {
  rule_ = {};
  pixels_.clear();
  const int r_byte = order == PixelOrder::rgba8 ? 0 : 16, b_byte = 16 - r_byte;
  if (layout.alpha_bits == 8) rule_.alpha_shift = 24 - layout.bits;
  if (layout.index) {
    TESSERA_ASSERT(palette != nullptr && palette->bits == layout.bits &&
                   palette->entries.size() <= palette->size());
    const std::size_t given = palette->entries.size();
    pixels_.reserve(given + 1);
    for (Rgb8 c : palette->entries)
      pixels_.push_back(std::uint32_t{c.r} << r_byte | std::uint32_t{c.g} << 8 |
                        std::uint32_t{c.b} << b_byte | 0xff000000u);
    pixels_.push_back(0xff000000u);  // black, for unset entries
    rule_.index = true;
    rule_.index_mask = layout.value_mask();
    rule_.last_index = static_cast<std::uint32_t>(given);
    rule_.pixels = pixels_.data();
  } else if (layout.luminance) {
    rule_.components = {component_rule(layout.value_mask(), 0, r_byte),
                        component_rule(layout.value_mask(), 0, 8),
                        component_rule(layout.value_mask(), 0, b_byte)};
  } else {
    rule_.components = {component_rule((1u << layout.r_bits) - 1, layout.r_shift(), r_byte),
                        component_rule((1u << layout.g_bits) - 1, layout.g_shift(), 8),
                        component_rule((1u << layout.b_bits) - 1, 0, b_byte)};
  }
}

}  // namespace tessera::detail
#endif
