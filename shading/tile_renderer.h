// Renders one tile: its bins' triangles in order -> coverage -> depth -> colour, in tile memory. Knows no threads.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/palette_search.h"
#include "framebuffer/tile_grid.h"
#include "raster/binning.h"
#include "raster/triangle_setup.h"
#include "shading/lighting.h"

namespace tessera {

/// How the colour of a draw's pixels comes about.
enum class ColorSource : std::uint8_t {
  none,          ///< no colour plane changes: depth alone
  constant,      ///< one word for the whole draw
  vertex_word,   ///< a word for each vertex; a triangle has its provoking vertex's (flat)
  triangle_word, ///< a word for each triangle (flat, by face normals)
  interpolated,  ///< colours interpolated from the vertices (Gouraud)
  per_pixel      ///< lit at each pixel (Phong)
};

/// 0..7 in the order never less equal lequal greater notequal gequal always.
enum class DepthTest : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

/// What the tiles need of a draw. Pointers are the frame's.
struct TileDraw {
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;  ///< null: vertices in order
  const float* attributes = nullptr;       ///< attribute_stride floats for each vertex
  int attribute_stride = 0, attribute_count = 0;
  int provoking = 2;                       ///< corner of the triangle
  PixelRect rect;                          ///< scissor, viewport and frame buffer, raster space
  bool front_is_clockwise = false;

  bool uses_depth = false, depth_write = true;
  DepthTest depth_test = DepthTest::less;

  ColorSource source = ColorSource::constant;
  std::uint32_t write_mask = 0xffffffffu;  ///< of the colour word's bits
  std::uint32_t word = 0;                                     ///< constant
  const std::uint32_t* words[2] = {};                         ///< vertex_word, triangle_word: front, back
  /// interpolated: attribute of r for front and back faces; the next two are g and b. Already scaled to levels, with the half
  /// that rounds, if scaled_colors; else 0..1.
  int color_attribute[2] = {0, 0};
  bool scaled_colors = true;
  bool deferred = false;                   ///< shade once for each visible pixel
  /// per_pixel: programs for front and back, and which batch field each attribute goes to, from first_attribute on.
  const LightingProgram* programs[2] = {};
  int first_attribute = 0;
  std::uint8_t fields[kMaxAttributes] = {};
  bool captures_normals = false;           ///< per_pixel: the normals go to the workspace's normals(), too
};

/// A clear inside a frame, in words; before draw `before_draw`.
struct TileClear {
  std::uint32_t before_draw = 0;
  bool color = false, depth = false;
  std::uint32_t color_word = 0;
  std::int32_t depth_key = 0;
  PixelRect rect;
};

/// What all tiles of a frame share.
struct TileFrame {
  TileGrid grid;
  ColorLayout layout;
  const PaletteSearch* palette_search = nullptr;  ///< index layouts
  DepthKind depth_kind = DepthKind::none;
  const TileDraw* draws = nullptr;
  std::uint32_t draw_count = 0;
  const TileClear* clears = nullptr;
  std::uint32_t clear_count = 0;
  const Bins* bins = nullptr;
  std::uint32_t bin_count = 0;
  bool shade_at_once = false;                     ///< never gather triangles before shading
};

/// Words to the frame's layout from colours 0..1.
std::uint32_t color_word(const ColorLayout& layout, const PaletteSearch* search, float r, float g, float b);

struct TileCounts {
  std::uint64_t shaded_pixels = 0;
  bool touched = false;
};

/// A worker's memory: one tile's pixels and the triangles seen in it. Reused from tile to tile.
class TileWorkspace {
 public:
  TileWorkspace();
  ~TileWorkspace();
  TileWorkspace(TileWorkspace&&) noexcept;
  struct Memory;
  Memory& memory() { return *memory_; }
  std::uint32_t* color();     ///< tile_size^2 words in tile order
  std::int32_t* depth();      ///< depth keys
  float* normals(int component);  ///< of pixels of draws that capture them, in tile order. @pre allocate_normals
  /// Throws std::bad_alloc.
  void allocate_normals();

 private:
  std::unique_ptr<Memory> memory_;
};

/// Runs the frame's commands on one tile. Colour and depth must hold what was there before, unless a clear of the whole
/// tile comes first.
using RenderTile = TileCounts(const TileFrame& frame, int tile, TileWorkspace& workspace);
RenderTile* render_tile(Isa isa);

}  // namespace tessera
