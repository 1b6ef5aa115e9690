#include <algorithm>

#include "engine/stages/batch_shading.h"
#include "engine/stages/geometry.h"

namespace tessera::detail {

void compute_flat_colors(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa) {
  const MeshArrays& mesh = *draw.mesh;
  const DrawPlan& plan = *draw.plan;
  const auto components = static_cast<std::size_t>(mesh.components);
  const auto vertex_of = [&](std::size_t triangle) {
    return mesh.vertex_at(provoking_corner(mesh.primitive, draw.provoking_vertex, mesh.corners, triangle));
  };
  ShadingBatch batch;
  clear_batch(batch);
  const VertexValues writes = draw.writes();
  float positions[4 * kVertexBatch], normals[3 * kVertexBatch];
  for (std::size_t at = first; at < last; at += kVertexBatch) {
    const std::size_t count = std::min<std::size_t>(kVertexBatch, last - at);
    if (plan.needs_normal() && writes.normal) {
      load_rows(batch, kNormalX, count,
                [&](std::size_t i) { return draw.buffers->staged.normals.data() + 3 * vertex_of(at + i); });
    } else if (plan.needs_normal()) {
      for (std::size_t i = 0; i < count && !plan.face_normals; ++i)
        std::copy_n(mesh.normals.at(vertex_of(at + i)), 3, normals + 3 * i);
      const StridedFloats of_triangles =
          plan.face_normals ? draw.lighting_normals().from(at) : StridedFloats{normals, 3};
      eye_normals(isa)(plan.eye, of_triangles, count, batch.field[kNormalX], batch.field[kNormalY],
                       batch.field[kNormalZ]);
    }
    if (plan.needs_position() && writes.eye) {
      load_rows(batch, kPositionX, count,
                [&](std::size_t i) { return draw.buffers->staged.eye.data() + 3 * vertex_of(at + i); });
    } else if (plan.needs_position()) {
      for (std::size_t i = 0; i < count; ++i)
        std::copy_n(mesh.positions.at(vertex_of(at + i)), components, positions + i * components);
      eye_positions(isa)(plan.eye, {positions, components}, mesh.components, count, batch.field[kPositionX],
                         batch.field[kPositionY], batch.field[kPositionZ]);
    }
    if (plan.uses_vertex_colors)
      load_vertex_colors(draw, batch, count, [&](std::size_t i) { return vertex_of(at + i); });
    if (plan.uses_color_indices)
      load_color_indices(draw, batch, count, [&](std::size_t i) { return vertex_of(at + i); });
    shade_batch(draw, batch,
                shaded_points(draw, at, count, true, [&](std::size_t i) { return vertex_of(at + i); }), isa);
  }
}

}  // namespace tessera::detail
