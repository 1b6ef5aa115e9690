// Renders one tile: the primitives of its bins in order -> coverage -> depth -> colour, in tile memory, on
// the calling thread.
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
#include "shading/draw_meter.h"
#include "shading/fragment_ops.h"
#include "shading/fragment_stage.h"
#include "shading/lighting.h"
#include "shading/pixel_path.h"
#include "shading/texture.h"
#include "shading/tile_accumulation.h"

namespace tessera::detail {

/// Source of the colours of a draw's pixels.
enum class ColorSource : std::uint8_t {
  none,                 ///< no colour plane changes
  constant,             ///< one colour for the draw
  per_vertex_packed,    ///< flat: the packed colour of the provoking vertex
  per_triangle_packed,  ///< flat: the packed colour of the triangle
  interpolated,         ///< colours interpolated from the vertices (Gouraud)
  per_pixel,            ///< lit at each pixel (Phong)
  texels                ///< the texels of an image
};

/// A draw as tiles see it. Pointers refer to memory of the frame.
struct TileDraw {
  PixelPath path;                   ///< choose_pixel_path() for the other fields
  std::uint32_t recorded_draw = 0;  ///< number of the recorded draw, for DrawMeter

  Topology topology = Topology::triangles;
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;  ///< null: vertices in order
  /// attribute_stride floats per vertex; kAttributePadding floats after the last one are readable.
  const float* attributes = nullptr;
  int attribute_stride = 0;
  int attribute_count = 0;  ///< number of inputs of lighting, or of colour components
  int provoking = 2;        ///< corner of the element whose vertex has the flat colour
  int element_corners = 3;  ///< corners per element of the mesh: 3 also for edges and corners of polygons
  float size = 1;           ///< points: diameter, lines: width; pixels
  PixelRect rect;           ///< intersection of scissor, viewport and frame buffer, raster space
  bool front_is_clockwise = false;
  /// Per triangle: the facing of its polygon; null: the sign of the triangle's area decides.
  const Facing* facing = nullptr;
  std::uint32_t primitive_triangles = 1;  ///< triangles per primitive of the mesh

  bool uses_depth = false;
  bool depth_write = true;
  Compare depth_test = Compare::less;

  ColorSource source = ColorSource::constant;
  bool affine = false;                         ///< attributes are linear in the window: 1/w counts as 1
  std::uint32_t write_mask = 0xffffffffu;      ///< bits of the packed colour that change
  std::uint32_t packed_color = 0;              ///< constant
  const std::uint32_t* packed_colors[2] = {};  ///< per_vertex_packed, per_triangle_packed; per face
  /// interpolated, per face: attribute of r, or of the index; the next two are g and b.
  int color_attribute[2] = {0, 0};
  /// interpolated: attributes are levels plus 1/2, so that truncation rounds; false: 0..1.
  bool scaled_colors = true;
  bool index[2] = {};  ///< per face: the colour is one float, a masked index
  /// Shade each visible pixel once. @pre set without `ops` if pixels have several samples, for per_pixel, and
  /// for interpolated under a mask
  bool deferred = false;
  /// per_pixel: programs per face, and the batch field of each attribute from first_attribute on.
  const LightingProgram* programs[2] = {};
  int first_attribute = 0;
  std::uint8_t fields[kMaxAttributes] = {};
  /// Null: none. @pre with a texture, `deferred` or `ops` is set, and colours are neither scaled nor packed
  const DrawTexture* texture = nullptr;
  int cell_size = 0;  ///< per_pixel, triangles: side of the cells that are lit, 2 or 4; 0: no cells
  /// Dither of the visible pixels; null: none. @pre if set: without `ops`, deferred, one sample per pixel,
  /// colours 0..1
  const ColorDither* dither = nullptr;
  /// Null: none. @pre if set: colours are 0..1 and no indices. Without `ops` the draw is deferred and the
  /// stage reads no depth. The draw is not deferred if the stage runs before the tests, reads depth in frames
  /// with several samples, or `flat` is set.
  const TileFragmentStage* stage = nullptr;
  /// For captures: the draw with the colours that `stage` reads; null: this one.
  const TileDraw* colors_of = nullptr;
  bool captures_normals = false;  ///< per_pixel: normals are also stored in the workspace's normals()

  /// Triangles behind everything in their tile are left out before they are set up. @pre filled triangles
  /// with one sample per pixel, a depth test `less` or `lequal`, no stencil test and no offset
  bool skips_hidden = false;
  /// Fragment operations besides the depth test; null: none, and most of the fields below are ignored.
  const FragmentOps* ops = nullptr;
  /// Colours are computed as without `ops`. @pre `ops` has a stencil test only, and the draw has untextured
  /// triangles with one sample and without offset
  bool plain_colors = false;
  bool flat = false;  ///< interpolated: one colour per triangle, from face_colors or its provoking vertex
  /// flat, per face: r g b a, or an index, per triangle; null: those of the provoking vertex.
  const float* face_colors[2] = {};
  std::array<float, 4> color[2] = {};         ///< constant, also under a texture; per face
  int alpha_attribute[2] = {-1, -1};          ///< interpolated alpha, per face; -1: `alpha`
  float alpha[2] = {1, 1};                    ///< per face
  float offset_factor = 0, offset_units = 0;  ///< polygon offset [GL 2.1, 3.5.5]
  /// Depth offset of each triangle's polygon (raster/polygon_offset.h); null, or NaN for a triangle: computed
  /// from the triangle.
  const double* depth_offsets = nullptr;
  /// For captures: pixels get `packed_color`, or the number of the primitive.
  enum class IdOutput : std::uint8_t { none, draw, primitive };
  IdOutput id_output = IdOutput::none;

