// Geometry of a draw: transforms vertices to raster space, and computes packed colors and varyings.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/plan/draw_plan.h"
#include "engine/stages/scratch.h"
#include "engine/stages/vertex_stage.h"
#include "framebuffer/palette_search.h"
#include "raster/polygon_facing.h"

namespace tessera::detail {

/// Memory of a draw's vertices, kept from frame to frame.
struct DrawBuffers {
  Scratch<WindowVertex> vertices;
  Scratch<std::uint8_t> outcodes;           ///< per vertex
  Scratch<float> attributes;                ///< per vertex: a record of DrawPlan::varyings
  Scratch<std::uint32_t> packed_colors[2];  ///< per face; per vertex or triangle
  Scratch<float> face_colors[2];            ///< per face; r g b a per triangle: flat draws with float colours
  Scratch<std::uint32_t> indices;           ///< per element corner: generated, or widened from 16 bits
  Scratch<Facing> facing;                   ///< per triangle: see has_polygon_facing()
  Scratch<std::uint32_t> boundary;          ///< vertices of each polygon in order, for outlines
  Scratch<double> depth_offsets;            ///< per triangle: see has_polygon_offsets()
  PolygonModes modes;                       ///< if polygons are outlined
  Scratch<float> smooth_normals;            ///< generated, per vertex: for lighting or captures
  Scratch<float> face_normals;              ///< generated, per triangle
  StagedVertices staged;                    ///< results of the vertex stage
  std::atomic<bool> any_outcode = false;    ///< a vertex has an outcode
};

/// A draw in the geometry stage.
struct GeometryDraw {
  const MeshArrays* mesh = nullptr;
  const DrawPlan* plan = nullptr;
  DrawBuffers* buffers = nullptr;
  const ColorLayout* layout = nullptr;
  const PaletteSearch* palette_search = nullptr;
  ProvokingVertex provoking_vertex = ProvokingVertex::last;

  bool generates_indices() const {
    const Primitive p = mesh->primitive;
    const bool is_list = p == Primitive::points || p == Primitive::lines || p == Primitive::triangles;
    return mesh->indices16 != nullptr || !is_list;
  }
  /// Vertices of each element's corners; null: vertices in order.
  /// @pre prepare_geometry() has run
  const std::uint32_t* indices() const {
    return generates_indices() ? buffers->indices.data() : mesh->indices;
  }
  /// Per triangle: the facing of its polygon; null: the sign of the triangle's area decides.
  /// @pre classify_polygon_facing() has run, if the elements are read
  const Facing* facing() const { return has_polygon_facing() ? buffers->facing.data() : nullptr; }
  /// Per triangle: the depth offset of its polygon; NaN: computed from the triangle. Null: all offsets are
  /// computed from the triangles.
  /// @pre offset_polygons() has run, if the elements are read
  const double* depth_offsets() const {
    return has_polygon_offsets() ? buffers->depth_offsets.data() : nullptr;
  }
  /// The draw needs assemble_elements().
  bool assembles() const { return generates_indices() || plan->outlines || plan->face_normals; }
  bool needs_smooth_normals() const {
    const bool is_captured = plan->varyings.captured_normal >= 0 && !writes().normal;
    const bool is_input = reads_normals_outside_lighting();
    return plan->smooth_normals || (!mesh->normals && (is_captured || is_input));
  }
  /// Values that the vertex stage writes.
  VertexValues writes() const {
    return plan->vertex_stage != nullptr ? plan->vertex_stage->writes : VertexValues{};
  }
  /// A stage reads normals of the mesh, or generated ones.
  bool reads_normals_outside_lighting() const {
    const bool is_read = plan->vertex_stage != nullptr && plan->vertex_stage->reads.normal;
    return is_read || (plan->varyings.stage_normal >= 0 && !writes().normal);
  }
  /// Normals of the vertices, in object space.
  /// @pre the mesh has normals, or needs_smooth_normals()
  StridedFloats vertex_normals() const {
    return mesh->normals ? mesh->normals : StridedFloats{buffers->smooth_normals.data(), 3};
  }
  /// Normals for lighting, in object space: per triangle if DrawPlan::face_normals, else per vertex.
  StridedFloats lighting_normals() const {
    if (plan->face_normals) return {buffers->face_normals.data(), 3};
    return needs_smooth_normals() ? StridedFloats{buffers->smooth_normals.data(), 3} : mesh->normals;
  }
  StridedFloats texcoords() const {
    return writes().texcoord ? StridedFloats{buffers->staged.texcoords.data(), 2} : mesh->texcoords;
  }
  /// The triangles of a polygon share a facing: polygons have several triangles, or are outlined.
  bool has_polygon_facing() const { return plan->outlines || mesh->triangles_per_polygon() > 1; }
  /// The triangles, outlines or clipped pieces of a polygon share a depth offset.
  /// @pre process_vertices() has run
  bool has_polygon_offsets() const {
    return plan->has_offset() && (has_polygon_facing() || buffers->any_outcode);
  }
};

/// Allocates the memory of the functions below. Throws std::bad_alloc.
void prepare_geometry(const GeometryDraw& draw);
/// Generates the corners of elements [first, last), and the outlines and face normals of polygons that begin
/// in that range.
/// Distinct ranges may run concurrently.
void assemble_elements(const GeometryDraw& draw, std::size_t first, std::size_t last);
/// Transforms and shades vertices [first, last). Distinct ranges may run concurrently.
void process_vertices(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa);
/// Computes the colours of triangles [first, last). Distinct ranges may run concurrently.
/// @pre plan->has_per_triangle_colors()
void compute_flat_colors(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa);

}  // namespace tessera::detail
