#include "framebuffer/smooth_palette.h"

#include <cstddef>
#include <utility>

#include "framebuffer/k_means.h"

namespace tessera::detail {

namespace {

constexpr int kRoundsPerFrame = 8;  // k-means: the next frame continues
constexpr int kMinFineBits = 6;     // neighbouring colours of coarser converters are too far apart

}  // namespace

SmoothEntries::SmoothEntries(const PaletteShape& shape, InstructionSet isa)
    : shape_(shape), isa_(isa), converter_(shape.component_bits), uses_(converter_.size()) {}

const std::vector<Rgb8>& SmoothEntries::follow(const ColorCounts& picture) {
  if (entries_.empty()) {
    start(picture);
    return entries_;
  }
  const std::vector<Oklab> goal = goals(picture);
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i] = moved(entries_[i], goal[i]);
  return entries_;
}

void SmoothEntries::start(const ColorCounts& picture) {
  const std::vector<Rgb8> first = adaptive_palette(picture, shape_, isa_);
  for (std::size_t i = 0; i < shape_.entries; ++i) {
    entries_.push_back(first[i % first.size()]);
    ++uses_[converter_.position(converter_.levels_of(entries_.back()))];
  }
}

std::vector<Oklab> SmoothEntries::goals(const ColorCounts& picture) const {
  std::vector<WeightedColor> colors = picture.at_most(palette_color_limit(shape_.entries));
  // No entry can reach the other colours, so their errors must not attract unused entries.
  for (WeightedColor& c : colors) c.color = converter_.shown(converter_.levels_of(c.color));
  const ColorPoints points(colors);
  std::vector<Oklab> centers;
  for (const Rgb8& entry : entries_) centers.push_back(oklab_from_rgb8(entry));
  // Unused entries get their goals last: on their way they cannot serve the points that they are sent to.
  centers = k_means(points, std::move(centers), kRoundsPerFrame, isa_, UnusedCenters::keep);
  return k_means(points, std::move(centers), 1, isa_, UnusedCenters::move);
}

Rgb8 SmoothEntries::moved(Rgb8 entry, const Oklab& goal) {
  const ConverterLevels from = converter_.levels_of(entry);
  const ConverterLevels to = walk(from, goal);
  --uses_[converter_.position(from)];
  ++uses_[converter_.position(to)];
  return converter_.shown(to);
}

/// Steps to free neighbours that are nearer to the goal, as far as an entry may move.
ConverterLevels SmoothEntries::walk(const ConverterLevels& from, const Oklab& goal) const {
  const bool is_fine = converter_.bits() >= kMinFineBits;
  const Oklab start = oklab_from_rgb8(converter_.shown(from));
  const auto allowed = [&](const ConverterLevels& levels) {
    if (uses_[converter_.position(levels)] > 0) return false;
    return !is_fine || squared_distance(oklab_from_rgb8(converter_.shown(levels)), start) <=
                           kMaxEntryMove * kMaxEntryMove;
  };
  if (!is_fine) return converter_.step(from, goal, 1, allowed);
  ConverterLevels at = from;
  for (;;) {
    const ConverterLevels next = converter_.step(at, goal, 3, allowed);
    if (next == at) return at;
    at = next;
  }
}

}  // namespace tessera::detail
