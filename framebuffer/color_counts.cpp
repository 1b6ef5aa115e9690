#include "framebuffer/color_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <utility>

namespace tessera::detail {

namespace {

using Count = ColorCounts::Count;

constexpr int kComponentBits = 8;

/// Bit i of the index is bit 3i of the entry.
constexpr auto kSpread = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t v = 0; v < 256; ++v)
    for (int i = 0; i < kComponentBits; ++i) table[v] |= (v >> i & 1) << (3 * i);
  return table;
}();

constexpr std::uint32_t position_of(std::uint32_t word) {
  return kSpread[word >> 16 & 255] << 2 | kSpread[word >> 8 & 255] << 1 | kSpread[word & 255];
}

constexpr std::uint8_t component_at(std::uint32_t position, int shift) {
  std::uint32_t v = 0;
  for (int i = 0; i < kComponentBits; ++i) v |= (position >> (3 * i + shift) & 1) << i;
  return static_cast<std::uint8_t>(v);
}
constexpr Rgb8 color_at(std::uint32_t position) {
  return {component_at(position, 2), component_at(position, 1), component_at(position, 0)};
}

/// Runs of equal pixels in the order of the picture.
std::vector<Count> runs_of(std::span<const std::uint32_t> words) {
  std::vector<Count> runs;
  for (std::size_t i = 0; i < words.size();) {
    const std::uint32_t color = words[i] & 0xffffff;
    std::size_t end = i + 1;
    while (end < words.size() && (words[end] & 0xffffff) == color) ++end;
    runs.push_back({position_of(color), end - i});
    i = end;
  }
  return runs;
}

/// Radix sort by position, 8 of 24 bits a pass.
void sort_by_position(std::vector<Count>& counts) {
  std::vector<Count> sorted(counts.size());
  for (int shift = 0; shift < 3 * kComponentBits; shift += 8) {
    std::array<std::size_t, 257> begin{};
    for (const Count& c : counts) ++begin[(c.position >> shift & 255) + 1];
    for (std::size_t digit = 1; digit < begin.size(); ++digit) begin[digit] += begin[digit - 1];
    for (const Count& c : counts) sorted[begin[c.position >> shift & 255]++] = c;
    counts.swap(sorted);
  }
}

/// Adds up neighbours of the same position.
void merge_equal(std::vector<Count>& counts) {
  std::size_t last = 0;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    if (counts[i].position == counts[last].position) counts[last].pixels += counts[i].pixels;
    else counts[++last] = counts[i];
  }
  if (!counts.empty()) counts.resize(last + 1);
}

/// Bits to drop from positions so that at most `max_cells` cells remain; a multiple of 3.
int dropped_bits(const std::vector<Count>& counts, std::size_t max_cells) {
  std::array<std::size_t, 25> first_difference{};  // pairs of neighbours by the width of their difference
  for (std::size_t i = 1; i < counts.size(); ++i)
    ++first_difference[static_cast<std::size_t>(std::bit_width(counts[i].position ^ counts[i - 1].position))];
  std::size_t cells = counts.size();
  int bits = 0;
  for (; cells > max_cells; bits += 3)
    for (int i = 1; i <= 3; ++i) cells -= first_difference[static_cast<std::size_t>(bits + i)];
  return bits;
}

/// Rounded mean colour of a range.
WeightedColor mean_color(std::span<const Count> counts) {
  std::uint64_t r = 0, g = 0, b = 0, pixels = 0;
  for (const Count& c : counts) {
    const Rgb8 color = color_at(c.position);
    r += color.r * c.pixels;
    g += color.g * c.pixels;
    b += color.b * c.pixels;
    pixels += c.pixels;
  }
  const auto mean = [pixels](std::uint64_t sum) {
    return static_cast<std::uint8_t>((2 * sum + pixels) / (2 * pixels));
  };
  return {{mean(r), mean(g), mean(b)}, pixels};
}

}  // namespace

void ColorCounts::add(std::span<const std::uint32_t> words) {
  std::vector<Count> counts = runs_of(words);
  sort_by_position(counts);
  merge_equal(counts);
  if (counts_.empty()) {
    counts_ = std::move(counts);
    return;
  }
  std::vector<Count> merged;
  merged.reserve(counts_.size() + counts.size());
  std::merge(counts_.begin(), counts_.end(), counts.begin(), counts.end(), std::back_inserter(merged),
             [](const Count& a, const Count& b) { return a.position < b.position; });
  merge_equal(merged);
  counts_ = std::move(merged);
}

std::vector<WeightedColor> ColorCounts::all() const {
  std::vector<WeightedColor> colors;
  colors.reserve(counts_.size());
  for (const Count& c : counts_) colors.push_back({color_at(c.position), c.pixels});
  return colors;
}

std::vector<WeightedColor> ColorCounts::at_most(std::size_t max_colors) const {
  TESSERA_ASSERT(max_colors >= 8);
  if (counts_.size() <= max_colors) return all();
  const int dropped = dropped_bits(counts_, max_colors);
  std::vector<WeightedColor> colors;
  for (std::size_t i = 0; i < counts_.size();) {
    std::size_t end = i + 1;
    while (end < counts_.size() && counts_[end].position >> dropped == counts_[i].position >> dropped) ++end;
    colors.push_back(mean_color(std::span(counts_).subspan(i, end - i)));
    i = end;
  }
  return colors;
}

}  // namespace tessera::detail
