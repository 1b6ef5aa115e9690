#include "framebuffer/display/image_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "framebuffer/display/image_rows.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "framebuffer/display/display_lanes-inl.h"
#include "framebuffer/display/srgb_table.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {
namespace {

constexpr int kStripColumns = 256;  ///< columns that are processed together, in the first-level cache

using Strip = float[kStripColumns];

/// Number of columns to compute: whole vectors.
int padded(int columns) { return (columns + kFloatLanes - 1) / kFloatLanes * kFloatLanes; }

void add_rows(std::span<const WeightedRow> rows, int left, int columns, Strip& sum) {
  for (const WeightedRow& row : rows) {
    const FloatVec weight = splat(row.weight);
    for (int x = 0; x < columns; x += kFloatLanes)
      store(mul_add(load(row.light + left + x), weight, load(sum + x)), sum + x);
  }
}

void multiply_by_mask(const ImageRow& row, std::size_t color, int left, int columns, Strip& light) {
  for (int x = 0; x < columns; x += kFloatLanes) {
    FloatVec mask = splat(0);
    for (std::size_t j = 0; j < row.row_factors.size(); ++j)
      mask = mul_add(load(row.column_factors[color][j] + left + x), splat(row.row_factors[j]), mask);
    store(hn::Mul(load(light + x), hn::Max(mask, splat(0))), light + x);
  }
}

HWY_INLINE IntVec srgb_codes(const SrgbTable& table, FloatVec light) {
  const FloatVec inside = hn::Min(hn::Max(light, splat(SrgbTable::kMin)), splat(SrgbTable::kMax));
  const IntVec segment = hn::Sub(hn::ShiftRight<SrgbTable::kShift>(hn::BitCast(kInts, inside)),
                                 hn::Set(kInts, SrgbTable::kFirstSegment));
  const FloatVec slope = hn::GatherIndex(kFloats, table.slope.data(), segment);
  const FloatVec offset = hn::GatherIndex(kFloats, table.offset.data(), segment);
  return hn::ConvertTo(kInts, mul_add(slope, inside, offset));
}

/// Writes light of the display as pixels. Lanes beyond the row are not stored.
void write_pixels(const ImageRow& row, const Strip (&light)[3], int left, int columns) {
  const SrgbTable& table = srgb_table();
  alignas(64) float components[3][kFloatLanes];
  alignas(64) std::int32_t codes[3][kFloatLanes];
  for (int x = 0; x < columns; x += kFloatLanes) {
    for (std::size_t i = 0; i < 3; ++i) {
      FloatVec sum = hn::Mul(load(light[0] + x), splat(row.srgb_from_light[i][0]));
      for (std::size_t color = 1; color < static_cast<std::size_t>(row.colors); ++color)
        sum = mul_add(load(light[color] + x), splat(row.srgb_from_light[i][color]), sum);
      hn::Store(sum, kFloats, components[i]);
      hn::Store(srgb_codes(table, sum), kInts, codes[i]);
    }
    const int count = std::min(kFloatLanes, columns - x);
    if (row.light_out != nullptr) {
      float* out = row.light_out + 3 * static_cast<std::ptrdiff_t>(left + x);
      for (int lane = 0; lane < count; ++lane)
        for (std::size_t i = 0; i < 3; ++i) *out++ = components[i][lane];
    }
    if (row.rgb != nullptr) {
      std::uint8_t* out = row.rgb + 3 * static_cast<std::ptrdiff_t>(left + x);
      for (int lane = 0; lane < count; ++lane)
        for (std::size_t i = 0; i < 3; ++i) *out++ = static_cast<std::uint8_t>(codes[i][lane]);
    }
  }
}

void image_row(const ImageRow& row) {
  alignas(64) Strip light[3];
  for (int left = 0; left < row.columns; left += kStripColumns) {
    const int columns = std::min(kStripColumns, row.columns - left);
    const int lanes = padded(columns);
    for (std::size_t color = 0; color < static_cast<std::size_t>(row.colors); ++color) {
      std::fill_n(light[color], lanes, 0.0f);
      add_rows(row.light[color], left, lanes, light[color]);
      if (!row.row_factors.empty()) multiply_by_mask(row, color, left, lanes, light[color]);
      add_rows(row.scattered[color], left, lanes, light[color]);
    }
    write_pixels(row, light, left, columns);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {

ImageRowFn* image_row_for(InstructionSet isa) { return TESSERA_KERNEL(isa, image_row); }

std::uint8_t srgb_code(float light) {
  const SrgbTable& table = srgb_table();
  const float inside = std::min(std::max(light, SrgbTable::kMin), SrgbTable::kMax);
  const auto segment = static_cast<std::size_t>((std::bit_cast<std::int32_t>(inside) >> SrgbTable::kShift) -
                                                SrgbTable::kFirstSegment);
  return static_cast<std::uint8_t>(std::fma(table.slope[segment], inside, table.offset[segment]));
}

}  // namespace tessera::detail
#endif
