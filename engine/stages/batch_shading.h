// Shading of a batch of vertices or of flat triangles: loads colours, lights, textures and stores the
// results.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/stages/geometry.h"
#include "shading/lighting.h"

namespace tessera::detail {

/// Vertices or triangles that are shaded together.
struct ShadedPoints {
  std::size_t first;
  std::size_t count;
  bool triangles;             ///< false: vertices
  float alpha[kBatchPoints];  ///< alpha of vertices, if DrawPlan::vertex_alpha
};

/// Copies rows of three floats, row(i) for point i, to the three fields of the batch from `field` on.
template <class Row>
void load_rows(ShadingBatch& batch, int field, std::size_t count, const Row& row) {
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < 3; ++c) batch.field[field + c][i] = row(i)[c];
}

/// Loads the vertex colours of a batch; vertex(i) is the vertex of point i.
template <class VertexOf>
void load_vertex_colors(const GeometryDraw& draw, ShadingBatch& batch, std::size_t count,
                        const VertexOf& vertex) {
  if (draw.writes().color)
    return load_rows(batch, kVertexR, count,
                     [&](std::size_t i) { return draw.buffers->staged.colors.data() + 4 * vertex(i); });
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) batch.field[kVertexR + c][i] = draw.mesh->color(vertex(i), c);
}

/// Calls store(i, alpha) with the alpha of vertex(i) for each point i.
template <class VertexOf, class Store>
void load_vertex_alpha(const GeometryDraw& draw, std::size_t count, const VertexOf& vertex,
                       const Store& store) {
  if (draw.writes().color) {
    for (std::size_t i = 0; i < count; ++i) store(i, draw.buffers->staged.colors.data()[4 * vertex(i) + 3]);
  } else {
    for (std::size_t i = 0; i < count; ++i) store(i, draw.mesh->color(vertex(i), 3));
  }
}

/// Unlit draws: colour indices of the vertices, masked like results of index lighting.
template <class VertexOf>
void load_color_indices(const GeometryDraw& draw, ShadingBatch& batch, std::size_t count,
                        const VertexOf& vertex) {
  for (std::size_t i = 0; i < count; ++i)
    batch.field[kColorR][i] =
        masked_index(*draw.mesh->color_indices.at(vertex(i)), draw.layout->index_modulus());
}

/// The points of a batch, with their alpha; vertex(i) is the vertex of point i.
template <class VertexOf>
ShadedPoints shaded_points(const GeometryDraw& draw, std::size_t first, std::size_t count, bool triangles,
                           const VertexOf& vertex) {
  ShadedPoints points{.first = first, .count = count, .triangles = triangles, .alpha = {}};
  if (draw.plan->float_colors && draw.plan->vertex_alpha)
    load_vertex_alpha(draw, count, vertex, [&](std::size_t i, float alpha) { points.alpha[i] = alpha; });
  return points;
}

/// Sets all fields to 0: vectors also read the points after the last one.
void clear_batch(ShadingBatch& batch);
/// Lights, textures and stores the colours of a batch whose inputs are loaded.
void shade_batch(const GeometryDraw& draw, ShadingBatch& batch, const ShadedPoints& points,
                 InstructionSet isa);

}  // namespace tessera::detail
