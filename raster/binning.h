// Binning: assigns primitives to the tiles that they may touch. One thread bins each batch of primitives, in
// submission order and into separate bins; tiles read the batches in order.
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

namespace tessera::detail {

/// Additional input for draws with polygon modes other than fill.
struct PolygonModes {
  PolygonMode mode[2] = {};                 ///< per face: [0] front, [1] back
  std::uint32_t draw[3] = {};               ///< draw number per PolygonMode: fill, line, point
  float line_width = 1;                     ///< pixels
  float point_size = 1;                     ///< pixels
  std::size_t triangles = 1;                ///< triangles per polygon
  const std::uint32_t* boundary = nullptr;  ///< vertex indices of each polygon: triangles + 2 per polygon
};

/// Binning input of a draw.
struct BinDraw {
  std::uint32_t draw = 0;  ///< number of the draw in the frame
  Topology topology = Topology::triangles;
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;  ///< null: vertices in order
  const std::uint8_t* outcodes = nullptr;
  bool any_outcode = false;  ///< false: all outcodes are 0
  bool keep_front = true;
  bool keep_back = true;
  bool front_is_clockwise = false;  ///< in window space, y up
  /// Facing per triangle, decided by the whole polygon; null: each triangle's own area decides.
  const Facing* facing = nullptr;
  PixelRect rect;  ///< intersection of scissor, viewport and frame buffer
  /// Largest distance per axis of a sample from its pixel's centre, 1/256 pixel.
  std::int32_t sample_reach = 0;
  // For clipping.
  const VertexTransform* transform = nullptr;
  StridedFloats positions;
  int components = 3;                            ///< components of a position: 3 or 4
  const ClipPosition* clip_positions = nullptr;  ///< per vertex, in place of `positions`; null: transformed
  const float* attributes = nullptr;
  int attribute_count = 0;
  int attribute_stride = 0;  ///< floats from vertex to vertex
  // Points and lines.
  float point_line_size = 1;  ///< size of points or width of lines, pixels
  int samples = 1;
  const PolygonModes* modes = nullptr;  ///< null: all polygons are filled
};

/// True if a triangle is front-facing. `area` is its doubled area in raster space (y down), after snapping.
constexpr bool is_front(double area, bool front_is_clockwise) { return (area < 0) != front_is_clockwise; }

/// True if face culling keeps the visible side of the triangle.
inline bool passes_face_culling(const BinDraw& draw, std::uint32_t triangle, double area) {
  const bool front = draw.facing != nullptr ? draw.facing[triangle] == Facing::front
                                            : is_front(area, draw.front_is_clockwise);
  return front ? draw.keep_front : draw.keep_back;
}

/// Vertex index of a corner of an element with kCorners corners.
template <std::uint32_t kCorners>
std::uint32_t vertex_index(const BinDraw& draw, std::uint32_t element, std::uint32_t corner) {
  const std::uint32_t i = element * kCorners + corner;
  return draw.indices ? draw.indices[i] : i;
}

/// Bins a bitmap or an image that covers `rect`. @pre rect is not empty
void bin_pixels(Bins& bins, const TileGrid& grid, std::uint32_t draw, const PixelRect& rect);

/// Bins points. A point whose centre lies outside the view volume is dropped [GL 2.1, 2.12].
void bin_points(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                std::uint32_t last);
/// Bins lines, clipped to the near and far planes and to the guard band.
void bin_lines(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
               std::uint32_t last);

/// Bins the polygons that begin in triangles [first, last), each in the mode of its visible face. In line
/// mode, edges made by clipping are drawn too. Throws std::bad_alloc. @pre draw.modes and draw.facing are set
void bin_polygons(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                  std::uint32_t last, InstructionSet isa);
/// Bin the last derived primitive of `bins` as a point or as a line. Return false if it covers no pixel of
/// draw.rect.
bool bin_derived_point(Bins& bins, const TileGrid& grid, const BinDraw& draw);
bool bin_derived_line(Bins& bins, const TileGrid& grid, const BinDraw& draw);

/// Culls and bins triangles [first, last) of a draw.
void bin_triangles(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first,
                   std::uint32_t last, InstructionSet isa);

}  // namespace tessera::detail
