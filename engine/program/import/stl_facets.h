// Collects the facets of an STL file as an indexed mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/program/import/index_table.h"
#include "engine/program/import/model_positions.h"

namespace tessera::program {

/// Five bits each of red, green and blue, from bit 10, 5 and 0; bit 15 is set. 0: the color of the object.
using StlColor = std::uint16_t;

class StlFacets {
 public:
  explicit StlFacets(bool positions_are_floats) : positions_(positions_are_floats) {}

  /// Adds a facet, wound counter-clockwise seen from where its normal points.
  void add(const Position& normal, const std::array<Position, 3>& corners, StlColor color = 0);

  std::size_t count() const { return indices_.size() / 3; }
  bool has_colors() const { return has_colors_; }
  /// Whether some facet has a normal.
  bool have_normals() const { return have_normals_; }

  /// Moves the mesh, without normals, into an empty model.
  /// @param object_color  color of facets that have none
  void move_to(Model& model, ModelUse use, const Color& object_color);

 private:
  std::uint32_t vertex(const Position& corner, StlColor color);

  ModelPositions positions_;
  std::vector<StlColor> colors_;  // per vertex, if some facet has a color
  std::vector<std::uint32_t> indices_;
  IndexTable vertices_;
  bool has_colors_ = false, have_normals_ = false;
};

}  // namespace tessera::program
