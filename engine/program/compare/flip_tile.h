// FLIP within a tile of the picture. Tiles are independent, which bounds memory and allows threads.
#pragma once

#include <array>
#include <vector>

#include "engine/program/compare/flip_colors.h"
#include "engine/program/compare/flip_filters.h"
#include "engine/program/compare/pixel_view.h"

namespace tessera::program {

/// Values that all tiles share.
struct FlipConstants {
  explicit FlipConstants(double pixels_per_degree);

  FlipFilters filters;
  std::array<double, 256> linear;  ///< linear light of each level
  double largest_distance;         ///< powered HyAB distance of green and blue
  int tile_side;                   ///< pixels
};

/// Computes tiles, with memory that is reused from tile to tile. Not for concurrent use.
class FlipTile {
 public:
  explicit FlipTile(const FlipConstants& constants);

  /// Writes the errors of the tile whose upper left pixel is (left, top), both multiples of tile_side, into
  /// the map of the whole picture.
  void compute(const PixelView& picture, const PixelView& reference, int left, int top, float* map);

 private:
  using Plane = std::vector<double>;
  /// Properties of a picture at each pixel of a tile.
  struct Appearance {
    std::array<Plane, 3> opponent;  ///< filtered: luminance, red-green, blue-yellow
    Plane edge, point;              ///< magnitudes of the features
  };

  bool is_equal_around(const PixelView& picture, const PixelView& reference) const;
  void read(const PixelView& picture);
  void filter_colors(Appearance& appearance);
  void detect_features(Appearance& appearance);
  void filter_rows(const SymmetricFilter& filter, const Plane& in, Plane& out) const;
  void filter_columns(const SymmetricFilter& filter, const Plane& in, Plane& out) const;
  double error_at(std::size_t i) const;

  const FlipConstants& constants_;
  int radius_;
  int padded_side_;              ///< tile and the pixels around it that filters read
  int left_ = 0, top_ = 0;       ///< upper left pixel of the tile
  std::array<Plane, 3> around_;  ///< padded_side_ rows of padded_side_ pixels, opponent colours
  Plane filtered_rows_;          ///< padded_side_ rows of tile_side pixels
  Plane smooth_rows_;
  Plane scratch_;  ///< tile_side rows of tile_side pixels, like every plane of Appearance
  std::array<Appearance, 2> appearances_;
};

}  // namespace tessera::program
