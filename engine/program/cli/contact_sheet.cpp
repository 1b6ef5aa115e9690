#include "engine/program/cli/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/program/cli/bitmap_font.h"
#include "engine/program/imageio/area_resample.h"

namespace tessera::program::cli {
namespace {

constexpr int kGap = 16;      ///< pixels between cells, and around the sheet
constexpr int kLabelGap = 6;  ///< between the pictures of a cell and its label
constexpr int kMaxTextScale = 2;
using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kBackground{34, 36, 40};
constexpr Rgb kTextColor{222, 222, 222};

/// Positions and sizes of everything on a sheet.
struct Layout {
  CellSize cell;
  int columns = 1;
  int text_scale = 1;
  std::size_t pictures = 1;     ///< number in the cell with the most
  std::size_t label_lines = 0;  ///< lines of the longest label

  int line_height() const { return (kGlyphHeight + 2) * text_scale; }
  int picture_top(std::size_t picture) const { return static_cast<int>(picture) * (cell.height + kLabelGap); }
  int label_top() const { return picture_top(pictures); }
  int row_height() const { return label_top() + static_cast<int>(label_lines) * line_height() + kGap; }
  int left(std::size_t index) const { return kGap + static_cast<int>(index) % columns * (cell.width + kGap); }
  int top(std::size_t index) const { return kGap + static_cast<int>(index) / columns * row_height(); }
};

/// Splits lines of more characters than a cell holds.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, int cell_width, int text_scale) {
  const auto room = static_cast<std::size_t>((cell_width / text_scale + 1) / kGlyphAdvance);
  std::vector<std::string> result;
  for (const std::string& line : lines)
    for (std::size_t at = 0; at == 0 || at < line.size(); at += room) result.push_back(line.substr(at, room));
  return result;
}

Layout layout_of(std::span<const SheetCell> cells, int columns) {
  Layout layout{.cell = cell_size(columns), .columns = columns, .text_scale = kMaxTextScale};
  const auto fits = [&](const SheetCell& cell) {
    return std::ranges::all_of(cell.label, [&](const std::string& line) {
      return text_width(line, layout.text_scale) <= layout.cell.width;
    });
  };
  while (layout.text_scale > 1 && !std::ranges::all_of(cells, fits)) --layout.text_scale;
  for (const SheetCell& cell : cells) {
    layout.pictures = std::max(layout.pictures, cell.pictures.size());
    layout.label_lines =
        std::max(layout.label_lines, wrapped(cell.label, layout.cell.width, layout.text_scale).size());
  }
  return layout;
}

void fill(Picture& picture, const Rgb& color) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    std::copy(color.begin(), color.end(), picture.rgba.begin() + static_cast<std::ptrdiff_t>(i));
    picture.rgba[i + 3] = 255;
  }
}

void copy_picture(const Picture& source, int left, int top, Picture& sheet) {
  for (int y = 0; y < source.height; ++y) {
    const auto from = source.rgba.begin() + std::ptrdiff_t{4} * y * source.width;
    const auto to = sheet.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(top + y) * sheet.width + left);
    std::copy(from, from + std::ptrdiff_t{4} * source.width, to);
  }
}

}  // namespace

CellSize cell_size(int columns) {
  const auto fits = [columns](int width) { return columns * (width + kGap) + kGap <= kMaxSheetWidth; };
  int width = 640;
  if (!fits(width)) width = 320;
  while (!fits(width) && width > kMinCellWidth) width -= 4;  // keeps 4:3 exact
  return {width, width / 4 * 3};
}

Picture cell_picture(const Picture& source, double screen_aspect, CellSize cell) {
  const auto rounded = [](double size) { return std::max(1, static_cast<int>(size + 0.5)); };
  const int width = std::min(cell.width, rounded(cell.height * screen_aspect));
  const int height = std::min(cell.height, rounded(cell.width / screen_aspect));
  return area_resampled(source, width, height);
}

Picture contact_sheet(std::span<const SheetCell> cells, int columns) {
  const Layout layout = layout_of(cells, columns);
  const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
  Picture sheet(kGap + columns * (layout.cell.width + kGap), kGap + rows * layout.row_height());
  sheet.channels = 3;
  fill(sheet, kBackground);
  const TextStyle style{.scale = layout.text_scale, .color = kTextColor};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < cells[i].pictures.size(); ++k) {
      const Picture& picture = cells[i].pictures[k];
      copy_picture(picture, layout.left(i) + (layout.cell.width - picture.width) / 2,
                   layout.top(i) + layout.picture_top(k) + (layout.cell.height - picture.height) / 2, sheet);
    }
    int y = layout.top(i) + layout.label_top();
    for (const std::string& line : wrapped(cells[i].label, layout.cell.width, layout.text_scale)) {
      draw_text(line, layout.left(i), y, style, sheet);
      y += layout.line_height();
    }
  }
  return sheet;
}

}  // namespace tessera::program::cli
