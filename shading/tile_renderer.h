// Renders one tile: its bins' triangles in order -> coverage -> depth -> colour, in tile memory. Knows no
// threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "framebuffer/format.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/palette_search.h"
#include "framebuffer/tile_grid.h"
#include "raster/binning.h"
#include "raster/pixel_rectangle.h"
#include "raster/triangle_setup.h"
#include "shading/fragment_ops.h"
#include "shading/lighting.h"
#include "shading/pixel_path.h"
#include "shading/texture.h"
#include "shading/tile_accumulation.h"

namespace tessera::detail {

/// How the colour of a draw's pixels comes about.
enum class ColorSource : std::uint8_t {
  none,                 ///< no colour plane changes: depth alone
  constant,             ///< one word for the whole draw
  per_vertex_packed,    ///< a word for each vertex; a triangle has its provoking vertex's (flat)
  per_triangle_packed,  ///< a word for each triangle (flat, by face normals)
  interpolated,         ///< colours interpolated from the vertices (Gouraud)
  per_pixel,            ///< lit at each pixel (Phong)
  texels                ///< an image's own
};

/// What the tiles need of a draw. Pointers are the frame's.
struct TileDraw {
  PixelPath path;  ///< choose_pixel_path() of what follows

  Topology topology = Topology::triangles;
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;  ///< null: vertices in order
  const float* attributes = nullptr;       ///< attribute_stride floats for each vertex; behind the last one
                                           ///< kAttributePadding more may be read
  int attribute_stride = 0, attribute_count = 0;
  int provoking = 2;        ///< corner of each element: point, line or triangle
  int element_corners = 3;  ///< edges and corners of polygons are parts of triangles
  float size = 1;           ///< of points in pixels, or the lines' width
  PixelRect rect;           ///< scissor, viewport and frame buffer, raster space
  bool front_is_clockwise = false;
  const Facing* facing =
      nullptr;  ///< of each triangle, where it is its polygon's; null: its own area decides
  std::uint32_t primitive_triangles = 1;  ///< that each primitive was split into

  bool uses_depth = false, depth_write = true;
  Compare depth_test = Compare::less;

  ColorSource source = ColorSource::constant;
  std::uint32_t write_mask = 0xffffffffu;      ///< of the colour word's bits
  std::uint32_t packed_color = 0;              ///< constant
  const std::uint32_t* packed_colors[2] = {};  ///< per_vertex_packed, per_triangle_packed: front, back
  /// interpolated: attribute of r, or of the index, for front and back faces; the next two are g and b.
  /// Already scaled to levels, with the half that rounds, if scaled_colors; else 0..1.
  int color_attribute[2] = {0, 0};
  bool scaled_colors = true;
  bool index[2] = {};     ///< front, back: the colour is a single float, a masked index
  bool deferred = false;  ///< shade once for each visible pixel. @pre set without `ops` if pixels have
                          ///< several samples, for per_pixel, and for interpolated under a mask
  /// per_pixel: programs for front and back, and which batch field each attribute goes to, from
  /// first_attribute on.
  const LightingProgram* programs[2] = {};
  int first_attribute = 0;
  std::uint8_t fields[kMaxAttributes] = {};
  const DrawTexture* texture =
      nullptr;  ///< or none. @pre with one, set `deferred` or `ops`; the colours are neither scaled nor words
  bool captures_normals = false;  ///< per_pixel: the normals go to the workspace's normals(), too

  /// What its fragments go through besides the depth test; null: nothing, and what follows is not looked at.
  const FragmentOps* ops = nullptr;
  bool plain_colors = false;  ///< colours are what they would be without `ops`. @pre these are a stencil test
                              ///< alone, without offset or samples, of untextured triangles
  bool flat = false;          ///< interpolated: a triangle has the colour of its provoking vertex, or its own
  const float* face_colors[2] =
      {};  ///< flat: r g b a, or an index, for each triangle, front and back; null: the vertex's
  std::array<float, 4> color[2] = {};  ///< constant, also of a texture: front, back
  int alpha_attribute[2] = {-1, -1};   ///< interpolated alpha for front and back faces; -1: `alpha`
  float alpha[2] = {1, 1};
  float offset_factor = 0, offset_units = 0;  ///< of depth, in polygon slopes and smallest differences
  const double* depth_offsets = nullptr;      ///< what they come to of each triangle's polygon
                                          ///< (raster/polygon_offset.h); null, or NaN: a triangle has its own
  enum class IdOutput : std::uint8_t {
    none,
    draw,
    primitive
  } id_output = IdOutput::none;  ///< packed colors are `packed_color`, or the primitive's number

