// Reads the vertices of PLY files.
#pragma once

#include <optional>
#include <vector>

#include "engine/program/import/model_positions.h"
#include "engine/program/import/ply_values.h"

namespace tessera::program {

struct PlyVertices {
  ModelPositions positions{true};
  std::vector<float> normals;    ///< x y z of each, or empty
  std::vector<float> colors;     ///< r g b a of each, or empty
  std::vector<float> texcoords;  ///< s t of each, or empty
};

/// Reads the values of an element that are named `red`, `green`, `blue` and perhaps `alpha`, or likewise.
class PlyColor {
 public:
  /// Absent unless the element has red, green and blue.
  static std::optional<PlyColor> of(const PlyElement& element);

  /// Takes the value of a property, if it is a component.
  void take(int property, double value);
  const std::array<float, 4>& rgba() const { return rgba_; }

 private:
  std::array<int, 4> property_{-1, -1, -1, -1};  // number of the property of r, g, b and a; -1: none
  std::array<double, 4> full_{1, 1, 1, 1};       // value that becomes 1
  std::array<float, 4> rgba_{0, 0, 0, 1};
};

/// @throws Error for an element without x, y and z, and as PlyValues does
PlyVertices read_ply_vertices(const PlyElement& element, PlyFormat format, PlyValues& values);

}  // namespace tessera::program
