#include "engine/stages/geometry.h"

#include <algorithm>
#include <cmath>

#include "engine/stages/generated_normals.h"
#include "shading/vertex_colors.h"

namespace tessera::detail {
namespace {

StridedFloats normals_of(const GeometryDraw& draw) {
  if (draw.plan->face_normals) return {draw.buffers->face_normals.data(), 3};
  return draw.needs_smooth_normals() ? StridedFloats{draw.buffers->smooth_normals.data(), 3}
                                     : draw.mesh->normals;
}
/// Normals of vertices for stages and captures, in object space.
StridedFloats vertex_normals_of(const GeometryDraw& draw) {
  return draw.mesh->normals ? draw.mesh->normals : StridedFloats{draw.buffers->smooth_normals.data(), 3};
}

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

std::uint32_t packed_color_of(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t i, int face) {
  if (draw.plan->is_index[face]) return quantize_index(*draw.layout, batch.field[kColorR][i]);
  return pack_color_or_index(*draw.layout, draw.palette_search, batch.field[kColorR][i],
                             batch.field[kColorG][i], batch.field[kColorB][i]);
}

/// Unlit draws: vertex colours, clamped like every result of the vertex stage.
void copy_vertex_colors(ShadingBatch& batch, std::size_t count) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i)
      batch.field[kColorR + c][i] = std::min(std::max(batch.field[kVertexR + c][i], 0.0f), 1.0f);
}

/// Unlit draws: colour indices of the vertices, masked like results of index lighting.
template <class VertexOf>
void load_color_indices(const GeometryDraw& draw, ShadingBatch& batch, std::size_t count,
                        const VertexOf& vertex) {
  for (std::size_t i = 0; i < count; ++i)
    batch.field[kColorR][i] =
        masked_index(*draw.mesh->color_indices.at(vertex(i)), draw.layout->index_modulus());
}

/// Vertices or triangles that are shaded together.
struct Batch {
  std::size_t first;
  std::size_t count;
  bool triangles;             ///< false: vertices
  float alpha[kBatchPoints];  ///< alpha of vertices, if DrawPlan::vertex_alpha
};

std::size_t varying_stride(const DrawPlan& plan) { return static_cast<std::size_t>(plan.varyings.count); }

/// Address of the varying at `offset` in the record of `vertex`.
float* varying(const GeometryDraw& draw, std::size_t vertex, int offset) {
  return draw.buffers->attributes.data() + vertex * varying_stride(*draw.plan) + offset;
}

/// Float colours of one face of a batch.
struct ColorOutput {
  float* first;
  std::size_t stride;  ///< floats from colour to colour
};
ColorOutput color_output(const GeometryDraw& draw, const Batch& points, int face) {
  const DrawPlan& plan = *draw.plan;
  if (points.triangles) return {draw.buffers->face_colors[face].data() + 4 * points.first, 4};
  return {varying(draw, points.first, plan.varyings.color[face]), varying_stride(plan)};
}

void store_indices(const GeometryDraw& draw, const ShadingBatch& batch, const Batch& points, int face) {
  const auto [out, stride] = color_output(draw, points, face);
  for (std::size_t i = 0; i < points.count; ++i) out[i * stride] = batch.field[kColorR][i];
}

/// Alpha of point i, before texturing.
float alpha_of(const DrawPlan& plan, const Batch& points, std::size_t i, int face) {
  if (!plan.vertex_alpha) return plan.alpha[face];
  if (!plan.clamps_vertex_alpha) return points.alpha[i];
  return std::min(std::max(points.alpha[i], 0.0f), 1.0f);
}

/// Colours for fragment operations: r g b a per point.
void store_rgba(const GeometryDraw& draw, const ShadingBatch& batch, const Batch& points, int face) {
  const DrawPlan& plan = *draw.plan;
  auto [out, stride] = color_output(draw, points, face);
  for (std::size_t i = 0; i < points.count; ++i, out += stride) {
    for (int c = 0; c < 3; ++c) out[c] = batch.field[kColorR + c][i];
    out[3] = alpha_of(plan, points, i, face);
    if (plan.folds_texture())
      out[3] = texture_env_reference(plan.texture.texture, {0, 0, 0, out[3]}, plan.texture.texture.texel)[3];
  }
}

/// Applies a texture of one colour to clamped colours.
void fold_texture(const DrawTexture& texture, ShadingBatch& batch, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto color = texture_env_reference(
        texture, {batch.field[kColorR][i], batch.field[kColorG][i], batch.field[kColorB][i], 1},
        texture.texel);
    for (std::size_t c = 0; c < 3; ++c) batch.field[kColorR + c][i] = color[c];
  }
}

