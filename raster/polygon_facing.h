// Facing of polygons that are split into several triangles: the whole polygon decides, not each triangle.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tessera::detail {

struct BinDraw;

/// Facing of a polygon, shared by all of its triangles.
enum class Facing : std::uint8_t {
  back,
  front,
  edge_on,  ///< no area: back for culling and polygon mode [GL 2.1, 3.5.1], front for lighting and stencil
  dropped   ///< a vertex is not finite
};

/// Classifies the polygons of `per_polygon` triangles that begin in [first, last), by the sign of the window
/// area that clipping leaves of them [GL 2.1, 3.5.1]. Writes `facing` for each of their triangles.
void classify_polygon_facing(const BinDraw& draw, std::size_t per_polygon, std::size_t first,
                             std::size_t last, Facing* facing);

}  // namespace tessera::detail
