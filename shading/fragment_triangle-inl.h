// Blocks of fragments of one triangle, point, line or rectangle of pixels: the tests and operations that a
// draw needs besides the depth test. The same code for every depth format.
#if defined(TESSERA_SHADING_FRAGMENT_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_FRAGMENT_TRIANGLE_INL_H_
#undef TESSERA_SHADING_FRAGMENT_TRIANGLE_INL_H_
#else
#define TESSERA_SHADING_FRAGMENT_TRIANGLE_INL_H_
#endif

#include "shading/batch_surface-inl.h"
#include "shading/draw_functions-inl.h"
#include "shading/fragment_ops-inl.h"
#include "shading/primitive_color-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Pixels of a block that a primitive covers in one sample, and their depth keys.
struct BlockFragments {
  Int covered[kChunksPerBlock];  ///< lanes of -1 and 0
  Int keys[kChunksPerBlock];
};

/// Operations of draws that have none and whose fragments are drawn block by block all the same.
inline constexpr FragmentOps kNoOperations{};

struct FragmentTriangle {
  TileContext& context;
  const TileDraw& draw;
  const FragmentOps& ops;
  const ShadedTriangle& triangle;
  const int face;  // 0 front, 1 back
  const bool has_depth;
  const bool evaluates_colors;
  bool has_given_colors = false;        // colors are flat_color or block_colors
  StencilTestConstants stencil{};       // constants of this face, if there is a test
  std::int32_t id = 0;                  // ColorWrite::deferred: number of the triangle
  std::uint32_t packed_color = 0;       // ColorWrite::constant
  const float* flat_color = nullptr;    // r g b a, or an index; null: not flat
  const float* block_colors = nullptr;  // colors of a block: all r, then all g, b and a; null: the triangle's
  bool visible = false;                 // a fragment has passed the tests
  const DrawTexture* texture;           // null: none
  TextureCoordinates coordinates{};     // for a texture with levels
  BatchSurface surface;                 // if evaluates_colors

  HWY_INLINE FragmentTriangle(TileContext& tile_context, const ShadedTriangle& shaded)
      : context(tile_context),
        draw(tile_context.frame.draws[shaded.draw]),
        ops(draw.ops != nullptr ? *draw.ops : kNoOperations),
        triangle(shaded),
        face(shaded.back ? 1 : 0),
        has_depth(draw.path.uses_depth()),
        evaluates_colors(needs_colors(draw)),
        texture(texture_of(draw, shaded.back)) {
    if (ops.stencil) stencil = stencil_test_constants(ops.faces[face], ops.stencil_max);
  }
  /// Prepares the evaluation of colors; after flat_color and block_colors are set.
  HWY_INLINE void begin_colors() {
    if (!evaluates_colors) return;
    begin_surface(context, surface, triangle);
    surface.gathers_coordinates = false;  // an alpha test may sample the texture before
    // Flat draws keep their color for the alpha test while a capture of normals lights them.
    const bool is_lit = surface.program != nullptr;
    has_given_colors = !is_lit && (flat_color != nullptr || block_colors != nullptr);
    if (has_given_colors) surface.attribute_count = 0;
    else surface.clamps_colors = surface.interpolates_colors;
  }
  /// Whether the alpha test depends on the texture.
  HWY_INLINE bool tests_texels() const {
    return ops.alpha_test && texture != nullptr && texture->changes_alpha();
  }

  /// Draws the fragments of one block.
  /// @param blocks  one per sample
  void operator()(int bx, int by, const BlockFragments* blocks);  // fragment_triangle.cpp

 private:
  /// Draws of Kind::triangles_msaa with interpolated colors come here with wide triangles.
  static HWY_INLINE bool needs_colors(const TileDraw& draw) {
    return draw.path.color_write == ColorWrite::evaluated ||
           draw.path.color_write == ColorWrite::interpolated || draw.captures_normals;
  }

  // fragment_triangle.cpp
  void sample_block(int bx, int by, std::uint32_t bits);
  std::uint32_t test(const TileAttachments& sample, int bx, int by, const BlockFragments& block);
  void store_ids(int index, const std::uint32_t* passed);
  void evaluate_block(int bx, int by, std::uint32_t bits);
  Barycentric at(int bx, int by, int chunk) const;
  Float own_alpha(int bx, int by, int chunk) const;
  Float textured_alpha(Float own, int chunk) const;
  Colors colors(int bx, int by, int chunk) const;
  Float thresholds(int bx, int by, int chunk) const;
  Int nearest_entries(const Colors& colors, Float threshold, std::uint32_t lanes) const;
  Int packed(Colors source, Float threshold, std::uint32_t lanes, Int stored) const;
};

/// Calls draw_blocks(fragments) for element i of the group.
/// @param triangle  its record, for the pixels' centers
template <class DrawBlocks>
HWY_INLINE void draw_fragments_of(TileContext& context, int i, const ShadedTriangle& triangle,
                                  const DrawBlocks& draw_blocks) {
  TileWorkspace::Memory& memory = context.memory;
  FragmentTriangle fragments(context, triangle);
  const TileDraw& draw = fragments.draw;
  fragments.id = static_cast<std::int32_t>(memory.visible_triangles.size());
  if (draw.path.color_write == ColorWrite::constant)
    fragments.packed_color = draw.id_output == TileDraw::IdOutput::primitive
                                 ? memory.source[i] / draw.primitive_triangles
                                 : packed_color_of(context, draw, i, triangle.back);
  if (draw.flat) fragments.flat_color = flat_color(draw, memory.source[i], triangle.back);
  fragments.begin_colors();
  const bool has_levels = fragments.texture != nullptr && fragments.texture->levels != nullptr;
  if (has_levels && (!draw.deferred || fragments.tests_texels()))
    fragments.coordinates.set_up(triangle, memory.edges64.data(), *fragments.texture,
                                 draw.topology == Topology::lines, context.samples);
  draw_blocks(fragments);
  if (draw.deferred && fragments.visible) {
    memory.visible_triangles.push_back(triangle);
    if (context.frame.shade_immediately) shade_whole_tile(context);
  } else if (triangle.edges64_index >= 0) {
    memory.edges64.pop_back();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