/// Stores the colours of a batch in the form that the tiles read.
void store_colors(const GeometryDraw& draw, ShadingBatch& batch, const Batch& points, int face,
                  InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  if (plan.folds_texture() && !plan.is_index[face]) fold_texture(plan.texture.texture, batch, points.count);
  const bool is_interpolated = plan.source == ColorSource::interpolated;
  if (is_interpolated && plan.is_index[face]) return store_indices(draw, batch, points, face);
  if (plan.float_colors) return store_rgba(draw, batch, points, face);
  if (is_interpolated) {
    if (plan.scaled_colors) scale_colors(isa)(*draw.layout, batch, static_cast<int>(points.count));
    auto [out, stride] = color_output(draw, points, face);
    for (std::size_t i = 0; i < points.count; ++i, out += stride)
      for (int c = 0; c < 3; ++c) out[c] = batch.field[kColorR + c][i];
  } else if (!plan.is_index[face] && !draw.layout->index) {
    pack_vertex_colors(isa)(*draw.layout, batch, static_cast<int>(points.count),
                            draw.buffers->packed_colors[face].data() + points.first);
  } else {
    for (std::size_t i = 0; i < points.count; ++i)
      draw.buffers->packed_colors[face].data()[points.first + i] = packed_color_of(draw, batch, i, face);
  }
}

void light_batch(const GeometryDraw& draw, const LightingProgram& program, ShadingBatch& batch,
                 const Batch& points, int face, InstructionSet isa) {
  light_points(isa)(program, batch, static_cast<int>((points.count + 15) / 16 * 16));
  store_colors(draw, batch, points, face, isa);
}

/// Lights, textures and stores the colours of a batch whose inputs are loaded.
void shade_batch(const GeometryDraw& draw, ShadingBatch& batch, const Batch& points, InstructionSet isa) {
  const DrawPlan& plan = *draw.plan;
  if (!plan.lit) {
    if (!plan.uses_color_indices) copy_vertex_colors(batch, points.count);
    store_colors(draw, batch, points, 0, isa);
    return;
  }
  if (plan.two_sided) {
    ShadingBatch back = batch;  // lighting modifies the normals of its batch
    light_batch(draw, plan.back, back, points, 1, isa);
  }
  light_batch(draw, plan.front, batch, points, 0, isa);
}

template <class VertexOf>
Batch batch_of(const GeometryDraw& draw, std::size_t first, std::size_t count, bool triangles,
               const VertexOf& vertex) {
  Batch points{.first = first, .count = count, .triangles = triangles, .alpha = {}};
  if (draw.plan->float_colors && draw.plan->vertex_alpha)
    load_vertex_alpha(draw, count, vertex, [&](std::size_t i, float alpha) { points.alpha[i] = alpha; });
  return points;
}

/// Stores the inputs of per-pixel lighting, in eye space.
void store_lighting_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                           std::size_t count) {
  const VaryingLayout& layout = draw.plan->varyings;
  const std::size_t stride = varying_stride(*draw.plan);
  const auto store = [&](int offset, int field) {
    if (offset < 0) return;
    float* const out = varying(draw, first, offset);
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        out[i * stride + static_cast<std::size_t>(c)] = batch.field[field + c][i];
  };
  store(layout.normal, kNormalX);
  store(layout.position, kPositionX);
  store(layout.color[0], kVertexR);
  if (layout.alpha[0] < 0) return;
  float* const out = varying(draw, first, layout.alpha[0]);
  load_vertex_alpha(
      draw, count, [first](std::size_t i) { return first + i; },
      [&](std::size_t i, float alpha) { out[i * stride] = alpha; });  // clamped at the pixel, like the colour
}

/// Stores the inputs of the fragment stage that lighting does not store.
void store_stage_inputs(const GeometryDraw& draw, const ShadingBatch& batch, std::size_t first,
                        std::size_t count) {
  const VaryingLayout& layout = draw.plan->varyings;
  const std::size_t stride = varying_stride(*draw.plan);
  const auto store = [&](int offset, int components, const auto& value) {
    if (offset < 0) return;
    float* out = varying(draw, first, offset);
    for (std::size_t i = 0; i < count; ++i, out += stride)
      for (int c = 0; c < components; ++c) out[c] = value(i, c);
  };
  const auto field = [&](int of) {
    return [&batch, of](std::size_t i, int c) { return batch.field[of + c][i]; };
  };
  if (layout.stage_eye != layout.position) store(layout.stage_eye, 3, field(kPositionX));
  if (layout.stage_normal != layout.normal) store(layout.stage_normal, 3, field(kNormalX));
  if (layout.stage_extras < 0) return;
  const auto extras = static_cast<std::size_t>(draw.plan->vertex_stage->extras);
  const float* const staged = draw.buffers->staged.extras.data() + first * extras;
  store(layout.stage_extras, draw.plan->fragment_stage->stage.reads.extras,
        [&](std::size_t i, int c) { return staged[i * extras + static_cast<std::size_t>(c)]; });
}

