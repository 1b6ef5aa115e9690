#include "framebuffer/adaptive_palette.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "framebuffer/converter_colors.h"
#include "framebuffer/distinct_entries.h"
#include "framebuffer/extreme_colors.h"
#include "framebuffer/k_means.h"
#include "framebuffer/median_cut.h"

namespace tessera::detail {

namespace {

constexpr int kMaxRounds = 12;  // k-means: later rounds change little

void sort_by_lightness(std::vector<Rgb8>& entries) {
  const auto key = [](Rgb8 c) { return std::tuple(oklab_from_rgb8(c).l, c.g, c.r, c.b); };
  std::sort(entries.begin(), entries.end(), [&](Rgb8 x, Rgb8 y) { return key(x) < key(y); });
}

std::vector<Oklab> oklab_entries(const std::vector<Rgb8>& entries) {
  std::vector<Oklab> colors;
  colors.reserve(entries.size());
  for (const Rgb8& entry : entries) colors.push_back(oklab_from_rgb8(entry));
  return colors;
}

/// Chooses palettes of a picture that has more colours than entries.
class PaletteChoice {
 public:
  PaletteChoice(const ColorCounts& picture, const PaletteShape& shape, InstructionSet isa)
      : converter_(shape.component_bits),
        count_(shape.entries),
        isa_(isa),
        colors_(picture.at_most(palette_color_limit(shape.entries))),
        points_(colors_),
        rounded_(rounded_colors(converter_, picture.all())) {}

  /// Whether each colour of the rounded picture can have its entry.
  bool has_few_colors() const { return rounded_.size() <= count_; }
  const std::vector<Rgb8>& rounded() const { return rounded_; }

  std::vector<Oklab> cut() const { return median_cut(points_, count_); }
  std::vector<Oklab> improved(std::vector<Oklab> centers) const {
    centers = k_means(points_, std::move(centers), kMaxRounds, isa_);
    keep_extremes(points_, isa_, centers);
    return centers;
  }
  std::vector<Rgb8> entries_at(const std::vector<Oklab>& centers) const {
    std::vector<Rgb8> entries = distinct_entries(converter_, centers, colors_, points_, isa_);
    for (std::size_t i = 0; i < rounded_.size() && entries.size() < count_; ++i)
      if (std::find(entries.begin(), entries.end(), rounded_[i]) == entries.end())
        entries.push_back(rounded_[i]);
    return entries;
  }
  double error(const std::vector<Rgb8>& entries) const {
    return clustering_error(points_, oklab_entries(entries), isa_);
  }

 private:
  ConverterColors converter_;
  std::size_t count_;
  InstructionSet isa_;
  std::vector<WeightedColor> colors_;
  ColorPoints points_;
  std::vector<Rgb8> rounded_;  ///< colours of the picture on the converter
};

}  // namespace

std::size_t palette_color_limit(std::size_t entries) noexcept {
  return std::max<std::size_t>(16384, 4 * entries);
}

std::vector<Rgb8> adaptive_palette(const ColorCounts& picture, const PaletteShape& shape,
                                   InstructionSet isa) {
  const PaletteChoice choice(picture, shape, isa);
  std::vector<Rgb8> entries = choice.rounded();
  if (!choice.has_few_colors()) {
    const std::vector<Oklab> cut = choice.cut();
    entries = choice.entries_at(choice.improved(cut));
    // Rounding and extremes can undo what k-means gained.
    std::vector<Rgb8> cut_entries = choice.entries_at(cut);
    if (choice.error(cut_entries) < choice.error(entries)) entries = std::move(cut_entries);
  }
  sort_by_lightness(entries);
  return entries;
}

}  // namespace tessera::detail
