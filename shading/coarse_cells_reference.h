// Scalar twin of coarse_cells-inl.h, and its specification: where a triangle is lit in one cell.
#pragma once

#include <algorithm>

#include "shading/interpolate_reference.h"

namespace tessera::detail {

struct CellReference {
  BarycentricReference at;
  enum class Rule { center, pixel, outside } rule = Rule::center;
};

/// @param x, y  first pixel of the cell of size x size pixels
inline CellReference cell_reference(const WindowVertex (&v)[3], int size, int x, int y) {
  const WeightsReference weights(v);
  const float to_center = static_cast<float>(size - 1) * 0.5f;
  float w[3];
  for (int k = 0; k < 3; ++k) w[k] = weights.at(k, x, y, to_center);
  CellReference cell;
  if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0)) {
    cell.rule = CellReference::Rule::outside;
    const auto covers = [&](int px, int py) {
      if (!weights.wide) return weights.exact.covers(px, py);
      return std::all_of(weights.exact.edge, weights.exact.edge + 3,
                         [&](const EdgeReference& edge) { return edge.at(px, py) >= 0; });
    };
    // The covered pixel that is nearest to the centre; of several, the first by rows.
    int nearest = 1 << 30;
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const int dx = 2 * column - (size - 1), dy = 2 * row - (size - 1);
        const int distance = dx * dx + dy * dy;
        if (distance >= nearest || !covers(x + column, y + row)) continue;
        nearest = distance;
        cell.rule = CellReference::Rule::pixel;
        for (int k = 0; k < 3; ++k) w[k] = weights.at(k, x + column, y + row);
      }
  }
  for (float& weight : w) weight = std::max(weight, 0.0f);
  const float inverse = 1.0f / (w[0] + w[1] + w[2]);
  cell.at = {w[1] * inverse, w[2] * inverse};
  return cell;
}

}  // namespace tessera::detail