void store_texcoords(const GeometryDraw& draw, std::size_t first, std::size_t count) {
  const std::size_t stride = varying_stride(*draw.plan);
  const StridedFloats texcoords = draw.texcoords();
  float* out = varying(draw, first, draw.plan->varyings.texcoord);
  for (std::size_t i = 0; i < count; ++i, out += stride) std::copy_n(texcoords.at(first + i), 2, out);
}

/// Stores eye-space normals for captures, independent of shading.
void store_captured_normals(const GeometryDraw& draw, std::size_t first, std::size_t count,
                            InstructionSet isa) {
  float eye[3][kVertexBatch];
  if (draw.writes().normal) {
    const float* const staged = draw.buffers->staged.normals.data() + 3 * first;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) eye[c][i] = staged[3 * i + c];
  } else {
    eye_normals(isa)(draw.plan->captured_eye, vertex_normals_of(draw).from(first), count, eye[0], eye[1],
                     eye[2]);
  }
  const std::size_t stride = varying_stride(*draw.plan);
  float* out = varying(draw, first, draw.plan->varyings.captured_normal);
  for (std::size_t i = 0; i < count; ++i, out += stride) {
    const bool is_finite = std::isfinite(eye[0][i]) && std::isfinite(eye[1][i]) && std::isfinite(eye[2][i]);
    // A capture drops no primitive.
    for (std::size_t c = 0; c < 3; ++c) out[c] = is_finite ? eye[c][i] : 0;
  }
}

/// Writes the vertex index of each corner of elements [first, last), the provoking vertex at
/// provoking_place().
void list_corners(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  const MeshArrays& mesh = *draw.mesh;
  const auto each = static_cast<std::size_t>(mesh.topology());
  std::uint32_t* out = draw.buffers->indices.data() + each * first;
  for (std::size_t e = first; e < last; ++e) {
    const auto corners = element_corners(mesh.primitive, draw.provoking_vertex, mesh.corners, e);
    for (std::size_t k = 0; k < each; ++k) *out++ = static_cast<std::uint32_t>(mesh.vertex_at(corners[k]));
  }
}

/// Lists the boundary of each polygon: the corners of its first triangle, then the corner that each further
/// triangle adds. The start does not depend on the provoking vertex.
void list_boundaries(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  const MeshArrays& mesh = *draw.mesh;
  const std::size_t each = mesh.triangles_per_polygon();
  const std::size_t first_polygon = (first + each - 1) / each;
  std::uint32_t* out = draw.buffers->boundary.data() + first_polygon * (each + 2);
  for (std::size_t begin = first_polygon * each; begin < last; begin += each) {
    for (const std::size_t corner :
         element_corners(mesh.primitive, ProvokingVertex::last, mesh.corners, begin))
      *out++ = static_cast<std::uint32_t>(mesh.vertex_at(corner));
    for (std::size_t t = begin + 1; t < begin + each; ++t)
      *out++ = static_cast<std::uint32_t>(mesh.vertex_at(added_corner(mesh.primitive, t)));
  }
}

void clear_batch(ShadingBatch& batch) {
  for (auto& field : batch.field) std::fill(std::begin(field), std::end(field), 0.0f);
}

}  // namespace

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

void assemble_elements(const GeometryDraw& draw, std::size_t first, std::size_t last) {
  if (draw.generates_indices()) list_corners(draw, first, last);
  if (draw.plan->outlines) list_boundaries(draw, first, last);
  if (draw.plan->face_normals) make_face_normals(*draw.mesh, first, last, draw.buffers->face_normals.data());
}

namespace {

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
    any |= run_vertex_stage(draw, has_vertex_normals ? vertex_normals_of(draw) : StridedFloats{}, at, count,
                            isa);
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
      plan.face_normals && draw.needs_smooth_normals() ? vertex_normals_of(draw) : normals_of(draw);
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
      shade_batch(draw, batch, batch_of(draw, at, count, false, [at](std::size_t i) { return at + i; }), isa);
  }
  if (outcodes != 0) buffers.any_outcode.store(true, std::memory_order_relaxed);
}

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
          plan.face_normals ? normals_of(draw).from(at) : StridedFloats{normals, 3};
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
                batch_of(draw, at, count, true, [&](std::size_t i) { return vertex_of(at + i); }), isa);
  }
}

}  // namespace tessera::detail
