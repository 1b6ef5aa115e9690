// Grids of labelled pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "engine/program/cli/bitmap_font.h"
#include "engine/program/cli/contact_sheet.h"

namespace tessera::program::cli::contact_sheet_test {
namespace {

/// A picture of one colour. Red identifies it.
Picture plain(int width, int height, std::uint8_t red) {
  Picture picture(width, height);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) picture.rgba[i] = i % 4 == 0 ? red : 255;
  return picture;
}

struct Box {
  int left = std::numeric_limits<int>::max(), right = -1, top = left, bottom = -1, pixels = 0;
};
/// Bounding box and number of the pixels whose red component is `red`.
Box box_of(const Picture& sheet, std::uint8_t red) {
  Box box;
  for (int y = 0; y < sheet.height; ++y)
    for (int x = 0; x < sheet.width; ++x)
      if (sheet.rgba[4 * static_cast<std::size_t>(y * sheet.width + x)] == red) {
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y),
               box.pixels + 1};
      }
  return box;
}

int text_pixels(const std::string& text) {
  Picture picture(text_width(text, 1), kGlyphHeight);
  draw_text(text, 0, 0, {.scale = 1, .color = {1, 1, 1}}, picture);
  return static_cast<int>(std::ranges::count(picture.rgba, 1)) / 3;
}

TEST(CellSize, IsFourToThreeAndFitsTheSheet) {
  for (int columns = 1; columns <= 13; ++columns) {
    const CellSize cell = cell_size(columns);
    EXPECT_EQ(cell.width * 3, cell.height * 4) << columns;
    const SheetCell empty{{Picture(1, 1)}, {}};
    EXPECT_LE(contact_sheet({&empty, 1}, columns).width, kMaxSheetWidth) << columns;
  }
  EXPECT_EQ(cell_size(3).width, 640);
  EXPECT_EQ(cell_size(4).width, 320);
  EXPECT_EQ(cell_size(7).width, 320);
  EXPECT_EQ(cell_size(8).width, 280);
}

TEST(CellPicture, HasTheShapeOfTheScreen) {
  const CellSize cell{320, 240};
  const struct {
    int width, height;
    double aspect;
    int shown_width, shown_height;
  } kRows[] = {{320, 200, 4.0 / 3, 320, 240}, {720, 348, 4.0 / 3, 320, 240}, {64, 64, 1, 240, 240},
               {128, 64, 2, 320, 160},        {3, 300, 0.01, 2, 240},        {300, 1, 1000, 320, 1}};
  for (const auto& row : kRows) {
    const Picture shown = cell_picture(plain(row.width, row.height, 7), row.aspect, cell);
    EXPECT_EQ(shown.width, row.shown_width) << row.width;
    EXPECT_EQ(shown.height, row.shown_height) << row.width;
    EXPECT_EQ(box_of(shown, 7).pixels, shown.width * shown.height);
  }
}

TEST(ContactSheet, PlacesPicturesInAGrid) {
  const CellSize cell = cell_size(4);
  std::vector<SheetCell> cells;
  for (const std::uint8_t red : {101, 102, 103, 104, 105, 106})
    cells.push_back({{plain(cell.width, cell.height, red)}, {"label"}});
  cells[1].pictures[0] = plain(240, 240, 102);
  const Picture sheet = contact_sheet(cells, 4);
  EXPECT_EQ(sheet.width, 16 + 4 * 336);
  const Box first = box_of(sheet, 101), narrow = box_of(sheet, 102), below = box_of(sheet, 106);
  EXPECT_EQ(first.pixels, 320 * 240);
  EXPECT_EQ(first.left, 16);
  EXPECT_EQ(first.top, 16);
  EXPECT_EQ(narrow.pixels, 240 * 240);
  EXPECT_EQ(narrow.left, 16 + 336 + 40);
  EXPECT_EQ(below.left, 16 + 336);
  EXPECT_EQ(below.pixels, 320 * 240);
  EXPECT_GT(below.top, first.bottom + 2 * kGlyphHeight);
  EXPECT_LT(below.bottom, sheet.height - 2 * kGlyphHeight);
}

TEST(ContactSheet, PlacesThePicturesOfACellBelowEachOther) {
  std::vector<SheetCell> cells(6, {{plain(320, 240, 1), plain(320, 240, 2)}, {"label"}});
  cells[1].pictures = {plain(320, 200, 101), plain(300, 240, 102)};
  cells[5].pictures = {plain(320, 240, 103)};
  const Picture sheet = contact_sheet(cells, 4);
  const Box first = box_of(sheet, 101), second = box_of(sheet, 102), below = box_of(sheet, 103);
  EXPECT_EQ(first.pixels, 320 * 200);
  EXPECT_EQ(second.pixels, 300 * 240);
  EXPECT_EQ(first.top, 16 + 20);
  EXPECT_EQ(second.left, 16 + 336 + 10);
  EXPECT_EQ(second.top, 16 + 240 + 6);
  EXPECT_GT(below.top, second.bottom + 2 * kGlyphHeight);
  EXPECT_EQ(sheet.height, 16 + 2 * (below.top - 16)) << "a cell with one picture is as high";
}

TEST(ContactSheet, CutsOffNoLabel) {
  constexpr std::uint8_t kTextRed = 222;
  const struct {
    std::vector<std::string> label;
    int scale;
  } kRows[] = {{{"hercules 720x348, 1 bit", "floyd_steinberg"}, 2},
               {{"a mode with a long name of 40 characters", "bayer8"}, 1},
               {{std::string(150, 'M'), "none"}, 1}};
  for (const auto& row : kRows) {
    std::vector<SheetCell> cells(4, {{plain(320, 240, 3)}, row.label});
    const Picture sheet = contact_sheet(cells, 4);
    int expected = 0;
    for (const std::string& line : row.label)
      for (const char c : line) expected += 4 * row.scale * row.scale * text_pixels(std::string(1, c));
    const Box text = box_of(sheet, kTextRed);
    EXPECT_EQ(text.pixels, expected) << row.label[0];
    EXPECT_LE(text.right, sheet.width - 16) << row.label[0];
    EXPECT_LT(text.bottom, sheet.height) << row.label[0];
  }
}

}  // namespace
}  // namespace tessera::program::cli::contact_sheet_test
