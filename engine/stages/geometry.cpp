#include "engine/stages/geometry.h"

#include <algorithm>

#include "engine/stages/batch_shading.h"
#include "engine/stages/vertex_varyings.h"

namespace tessera::detail {

void prepare_geometry(const GeometryDraw& draw) {
  const DrawPlan& plan = *draw.plan;
  DrawBuffers& buffers = *draw.buffers;
  const std::size_t vertices = draw.mesh->vertices;
  const std::size_t triangles = draw.mesh->elements;
  buffers.vertices.resize(vertices);
  buffers.outcodes.resize(vertices);
  // Attributes are read in whole vectors.
  buffers.attributes.resize(vertices * varying_stride(plan) + 2 * kAttributePadding);
  const bool has_face_colors = plan.float_colors && plan.has_per_triangle_colors();
  const std::size_t face_floats = has_face_colors ? 4 * triangles : 0;
  buffers.face_colors[0].resize(face_floats);
  buffers.face_colors[1].resize(plan.two_sided ? face_floats : 0);
  std::size_t packed_words = 0;
  if (plan.source == ColorSource::per_vertex_packed) packed_words = vertices;
  if (plan.source == ColorSource::per_triangle_packed) packed_words = triangles;
  buffers.packed_colors[0].resize(packed_words);
  buffers.packed_colors[1].resize(plan.two_sided ? packed_words : 0);
  if (draw.generates_indices())
    buffers.indices.resize(static_cast<std::size_t>(draw.mesh->topology()) * triangles);
  buffers.facing.resize(draw.has_polygon_facing() ? triangles : 0);
  const std::size_t triangles_per_polygon = draw.mesh->triangles_per_polygon();
  if (plan.outlines) buffers.boundary.resize(triangles / triangles_per_polygon * (triangles_per_polygon + 2));
  if (plan.face_normals) buffers.face_normals.resize(3 * triangles);
  if (plan.vertex_stage != nullptr) buffers.staged.resize(*plan.vertex_stage, vertices);
  buffers.any_outcode = false;
}

namespace {

/// Marks vertices with a value that is not finite: their primitives are dropped, as for positions.
/// @return  the marked outcodes, or 0
std::uint8_t mark_non_finite(StridedFloats values, std::size_t each, std::size_t count,
                             std::uint8_t* outcodes) {
  std::uint8_t any = 0;
  for (std::size_t i = 0; i < count; ++i) {
    float probe = 0;
    for (std::size_t k = 0; k < each; ++k) probe += values.at(i)[k] * 0.0f;
    if (!(probe == 0)) any = outcodes[i] |= kNonFinite;
  }
  return any;
}

/// Places vertices in the window, after the vertex stage if there is one, and marks those that are not
/// finite.
/// @return  bitwise or of the outcodes
std::uint8_t place(const GeometryDraw& draw, StridedFloats normals, std::size_t at, std::size_t count,
                   InstructionSet isa) {
  const MeshArrays& mesh = *draw.mesh;
  const DrawPlan& plan = *draw.plan;
  std::uint8_t* const outcodes = draw.buffers->outcodes.data() + at;
  const VertexValues writes = draw.writes();
  std::uint8_t any = 0;
  if (!writes.clip)
    any |= transform_vertices(isa)(plan.transform, mesh.positions.from(at), mesh.components, count,
                                   draw.buffers->vertices.data() + at, outcodes);
  if (plan.vertex_stage != nullptr) {
    const bool has_vertex_normals = draw.mesh->normals || draw.needs_smooth_normals();
    any |=
        run_vertex_stage(draw, has_vertex_normals ? draw.vertex_normals() : StridedFloats{}, at, count, isa);
  }
  if (plan.uses_vertex_colors && mesh.colors && !writes.color)
    any |= mark_non_finite(mesh.colors.from(at), 4, count, outcodes);
  if (plan.uses_color_indices) any |= mark_non_finite(mesh.color_indices.from(at), 1, count, outcodes);
  if (plan.varyings.texcoord >= 0 && !writes.texcoord)
    any |= mark_non_finite(mesh.texcoords.from(at), 2, count, outcodes);
  const bool uses_normals = plan.needs_normal() || plan.varyings.stage_normal >= 0;
  if (uses_normals && !plan.face_normals && !writes.normal && normals)
    any |= mark_non_finite(normals.from(at), 3, count, outcodes);
  return any;
}

/// Loads normals and positions of vertices in eye space.
void load_eye_space(const GeometryDraw& draw, StridedFloats normals, std::size_t at, std::size_t count,
                    ShadingBatch& batch, InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  const StagedVertices& staged = draw.buffers->staged;
  const VertexValues writes = draw.writes();
  if (plan.needs_normal() || plan.varyings.stage_normal >= 0) {
    if (writes.normal)
      load_rows(batch, kNormalX, count, [&](std::size_t i) { return staged.normals.data() + 3 * (at + i); });
    else
      eye_normals(isa)(plan.eye, normals.from(at), count, batch.field[kNormalX], batch.field[kNormalY],
                       batch.field[kNormalZ]);
  }
  if (plan.needs_position() || plan.varyings.stage_eye >= 0) {
    if (writes.eye)
      load_rows(batch, kPositionX, count, [&](std::size_t i) { return staged.eye.data() + 3 * (at + i); });
    else
      eye_positions(isa)(plan.eye, draw.mesh->positions.from(at), draw.mesh->components, count,
                         batch.field[kPositionX], batch.field[kPositionY], batch.field[kPositionZ]);
  }
}

}  // namespace

void process_vertices(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  DrawBuffers& buffers = *draw.buffers;
  const bool colors_matter = plan.source == ColorSource::per_vertex_packed ||
                             plan.source == ColorSource::interpolated ||
                             plan.source == ColorSource::per_pixel;
  const bool has_stage_inputs = plan.fragment_stage.has_value();
  // Flat faces are lit with face normals, and stages get normals of vertices.
  const StridedFloats normals =
      plan.face_normals && draw.needs_smooth_normals() ? draw.vertex_normals() : draw.lighting_normals();
  ShadingBatch batch;
  clear_batch(batch);
  std::uint8_t outcodes = 0;
  for (std::size_t at = first; at < last; at += kVertexBatch) {
    const std::size_t count = std::min<std::size_t>(kVertexBatch, last - at);
    outcodes |= place(draw, normals, at, count, isa);
    if (plan.varyings.texcoord >= 0) store_texcoords(draw, at, count);
    if (plan.varyings.captured_normal >= 0) store_captured_normals(draw, at, count, isa);
    const bool shades = colors_matter && !plan.has_per_triangle_colors();
    if (shades || has_stage_inputs) load_eye_space(draw, normals, at, count, batch, isa);
    if (has_stage_inputs) store_stage_inputs(draw, batch, at, count);
    if (!shades) continue;
    if (plan.uses_vertex_colors)
      load_vertex_colors(draw, batch, count, [at](std::size_t i) { return at + i; });
    if (plan.uses_color_indices)
      load_color_indices(draw, batch, count, [at](std::size_t i) { return at + i; });
    if (plan.source == ColorSource::per_pixel) store_lighting_inputs(draw, batch, at, count);
    else
      shade_batch(draw, batch, shaded_points(draw, at, count, false, [at](std::size_t i) { return at + i; }),
                  isa);
  }
  if (outcodes != 0) buffers.any_outcode.store(true, std::memory_order_relaxed);
}

}  // namespace tessera::detail
