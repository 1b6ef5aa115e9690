#include "framebuffer/palette_search.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tessera::detail {

namespace {

constexpr float kMaxSquaredDistance = 16;  // exceeds the squared diagonal of the searched cube, 12

// NaN becomes 0.
float clamp_component(float c) noexcept {
  const float at_least_zero = c > 0.0f ? c : 0.0f;
  return at_least_zero < 1.0f ? at_least_zero : 1.0f;
}
double square(double d) noexcept { return d * d; }

struct DistinctColor {
  Rgb8 color;
  std::uint32_t index = 0;  ///< lowest index of this colour
};

/// The distinct colours of the set entries, ordered by index. An empty palette yields black.
std::vector<DistinctColor> distinct_colors(const Palette& palette) {
  std::vector<DistinctColor> colors;
  colors.reserve(palette.entries.size() + 1);
  for (std::size_t i = 0; i < palette.entries.size(); ++i)
    colors.push_back({palette.entries[i], static_cast<std::uint32_t>(i)});
  if (colors.empty()) colors.push_back({});
  const auto key = [](const DistinctColor& c) {
    return (std::uint64_t{c.color.r} << 16 | std::uint64_t{c.color.g} << 8 | c.color.b) << 32 | c.index;
  };
  std::sort(colors.begin(), colors.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  colors.erase(std::unique(colors.begin(), colors.end(),
                           [](const auto& a, const auto& b) { return a.color == b.color; }),
               colors.end());
  std::sort(colors.begin(), colors.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
  return colors;
}

/// Squared distances along one axis from a stored level to a cell.
struct AxisDistances {
  float nearest;   ///< to the nearest point of the cell
  float farthest;  ///< to its farthest point
};
using AxisTable = std::array<AxisDistances, 256>;  ///< indexed by level

/// Distances from all levels to cell number `cell`, if the range low .. high is divided into `cells` cells.
AxisTable axis_table(const LevelValues& values, double low, double high, int cells, int cell) noexcept {
  AxisTable table;
  for (std::size_t level = 0; level < values.size(); ++level) {
    const double c = values[level];
    const double below = low + (high - low) * cell / cells - c;
    const double above = c - (low + (high - low) * (cell + 1) / cells);
    table[level] = {static_cast<float>(square(std::max({below, above, 0.0}))),
                    static_cast<float>(square(std::min(below, above)))};
  }
  return table;
}

// Appends to `kept` the colours that can be nearest to some point of a cell. A colour cannot be nearest if
// its distance to the nearest point of the cell exceeds another colour's distance to the farthest point.
// - `among`: candidates of a box that contains the cell.
// - `red`, `green`, `blue`: the cell's distances along the axes.
// - `distances`: scratch memory.
void keep_candidates(const std::vector<DistinctColor>& colors, const std::vector<std::uint32_t>& among,
                     const AxisTable& red, const AxisTable& green, const AxisTable& blue,
                     std::vector<float>& distances, std::vector<std::uint32_t>& kept) {
  float best_farthest = kMaxSquaredDistance;
  distances.resize(among.size());
  for (std::size_t i = 0; i < among.size(); ++i) {
    const Rgb8 c = colors[among[i]].color;
    distances[i] = red[c.r].nearest + green[c.g].nearest + blue[c.b].nearest;
    best_farthest = std::min(best_farthest, red[c.r].farthest + green[c.g].farthest + blue[c.b].farthest);
  }
  // Distances, here and in search(), and the cell of a point are rounded, each by less than one part in 10^6.
  // The margin keeps colours that rounding would drop.
  const float limit = best_farthest * (1.0f + 1e-4f);
  for (std::size_t i = 0; i < among.size(); ++i)
    if (distances[i] <= limit) kept.push_back(among[i]);
}

/// Cells per axis: more for larger palettes, so that a cell keeps few candidates.
int cells_for(std::size_t colors) noexcept {
  if (colors <= 4) return 4;
  if (colors <= 32) return 8;
  return colors <= 1024 ? 16 : 32;
}

constexpr std::size_t cell_index(int cells, int x, int y, int z) noexcept {
  return (static_cast<std::size_t>(x) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(cells) +
         static_cast<std::size_t>(z);
}

}  // namespace

PaletteSearch::PaletteSearch(const Palette& palette, PaletteSearchRange range, const LevelValues& values)
    : low_(range == PaletteSearchRange::dithered ? -0.5f : 0),
      high_(range == PaletteSearchRange::dithered ? 1.5f : 1) {
  const std::vector<DistinctColor> colors = distinct_colors(palette);
  for (const DistinctColor& c : colors)
    entries_.push_back({values[c.color.r], values[c.color.g], values[c.color.b], c.index});

  // Octree: each level filters the candidates of its parent, so only the root tests all colours.
  std::vector<std::vector<std::uint32_t>> coarse(1);  // candidates per cell
  std::vector<std::vector<std::uint32_t>> fine;       // per cell of half the size
  for (std::size_t i = 0; i < colors.size(); ++i) coarse[0].push_back(static_cast<std::uint32_t>(i));
  std::vector<float> distances;
  std::vector<AxisTable> axis;
  while (cells_ < cells_for(colors.size())) {
    cells_ *= 2;
    axis.clear();
    for (int cell = 0; cell < cells_; ++cell) axis.push_back(axis_table(values, low_, high_, cells_, cell));
    fine.assign(cell_index(cells_, cells_, 0, 0), {});
    for (int x = 0; x < cells_; ++x)
      for (int y = 0; y < cells_; ++y)
        for (int z = 0; z < cells_; ++z)
          keep_candidates(colors, coarse[cell_index(cells_ / 2, x / 2, y / 2, z / 2)],
                          axis[static_cast<std::size_t>(x)], axis[static_cast<std::size_t>(y)],
                          axis[static_cast<std::size_t>(z)], distances, fine[cell_index(cells_, x, y, z)]);
    coarse.swap(fine);
  }
  scale_ = static_cast<float>(cells_) / (high_ - low_);
  cell_begin_.push_back(0);
  for (const auto& cell : coarse) {
    candidates_.insert(candidates_.end(), cell.begin(), cell.end());
    cell_begin_.push_back(static_cast<std::uint32_t>(candidates_.size()));
  }
}

std::uint32_t PaletteSearch::search(float r, float g, float b) const noexcept {
  // The upper end of the range belongs to the last cell.
  const auto cell_of = [this](float c) {
    return std::min(static_cast<int>((c - low_) * scale_), cells_ - 1);
  };
  const std::size_t cell = cell_index(cells_, cell_of(r), cell_of(g), cell_of(b));
  const std::uint32_t* candidate = candidates_.data() + cell_begin_[cell];
  const std::uint32_t* const end = candidates_.data() + cell_begin_[cell + 1];
  std::uint32_t nearest = *candidate;
  float nearest_distance = kMaxSquaredDistance;
  for (; candidate != end; ++candidate) {
    const float distance = entries_[*candidate].squared_distance(r, g, b);
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = *candidate;
    }
  }
  return entries_[nearest].index;
}

std::uint32_t PaletteSearch::nearest(float r, float g, float b) const noexcept {
  return search(clamp_component(r), clamp_component(g), clamp_component(b));
}
std::uint32_t PaletteSearch::nearest_unclamped(float r, float g, float b) const noexcept {
  return search(r, g, b);
}

}  // namespace tessera::detail