  /// A bitmap or an image, in place of triangles: constant, texels, none, or a number's words. @pre not
  /// deferred, without offset
  const PixelRectangle* texels = nullptr;
  std::int32_t depth_key = 0;  ///< of all its pixels
};

/// A clear inside a frame, in words; before draw `before_draw`.
struct TileClear {
  std::uint32_t before_draw = 0;
  bool color = false, depth = false, stencil = false, accumulation = false;
  std::uint32_t packed_color = 0;
  bool dithered = false;                                         ///< the words of `pattern` in place of that
  std::array<std::uint32_t, kDitherSize * kDitherSize> pattern;  ///< by raster row and column, repeated
  std::int32_t depth_key = 0, stencil_value = 0;
  AccumulatedPixel accumulation_levels{};
  PixelRect rect;
};

/// What all tiles of a frame share.
struct TileFrame {
  TileGrid grid;
  ColorLayout layout;
  const PaletteSearch* palette_search = nullptr;  ///< index layouts
  DepthFormat depth_format = DepthFormat::none;
  const TileDraw* draws = nullptr;
  std::uint32_t draw_count = 0;
  const TileClear* clears = nullptr;
  std::uint32_t clear_count = 0;
  const TileAccumulation* accumulations = nullptr;
  std::uint32_t accumulation_count = 0;
  const BinBatches* batches = nullptr;  ///< @pre tiles are looked through there before they are rendered
  bool shade_immediately =
      false;        ///< shade after each triangle, with several samples after each group of them
  int samples = 1;  ///< 1, 4 or 8 coverage samples a pixel
  /// Samples start from what the workspace holds of the buffer; else a command replaces all of it before it
  /// is looked at.
  bool loads_color = false, loads_depth = false, loads_stencil = false;
};

PixelPathFrame pixel_path_frame(const TileFrame& frame, InstructionSet isa);

/// Words to the frame's layout from colours 0..1; alpha where it has planes.
std::uint32_t pack_color_or_index(const ColorLayout& layout, const PaletteSearch* search, float r, float g,
                                  float b, float a = 1);

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
  std::uint32_t* color();  ///< tile_size^2 words in tile order, of the tile that is selected, which is the
                           ///< last one for that select_color() was called; else tile 0
  /// From now on tiles are rendered into these words; those of other tiles stay. @pre allocate_colors, but
  /// for tile 0
  std::uint32_t* select_color(std::size_t tile);
  std::int32_t* depth();    ///< depth keys
  std::int32_t* stencil();  ///< stencil values. @pre allocate_stencil
  /// Words of one sample of the tile rendered last, in tile order. @pre several samples, and a triangle in
  /// the tile
  const std::uint32_t* sample_color(int sample) const;
  AccumulatedPixels accumulation();  ///< levels, in tile order. @pre allocate_accumulation
  float* normals(
      int component);  ///< of pixels of draws that capture them, in tile order. @pre allocate_normals
  /// These throw std::bad_alloc.
  void allocate_colors(int tiles);
  void allocate_normals();
  void allocate_stencil();
  void allocate_samples();
  void allocate_accumulation();

 private:
  std::unique_ptr<Memory> memory_;
};

/// Runs the frame's commands on one tile. The buffers they look at must hold what was there before, unless a
/// command that replaces all of the tile comes first. Of several samples the workspace's colour then holds
/// the mean, its depth and stencil those of the first.
using RenderTile = TileCounts(const TileFrame& frame, int tile, TileWorkspace& workspace);
RenderTile* render_tile(InstructionSet isa);

}  // namespace tessera::detail
