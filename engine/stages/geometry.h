// The vertex stage of a draw: positions into raster space, and colours or what the pixels interpolate.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/plan/draw_plan.h"
#include "engine/stages/scratch.h"
#include "framebuffer/palette_search.h"
#include "raster/polygon_facing.h"

namespace tessera::detail {

/// The memory of a draw's vertices, kept from frame to frame.
struct DrawBuffers {
  Scratch<WindowVertex> vertices;
  Scratch<std::uint8_t> outcodes;
  Scratch<float> attributes;
  Scratch<std::uint32_t> packed_colors[2];
  Scratch<float> face_colors[2];    ///< r g b a for each triangle, of flat draws with operations
  Scratch<std::uint32_t> indices;   ///< of elements: widened from 16 bits, or made of other primitives
  Scratch<Facing> facing;           ///< of each triangle, where several make a polygon or outlines are drawn
  Scratch<std::uint32_t> boundary;  ///< of each polygon the vertices in order, where outlines are drawn
  Scratch<double>
      depth_offsets;  ///< of each triangle's polygon, where several make one or clipping cuts some
  PolygonModes modes;
  Scratch<float> smooth_normals;          ///< generated, for the plan or for a capture
  Scratch<float> face_normals;            ///< generated, of each triangle
  std::atomic<bool> any_outcode = false;  ///< some vertex has a clip code
};

/// What the vertex stage works on.
struct GeometryDraw {
  const MeshArrays* mesh = nullptr;
  const DrawPlan* plan = nullptr;
  DrawBuffers* buffers = nullptr;
  const ColorLayout* layout = nullptr;
  const PaletteSearch* palette_search = nullptr;
  ProvokingVertex provoking_vertex = ProvokingVertex::last;

  bool generates_indices() const {
    const Primitive p = mesh->primitive;
    return mesh->indices16 != nullptr ||
           (p != Primitive::points && p != Primitive::lines && p != Primitive::triangles);
  }
  /// As many for each element as it has corners, of 32 bits, or null: vertices in order. @pre
  /// prepare_geometry
  const std::uint32_t* indices() const {
    return generates_indices() ? buffers->indices.data() : mesh->indices;
  }
  /// Of each triangle, or null: its own area decides. @pre classify_polygon_facing
  const Facing* facing() const { return has_polygon_facing() ? buffers->facing.data() : nullptr; }
  /// Of each triangle's polygon, or null: each has its own, or there are none; NaN: that one has its own.
  /// @pre offset_polygons
  const double* depth_offsets() const {
    return has_polygon_offsets() ? buffers->depth_offsets.data() : nullptr;
  }
  /// It has elements whose corners or normals are not there yet. @see assemble_elements
  bool assembles() const { return generates_indices() || plan->outlines || plan->face_normals; }
  bool wants_smooth_normals() const {
    return plan->smooth_normals || (plan->varyings.captured_normal >= 0 && !mesh->normals);
  }
  bool has_polygon_facing() const { return plan->outlines || mesh->triangles_per_polygon() > 1; }
  /// Once the vertices are there.
  bool has_polygon_offsets() const {
    return plan->has_offset() && (has_polygon_facing() || buffers->any_outcode);
  }
};

/// Takes the memory. Throws std::bad_alloc.
void prepare_geometry(const GeometryDraw& draw);
/// Corners of elements [first, last), and what belongs to polygons that begin among them; distinct ranges may
/// run at the same time.
void assemble_elements(const GeometryDraw& draw, std::size_t first, std::size_t last);
/// Vertices [first, last); distinct ranges may run at the same time.
void process_vertices(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa);
/// Face colours of triangles [first, last), for plans that color triangles.
void compute_flat_colors(const GeometryDraw& draw, std::size_t first, std::size_t last, InstructionSet isa);

}  // namespace tessera::detail