  /// A bitmap or an image in place of triangles. @pre not deferred, without offset
  const PixelRectangle* texels = nullptr;
  std::int32_t depth_key = 0;  ///< depth of its pixels
};

/// A clear inside a frame, with stored values.
struct TileClear {
  std::uint32_t before_draw = 0;  ///< runs before this draw
  bool color = false, depth = false, stencil = false, accumulation = false;
  std::uint32_t packed_color = 0;
  bool dithered = false;  ///< a pattern of the frame replaces packed_color
  /// Place in TileFrame::clear_patterns of packed colours by raster row and column, as in DitherPattern.
  std::uint32_t first_of_pattern = 0;
  std::int32_t depth_key = 0;
  std::int32_t stencil_value = 0;
  AccumulatedPixel accumulation_levels{};
  PixelRect rect;
};

/// State that all tiles of a frame share.
struct TileFrame {
  TileGrid grid;
  ColorLayout layout;
  const PaletteSearch* palette_search = nullptr;  ///< index layouts
  DepthFormat depth_format = DepthFormat::none;
  const TileDraw* draws = nullptr;
  std::uint32_t draw_count = 0;
  const TileClear* clears = nullptr;
  std::uint32_t clear_count = 0;
  const std::uint32_t* clear_patterns = nullptr;          ///< patterns of dithered clears
  int clear_pattern_rows = 1, clear_pattern_columns = 4;  ///< powers of two
  const TileAccumulation* accumulations = nullptr;
  std::uint32_t accumulation_count = 0;
  const BinBatches* batches = nullptr;  ///< @pre index_batches() has run for the tile
  /// Shade after each triangle; with several samples, after each group of them.
  bool shade_immediately = false;
  int samples = 1;                        ///< coverage samples per pixel: 1, 4 or 8
  StageFailure* stage_failure = nullptr;  ///< @pre if a draw has a fragment stage: not null
  /// Samples start with the buffer's contents in the workspace. If not set, a command overwrites the whole
  /// buffer before it is read.
  bool loads_color = false, loads_depth = false, loads_stencil = false;
  MeterPass meter_pass = MeterPass::none;  ///< @pre if it is not none, workspaces have a meter
};

PixelPathFrame pixel_path_frame(const TileFrame& frame, InstructionSet isa);

/// Packs a colour 0..1 in the frame's layout; alpha only if the layout stores it.
std::uint32_t pack_color_or_index(const ColorLayout& layout, const PaletteSearch* search, float r, float g,
                                  float b, float a = 1);

struct TileCounts {
  std::uint64_t shaded_pixels = 0;
  std::uint64_t hidden_triangles = 0;
  std::uint64_t non_finite_fragments = 0;  ///< results of fragment stages
  bool touched = false;
};

/// Memory of one worker: the pixels of a tile and its visible triangles. Reused from tile to tile.
class TileWorkspace {
 public:
  TileWorkspace();
  ~TileWorkspace();
  TileWorkspace(TileWorkspace&&) noexcept;
  struct Memory;
  Memory& memory() { return *memory_; }
  /// tile_size^2 packed colours of the selected tile, in tile order. Tile 0 is selected at first.
  std::uint32_t* color();
  /// Selects the colours of a tile for rendering. Those of other tiles are kept.
  /// @pre allocate_colors() has run, unless `tile` is 0
  std::uint32_t* select_color(std::size_t tile);
  std::int32_t* depth();    ///< depth keys
  std::int32_t* stencil();  ///< stencil values. @pre allocate_stencil()
  /// Packed colours of one sample of the last tile, in tile order.
  /// @pre several samples, and the tile had triangles
  const std::uint32_t* sample_color(int sample) const;
  AccumulatedPixels accumulation();  ///< levels, in tile order. @pre allocate_accumulation()
  /// Normals of pixels of draws that capture them, in tile order. @pre allocate_normals()
  float* normals(int component);
  /// The meter of the worker; null: draws are not measured. It must outlive the tiles.
  void set_meter(DrawMeter* meter);
  /// These throw std::bad_alloc.
  void allocate_colors(int tiles);
  void allocate_normals();
  void allocate_stencil();
  void allocate_samples();
  void allocate_accumulation();
  void allocate_stage_depth();

 private:
  std::unique_ptr<Memory> memory_;
};

/// Runs the frame's commands on one tile.
/// - With several samples the workspace's colours are afterwards the means of the samples, and its depths and
///   stencil values those of sample 0.
/// @pre the workspace holds the contents of all buffers that are read before a command overwrites them
using RenderTile = TileCounts(const TileFrame& frame, int tile, TileWorkspace& workspace);
RenderTile* render_tile(InstructionSet isa);

}  // namespace tessera::detail
