#include "framebuffer/palette_mixes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "framebuffer/check.h"
#include "framebuffer/format.h"

namespace tessera::detail {
namespace {

constexpr int kCacheBits = 16;
constexpr std::uint64_t kIsSet = std::uint64_t{1} << 63;

std::uint32_t word_of(Rgb8 c) { return std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b; }
/// Fibonacci hashing.
std::size_t slot_of(std::uint32_t word) { return word * 2654435769u >> (32 - kCacheBits); }

}  // namespace

PaletteMixes::PaletteMixes(const Palette& palette, const std::optional<LightCurve>& light, int steps,
                           std::size_t reach)
    : steps_(static_cast<float>(steps)),
      reach_(reach),
      cache_(std::make_unique<std::atomic<std::uint64_t>[]>(std::size_t{1} << kCacheBits)) {
  TESSERA_ASSERT(palette.entries.size() <= kMaxMixedEntries);
  for (int level = 0; level < 256; ++level)
    values_.push_back(static_cast<float>(light ? light->light(level / 255.0) : level / 255.0));
  for (std::size_t level = 0; level < 256; ++level)
    half_levels_.push_back((values_[std::min<std::size_t>(level + 1, 255)] - values_[level - (level > 0)]) /
                           (level == 0 || level == 255 ? 2.0f : 4.0f));
  for (std::size_t i = 0; i < palette.entries.size(); ++i) {
    const Rgb8 c = palette.entries[i];
    const bool is_new =
        std::find(palette.entries.begin(), palette.entries.begin() + static_cast<std::ptrdiff_t>(i), c) ==
        palette.entries.begin() + static_cast<std::ptrdiff_t>(i);
    if (is_new)
      entries_.push_back({{values_[c.r], values_[c.g], values_[c.b]}, static_cast<std::uint8_t>(i)});
  }
  if (entries_.empty()) entries_.push_back({});
  std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.value.r + a.value.g + a.value.b < b.value.r + b.value.g + b.value.b;
  });
  for (std::size_t j = 0; j < entries_.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Vector &a = entries_[i].value, &b = entries_[j].value;
      const Vector difference{b.r - a.r, b.g - a.g, b.b - a.b};
      const float square = difference.dot(difference);
      pairs_.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), difference,
                        std::sqrt(square), 1 / square});
    }
  std::sort(pairs_.begin(), pairs_.end(), [this](const Pair& a, const Pair& b) {
    return std::tuple(a.length, entries_[a.first].index, entries_[a.second].index) <
           std::tuple(b.length, entries_[b.first].index, entries_[b.second].index);
  });
}

/// Distance of the last entry that is mixed. @param distances  of all entries
float PaletteMixes::reach_radius(const float* distances) const {
  if (reach_ >= entries_.size()) return std::numeric_limits<float>::max();
  float sorted[kMaxMixedEntries];
  std::copy_n(distances, entries_.size(), sorted);
  std::nth_element(sorted, sorted + reach_ - 1, sorted + entries_.size());
  return sorted[reach_ - 1];
}

PaletteMix PaletteMixes::search(Rgb8 color) const {
  const Vector wanted{values_[color.r], values_[color.g], values_[color.b]};
  float distances[kMaxMixedEntries];
  float best_square = std::numeric_limits<float>::max();
  PaletteMix best;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Vector& v = entries_[i].value;
    const Vector error{wanted.r - v.r, wanted.g - v.g, wanted.b - v.b};
    const float square = error.dot(error);
    distances[i] = std::sqrt(square);
    if (square < best_square) {
      best_square = square;
      best = {entries_[i].index, entries_[i].index, 0};
    }
  }
  if (best_square == 0) return best;
  float best_distance = std::sqrt(best_square);
  const float radius = reach_radius(distances);
  for (const Pair& pair : pairs_) {
    if (pair.length > 2 * radius) break;  // not both of its entries lie within the radius
    if (std::max(distances[pair.first], distances[pair.second]) > radius) continue;
    // A mix lies within the pair's length of its first entry.
    if (distances[pair.first] - pair.length >= best_distance) continue;
    const Vector& from = entries_[pair.first].value;
    const Vector& e = pair.difference;
    const Vector offset{wanted.r - from.r, wanted.g - from.g, wanted.b - from.b};
    const float place = std::clamp(offset.dot(e) * pair.inverse_square, 0.0f, 1.0f);
    const int share = static_cast<int>(place * steps_ + 0.5f);
    const float t = static_cast<float>(share) / steps_;
    const Vector error{offset.r - t * e.r, offset.g - t * e.g, offset.b - t * e.b};
    const PaletteMix mix{entries_[pair.first].index, entries_[pair.second].index,
                         static_cast<std::uint16_t>(share)};
    if (std::abs(error.r) <= half_levels_[color.r] && std::abs(error.g) <= half_levels_[color.g] &&
        std::abs(error.b) <= half_levels_[color.b])
      return mix;
    const float square = error.dot(error);
    if (square >= best_square) continue;
    best_square = square;
    best_distance = std::sqrt(square);
    best = mix;
  }
  return best;
}

PaletteMix PaletteMixes::nearest(Rgb8 color) const {
  const std::uint32_t word = word_of(color);
  std::atomic<std::uint64_t>& slot = cache_[slot_of(word)];
  const std::uint64_t key = kIsSet | std::uint64_t{word} << 32;
  constexpr std::uint64_t kKeyMask = ~std::uint64_t{0xffffffff};
  if (const std::uint64_t cached = slot.load(std::memory_order_relaxed); (cached & kKeyMask) == key)
    return {static_cast<std::uint8_t>(cached >> 8), static_cast<std::uint8_t>(cached),
            static_cast<std::uint16_t>(cached >> 16)};
  const PaletteMix mix = search(color);
  slot.store(key | std::uint64_t{mix.share} << 16 | std::uint64_t{mix.first} << 8 | mix.second,
             std::memory_order_relaxed);
  return mix;
}

std::uint32_t PaletteMixes::entry(float r, float g, float b, float threshold) const {
  const PaletteMix mix = nearest(quantize_rgb8(r, g, b));
  return static_cast<int>(threshold * steps_) < mix.share ? mix.second : mix.first;
}

}  // namespace tessera::detail
