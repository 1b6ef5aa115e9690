#include "framebuffer/distinct_entries.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "framebuffer/nearest_center.h"

namespace tessera::detail {

namespace {

/// Colours of a converter that are entries already, one bit each.
class TakenColors {
 public:
  explicit TakenColors(const ConverterColors& converter) : converter_(converter), taken_(converter.size()) {}
  bool contains(const ConverterLevels& levels) const { return taken_[converter_.position(levels)]; }
  /// Returns false if the colour was taken before.
  bool take(const ConverterLevels& levels) {
    const std::size_t position = converter_.position(levels);
    if (taken_[position]) return false;
    taken_[position] = true;
    return true;
  }

 private:
  const ConverterColors& converter_;
  std::vector<bool> taken_;
};

/// Squared distances of the points to their nearest entries.
std::vector<double> entry_distances(const ColorPoints& points, const std::vector<Rgb8>& entries,
                                    InstructionSet isa) {
  std::vector<Oklab> centers;
  for (const Rgb8& entry : entries) centers.push_back(oklab_from_rgb8(entry));
  NearestCenters nearest;
  nearest_centers(points, ColorPoints(std::span<const Oklab>(centers)), isa, nearest);
  return {nearest.squared_distance.begin(), nearest.squared_distance.end()};
}

/// Appends rounded colours of the picture, those with the largest errors first, up to `count` entries.
void append_worst(const ConverterColors& converter, std::size_t count,
                  const std::vector<WeightedColor>& colors, const ColorPoints& points, InstructionSet isa,
                  TakenColors& taken, std::vector<Rgb8>& entries) {
  std::vector<double> distances = entry_distances(points, entries, isa);
  while (entries.size() < count) {
    const WeightedColor* worst = nullptr;
    double worst_error = -1;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double error = points.weight[i] * distances[i];
      if (error > worst_error && !taken.contains(converter.levels_of(colors[i].color))) {
        worst_error = error;
        worst = &colors[i];
      }
    }
    if (!worst) return;
    const ConverterLevels levels = converter.levels_of(worst->color);
    taken.take(levels);
    entries.push_back(converter.shown(levels));
    const Oklab added = oklab_from_rgb8(entries.back());
    for (std::size_t i = 0; i < colors.size(); ++i)
      distances[i] = std::min(distances[i], squared_point_distance(points[i], added));
  }
}

}  // namespace

std::vector<Rgb8> distinct_entries(const ConverterColors& converter, const std::vector<Oklab>& centers,
                                   const std::vector<WeightedColor>& colors, const ColorPoints& points,
                                   InstructionSet isa) {
  TakenColors taken(converter);
  std::vector<Rgb8> entries;
  for (const Oklab& center : centers) {
    const ConverterLevels levels = converter.nearest(center);
    if (taken.take(levels)) entries.push_back(converter.shown(levels));
  }
  append_worst(converter, centers.size(), colors, points, isa, taken, entries);
  return entries;
}

std::vector<Rgb8> rounded_colors(const ConverterColors& converter, const std::vector<WeightedColor>& colors) {
  TakenColors taken(converter);
  std::vector<Rgb8> rounded;
  for (const WeightedColor& c : colors) {
    const ConverterLevels levels = converter.levels_of(c.color);
    if (taken.take(levels)) rounded.push_back(converter.shown(levels));
  }
  return rounded;
}

}  // namespace tessera::detail
