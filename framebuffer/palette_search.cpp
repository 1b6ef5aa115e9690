#include "framebuffer/palette_search.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tessera::detail {

namespace {

constexpr int kMaxDivisions = 2;
// A cell with more candidates, and at least kMinNear entries inside or around it, is divided.
constexpr std::size_t kFewCandidates = 16;
constexpr std::ptrdiff_t kMinNear = 4;
constexpr float kMaxSquaredDistance = 16;  // exceeds the squared diagonal of the searched cube, 12

// NaN becomes 0.
float clamp_component(float c) noexcept {
  const float at_least_zero = c > 0.0f ? c : 0.0f;
  return at_least_zero < 1.0f ? at_least_zero : 1.0f;
}
float square(float d) noexcept { return d * d; }

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

/// Cells per axis: more for larger palettes, so that a cell keeps few candidates.
int cells_for(std::size_t colors) noexcept {
  if (colors <= 4) return 4;
  if (colors <= 32) return 8;
  return colors <= 1024 ? 16 : 32;
}

constexpr std::uint32_t cell_index(int cells, int x, int y, int z) noexcept {
  return static_cast<std::uint32_t>((x * cells + y) * cells + z);
}

}  // namespace

PaletteSearch::PaletteSearch(const Palette& palette, float margin, const LevelValues& values)
    : low_(-margin), high_(1 + margin) {
  const std::vector<DistinctColor> colors = distinct_colors(palette);
  Positions all;
  for (const DistinctColor& c : colors) {
    all.push_back(static_cast<std::uint32_t>(entries_.size()));
    entries_.push_back({values[c.color.r], values[c.color.g], values[c.color.b], c.index});
  }
  cells_per_axis_ = cells_for(colors.size());
  scale_ = static_cast<float>(cells_per_axis_) / (high_ - low_);
  cells_.resize(cell_index(cells_per_axis_, cells_per_axis_, 0, 0));
  append_cells(0, {{low_, low_, low_}, high_ - low_}, cells_per_axis_, all, 0);
}

/// The entries of `among` that can be nearest to some point of a box. An entry cannot be nearest if its
/// distance to the nearest point of the box exceeds another entry's distance to the farthest point.
PaletteSearch::Positions PaletteSearch::candidates_of(const Box& box, const Positions& among) const {
  const auto along = [&](int axis, float c) {
    const float below = box.low[axis] - c, above = c - (box.low[axis] + box.size);
    return std::pair(square(std::max({below, above, 0.0f})), square(std::min(below, above)));
  };
  float best_farthest = kMaxSquaredDistance;
  std::vector<float> nearest;
  nearest.reserve(among.size());
  for (const std::uint32_t i : among) {
    const Entry& entry = entries_[i];
    const auto [r0, r1] = along(0, entry.r);
    const auto [g0, g1] = along(1, entry.g);
    const auto [b0, b1] = along(2, entry.b);
    nearest.push_back(r0 + g0 + b0);
    best_farthest = std::min(best_farthest, r1 + g1 + b1);
  }
  // Distances, here and in search(), and the cell of a point are rounded: relative to the distances within
  // the smallest cells by less than one part in 10^4. The margin keeps entries that rounding would drop.
  const float limit = best_farthest * (1.0f + 1e-3f);
  Positions kept;
  for (std::size_t i = 0; i < among.size(); ++i)
    if (nearest[i] <= limit) kept.push_back(among[i]);
  return kept;
}

/// Sets the cells of a cube, from `place` on. It is halved along each axis until it has `cells` per axis, so
/// that only few entries are tested for most of the cells.
void PaletteSearch::append_cells(std::uint32_t place, const Box& box, int cells, const Positions& among,
                                 int divisions) {
  const auto halve = [&](const auto& self, const Box& part, int x, int y, int z, int size,
                         const Positions& candidates) -> void {
    if (size == 1) return append_cell(place + cell_index(cells, x, y, z), part, candidates, divisions);
    const float half = part.size / 2;
    const int step = size / 2;
    for (int octant = 0; octant < 8; ++octant) {
      const int dx = octant >> 2, dy = octant >> 1 & 1, dz = octant & 1;
      const auto low = [&](int axis, int d) { return part.low[axis] + (d != 0 ? half : 0.0f); };
      const Box child{{low(0, dx), low(1, dy), low(2, dz)}, half};
      self(self, child, x + dx * step, y + dy * step, z + dz * step, step, candidates_of(child, candidates));
    }
  };
  halve(halve, box, 0, 0, 0, cells, among);
}

void PaletteSearch::append_cell(std::uint32_t place, const Box& box, const Positions& among, int divisions) {
  // Parts have fewer candidates only if several entries lie near. That also bounds the number of cells: an
  // entry is near 27 of them.
  const auto is_near = [&](std::uint32_t i) {
    const float c[3] = {entries_[i].r, entries_[i].g, entries_[i].b};
    for (int axis = 0; axis < 3; ++axis)
      if (c[axis] < box.low[axis] - box.size || c[axis] >= box.low[axis] + 2 * box.size) return false;
    return true;
  };
  const bool is_dense =
      among.size() > kFewCandidates && std::count_if(among.begin(), among.end(), is_near) >= kMinNear;
  if (is_dense && divisions < kMaxDivisions) {
    const auto first = static_cast<std::uint32_t>(cells_.size());
    cells_.resize(cells_.size() + cell_index(kParts, kParts, 0, 0));
    cells_[place] = {first, kDivided};
    return append_cells(first, box, kParts, among, divisions + 1);
  }
  cells_[place] = {static_cast<std::uint32_t>(candidates_.size()), static_cast<std::uint32_t>(among.size())};
  candidates_.insert(candidates_.end(), among.begin(), among.end());
}

std::uint32_t PaletteSearch::search(float r, float g, float b) const noexcept {
  // Place in cells; the upper end of the range belongs to the last cell.
  float x = (r - low_) * scale_, y = (g - low_) * scale_, z = (b - low_) * scale_;
  const int last = cells_per_axis_ - 1;
  int cx = std::min(static_cast<int>(x), last), cy = std::min(static_cast<int>(y), last),
      cz = std::min(static_cast<int>(z), last);
  Cell cell = cells_[cell_index(cells_per_axis_, cx, cy, cz)];
  while (cell.count == kDivided) {
    const auto part = [](float& position, int& index) {
      position = (position - static_cast<float>(index)) * kParts;
      index = std::clamp(static_cast<int>(position), 0, kParts - 1);
    };
    part(x, cx);
    part(y, cy);
    part(z, cz);
    cell = cells_[cell.first + cell_index(kParts, cx, cy, cz)];
  }
  const std::uint32_t* candidate = candidates_.data() + cell.first;
  const std::uint32_t* const end = candidate + cell.count;
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
