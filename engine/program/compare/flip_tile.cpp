#include "engine/program/compare/flip_tile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace tessera::program {
namespace {

/// Small tiles stay in the cache; wide filters make larger ones cheaper, because tiles share no work.
int tile_side_for(int radius) {
  constexpr int kMinTileSide = 64;
  return std::max(kMinTileSide, (4 * radius + kFilterBlock - 1) / kFilterBlock * kFilterBlock);
}

/// a = sqrt(a^2 + b^2)
void set_norms(std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::sqrt(a[i] * a[i] + b[i] * b[i]);
}

}  // namespace

FlipConstants::FlipConstants(double pixels_per_degree)
    : filters(flip_filters(pixels_per_degree)),
      linear(),
      largest_distance(powered_hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1}))),
      tile_side(tile_side_for(filters.radius())) {
  for (int level = 0; level < 256; ++level)
    linear[static_cast<std::size_t>(level)] = linear_from_level(level);
}

FlipTile::FlipTile(const FlipConstants& constants)
    : constants_(constants),
      radius_(constants.filters.radius()),
      padded_side_(constants.tile_side + 2 * radius_) {
  const auto side = static_cast<std::size_t>(constants.tile_side);
  const auto padded_side = static_cast<std::size_t>(padded_side_);
  for (Plane& plane : around_) plane.resize(padded_side * padded_side);
  filtered_rows_.resize(padded_side * side);
  smooth_rows_.resize(padded_side * side);
  scratch_.resize(side * side);
  for (Appearance& appearance : appearances_) {
    for (Plane& plane : appearance.opponent) plane.resize(side * side);
    appearance.edge.resize(side * side);
    appearance.point.resize(side * side);
  }
}

void FlipTile::compute(const PixelView& picture, const PixelView& reference, int left, int top, float* map) {
  left_ = left;
  top_ = top;
  const int columns = std::min(constants_.tile_side, picture.width - left);
  const int rows = std::min(constants_.tile_side, picture.height - top);
  const auto row_of_map = [&](int y) {
    return map + static_cast<std::ptrdiff_t>(top + y) * picture.width + left;
  };
  if (is_equal_around(picture, reference)) {
    for (int y = 0; y < rows; ++y) std::fill_n(row_of_map(y), columns, 0.0f);
    return;
  }
  read(picture);
  filter_colors(appearances_[0]);
  detect_features(appearances_[0]);
  read(reference);
  filter_colors(appearances_[1]);
  detect_features(appearances_[1]);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      row_of_map(y)[x] = static_cast<float>(
          error_at(static_cast<std::size_t>(y) * static_cast<std::size_t>(constants_.tile_side) +
                   static_cast<std::size_t>(x)));
}

/// Equal pixels give equal appearances and thus errors of exactly 0.
bool FlipTile::is_equal_around(const PixelView& picture, const PixelView& reference) const {
  const int x0 = std::max(0, left_ - radius_);
  const int x1 = std::min(picture.width, left_ + constants_.tile_side + radius_);
  const int y0 = std::max(0, top_ - radius_);
  const int y1 = std::min(picture.height, top_ + constants_.tile_side + radius_);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (std::memcmp(picture.pixel(x, y), reference.pixel(x, y), 3) != 0) return false;
  return true;
}

/// Pixels outside the picture repeat its border.
void FlipTile::read(const PixelView& picture) {
  const std::array<double, 256>& linear = constants_.linear;
  std::size_t i = 0;
  for (int row = 0; row < padded_side_; ++row) {
    const int y = std::clamp(top_ - radius_ + row, 0, picture.height - 1);
    for (int column = 0; column < padded_side_; ++column, ++i) {
      const int x = std::clamp(left_ - radius_ + column, 0, picture.width - 1);
      const std::uint8_t* const rgb = picture.pixel(x, y);
      const Vector3 opponent = opponent_from_rgb({linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]});
      for (std::size_t c = 0; c < 3; ++c) around_[c][i] = opponent[c];
    }
  }
}

void FlipTile::filter_colors(Appearance& appearance) {
  const FlipFilters& filters = constants_.filters;
  const auto filter_plane = [this](const SymmetricFilter& filter, const Plane& in, Plane& out) {
    filter_rows(filter, in, filtered_rows_);
    filter_columns(filter, filtered_rows_, out);
  };
  filter_plane(filters.luminance, around_[0], appearance.opponent[0]);
  filter_plane(filters.red_green, around_[1], appearance.opponent[1]);
  filter_plane(filters.blue_yellow_narrow, around_[2], appearance.opponent[2]);
  filter_plane(filters.blue_yellow_wide, around_[2], scratch_);
  for (std::size_t i = 0; i < scratch_.size(); ++i) appearance.opponent[2][i] += scratch_[i];
}

void FlipTile::detect_features(Appearance& appearance) {
  const FlipFilters& filters = constants_.filters;
  const Plane& luminance = around_[0];
  filter_rows(filters.smooth, luminance, smooth_rows_);
  const auto detect = [&](const SymmetricFilter& derivative, Plane& magnitude) {
    filter_rows(derivative, luminance, filtered_rows_);
    filter_columns(filters.smooth, filtered_rows_, magnitude);
    filter_columns(derivative, smooth_rows_, scratch_);
    set_norms(magnitude, scratch_);
  };
  detect(filters.first_derivative, appearance.edge);
  detect(filters.second_derivative, appearance.point);
}

void FlipTile::filter_rows(const SymmetricFilter& filter, const Plane& in, Plane& out) const {
  for (std::ptrdiff_t row = 0; row < padded_side_; ++row)
    convolve(filter, in.data() + row * padded_side_ + radius_, 1, out.data() + row * constants_.tile_side,
             constants_.tile_side);
}

void FlipTile::filter_columns(const SymmetricFilter& filter, const Plane& in, Plane& out) const {
  const std::ptrdiff_t side = constants_.tile_side;
  for (std::ptrdiff_t row = 0; row < side; ++row)
    convolve(filter, in.data() + (row + radius_) * side, side, out.data() + row * side, constants_.tile_side);
}

double FlipTile::error_at(std::size_t i) const {
  const auto color_of = [i](const Appearance& appearance) {
    const Vector3 opponent{appearance.opponent[0][i], appearance.opponent[1][i], appearance.opponent[2][i]};
    return hunt_lab_from_rgb(rgb_from_opponent(opponent));
  };
  const Appearance& a = appearances_[0];
  const Appearance& b = appearances_[1];
  const double color = color_error(powered_hyab(color_of(a), color_of(b)), constants_.largest_distance);
  const double feature = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
  return combined_error(color, std::sqrt(feature / std::numbers::sqrt2));
}

}  // namespace tessera::program
