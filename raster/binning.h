// Which tiles a triangle may touch. Pure and without threads: each batch of triangles fills bins of its own,
// in submission order, and the tiles read the batches one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "framebuffer/check.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/tessera/enums.hpp"
#include "framebuffer/tile_grid.h"
#include "raster/bins.h"
#include "raster/polygon_facing.h"
#include "raster/topology.h"
#include "raster/vertex_transform.h"
#include "raster/window_polygon.h"

namespace tessera::detail {

/// What binning needs besides of a draw whose polygons are not all filled.
struct PolygonModes {
  PolygonMode style[2] = {};   ///< of fronts and backs
  std::uint32_t draw[3] = {};  ///< the numbers in the frame of what is filled, of lines, of points
  float line_width = 1, point_size = 1;
  std::size_t triangles = 1;                ///< that each polygon was split into
  const std::uint32_t* boundary = nullptr;  ///< the vertices of each polygon, two more than triangles
};

/// What binning needs of a draw.
struct BinDraw {
  std::uint32_t draw = 0;  ///< its number in the frame
  Topology topology = Topology::triangles;
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;  ///< null: vertices in order
  const std::uint8_t* outcodes = nullptr;
  bool any_outcode = false;  ///< false: no vertex has one
  bool keep_front = true, keep_back = true;
  bool front_is_clockwise = false;  ///< seen in the window
  const Facing* facing =
      nullptr;                    ///< of each triangle, where it is its polygon's; null: its own area decides
  PixelRect rect;                 ///< scissor, viewport and frame buffer
  std::int32_t sample_reach = 0;  ///< how far a pixel is looked at around its centre, 1/256 pixel
  // For clipping.
  const VertexTransform* transform = nullptr;
  StridedFloats positions;
  int components = 3;
  const float* attributes = nullptr;
  int attribute_count = 0, attribute_stride = 0;
  // Points and lines.
  float size = 1;  ///< of points, or the lines' width
  int samples = 1;
  const PolygonModes* modes = nullptr;  ///< null: polygons are filled
};

/// True for a triangle whose snapped area faces the viewer; `area` is its doubled area in raster space (y
/// down).
constexpr bool is_front(double area, bool front_is_clockwise) { return (area < 0) != front_is_clockwise; }

/// Of an element of so many corners.
template <std::uint32_t kCorners>
std::uint32_t vertex_index(const BinDraw& draw, std::uint32_t element, std::uint32_t corner) {
  const std::uint32_t i = element * kCorners + corner;
  return draw.indices ? draw.indices[i] : i;
}
/// A vertex with its attributes, before clipping.
ClipVertex clip_vertex(const BinDraw& draw, std::uint32_t vertex, int attribute_count);

/// A triangle after clipping, with the attributes that are asked for. @param outcodes  the three vertices'
/// outcodes or-ed
WindowPolygon clip_to_window(const BinDraw& draw, std::uint32_t triangle, std::uint8_t outcodes,
                             int attribute_count);

/// Bins a bitmap or an image that changes pixels of a rectangle, not empty.
void bin_pixels(Bins& bins, const TileGrid& grid, std::uint32_t draw, const PixelRect& rect);

/// Points whose centres are outside of the view volume are not drawn [GL 2.1, 2.12]; lines are clipped to its
/// near and far planes and to the guard band.
void bin_points(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                std::uint32_t last);
void bin_lines(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
               std::uint32_t last);

/// Polygons that begin in triangles [first, last), each in the style of the face that is seen. Of what
/// clipping leaves of a polygon the edges that clipping made are lines, too. Throws std::bad_alloc. @pre
/// draw.modes and draw.facing
void bin_polygons(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                  std::uint32_t last, InstructionSet isa);
/// Pieces of points and lines that stand last in the list of clipped ones. False if they are outside.
bool bin_derived_point(Bins& bins, const TileGrid& grid, const BinDraw& draw);
bool bin_derived_line(Bins& bins, const TileGrid& grid, const BinDraw& draw);

/// Culls and bins triangles [first, last) of a draw.
void bin_triangles(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                   std::uint32_t last, InstructionSet isa);

}  // namespace tessera::detail
