// A grid of labelled cells, each with pictures in the true shape of their screen.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

/// Widest sheet in pixels, unless it has more columns than fit with kMinCellWidth.
inline constexpr int kMaxSheetWidth = 2400;
inline constexpr int kMinCellWidth = 160;

/// Size of the 4:3 cells of a sheet: 640x480 if as many columns fit, else 320x240, else smaller.
struct CellSize {
  int width = 640, height = 480;  ///< pixels
};
CellSize cell_size(int columns);

struct SheetCell {
  std::vector<Picture> pictures;   ///< one below the other, each at most as large as a cell and centred in it
  std::vector<std::string> label;  ///< lines below the pictures, printable ASCII
};

/// Resizes a picture so that it fills a cell in width or height, with the given width to height; see
/// area_resampled().
Picture cell_picture(const Picture& source, double screen_aspect, CellSize cell);

/// Draws the cells row by row. Labels are wrapped if they are wider than a cell.
/// @param cells  at least one
Picture contact_sheet(std::span<const SheetCell> cells, int columns);

}  // namespace tessera::program::cli
