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

/// The sum of weighted rows in one vector of columns.
HWY_INLINE FloatVec sum_of(std::span<const WeightedRow> rows, int x) {
  FloatVec sum = splat(0);
  for (const WeightedRow& row : rows) sum = mul_add(load(row.light + x), splat(row.weight), sum);
  return sum;
}

HWY_INLINE FloatVec mask_at(const ImageRow& row, std::size_t color, int x) {
  FloatVec mask = splat(0);
  for (std::size_t j = 0; j < row.row_factors.size(); ++j)
    mask = mul_add(load(row.column_factors[color][j] + x), splat(row.row_factors[j]), mask);
  return hn::Max(mask, splat(0));
}

/// Light of one colour in a strip of columns.
void collect_light(const ImageRow& row, std::size_t color, int left, int columns, Strip& light) {
  const bool has_mask = !row.row_factors.empty();
  for (int x = 0; x < columns; x += kFloatLanes) {
    FloatVec sum = sum_of(row.light[color], left + x);
    if (has_mask) sum = hn::Mul(sum, mask_at(row, color, left + x));
    if (!row.scattered[color].empty()) sum = hn::Add(sum, sum_of(row.scattered[color], left + x));
    store(sum, light + x);
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

/// Red, green and blue of as many pixels as a vector has lanes.
using ByteTag = hn::Rebind<std::uint8_t, FloatTag>;
using ByteVec = hn::Vec<ByteTag>;

void store_pixels(const ByteVec (&codes)[3], int count, std::uint8_t* rgb) {
  constexpr ByteTag kBytes{};
  if (count == kFloatLanes) {
    hn::StoreInterleaved3(codes[0], codes[1], codes[2], kBytes, rgb);
    return;
  }
  alignas(64) std::uint8_t lanes[3 * kFloatLanes];
  hn::StoreInterleaved3(codes[0], codes[1], codes[2], kBytes, lanes);
  std::copy_n(lanes, 3 * count, rgb);
}

void store_light(const FloatVec (&light)[3], int count, float* out) {
  alignas(64) float lanes[3][kFloatLanes];
  for (int i = 0; i < 3; ++i) hn::Store(light[i], kFloats, lanes[i]);
  for (int lane = 0; lane < count; ++lane)
    for (int i = 0; i < 3; ++i) *out++ = lanes[i][lane];
}

/// Writes light of the display as pixels.
void write_pixels(const ImageRow& row, const Strip (&light)[3], int left, int columns) {
  const SrgbTable& table = srgb_table();
  for (int x = 0; x < columns; x += kFloatLanes) {
    const int count = std::min(kFloatLanes, columns - x);
    FloatVec components[3];
    ByteVec codes[3];
    for (std::size_t i = 0; i < 3; ++i) {
      FloatVec sum = hn::Mul(load(light[0] + x), splat(row.srgb_from_light[i][0]));
      for (std::size_t color = 1; color < static_cast<std::size_t>(row.colors); ++color)
        sum = mul_add(load(light[color] + x), splat(row.srgb_from_light[i][color]), sum);
      components[i] = sum;
      codes[i] = hn::DemoteTo(ByteTag(), srgb_codes(table, sum));
    }
    const std::ptrdiff_t offset = 3 * static_cast<std::ptrdiff_t>(left + x);
    if (row.light_out != nullptr) store_light(components, count, row.light_out + offset);
    if (row.rgb != nullptr) store_pixels(codes, count, row.rgb + offset);
  }
}

void image_row(const ImageRow& row) {
  alignas(64) Strip light[3];
  for (int left = 0; left < row.columns; left += kStripColumns) {
    const int columns = std::min(kStripColumns, row.columns - left);
    const int lanes = padded(columns);
    for (std::size_t color = 0; color < static_cast<std::size_t>(row.colors); ++color)
      collect_light(row, color, left, lanes, light[color]);
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
