// Blocks of fragments of one triangle, point, line or rectangle of pixels: all tests and operations of a
// draw. The code is the same for every depth format.
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

/// For draws without operations whose primitives are drawn as blocks of fragments.
inline constexpr FragmentOps kNoOperations{};

/// Draws the fragments of one primitive, block by block. `triangle` is its record for shading.
struct FragmentTriangle {
  TileContext& context;
  const TileDraw& draw;
  const TileDraw& colors_of;  // the draw whose colours are evaluated: `draw`, except in captures
  const FragmentOps& ops;
  const ShadedTriangle& triangle;
  const int face;  // 0 front, 1 back
  const bool has_depth;
  const bool evaluates_colors;
  bool has_given_colors = false;      // colours are flat_color or block_colors
  StencilTestConstants stencil{};     // constants of this face, if there is a test
  std::int32_t id = 0;                // ColorWrite::deferred: number of the triangle
  std::uint32_t packed_color = 0;     // ColorWrite::constant
  const float* flat_color = nullptr;  // r g b a, or an index; null: not flat
  // Colours of the current block: all r, then all g, b and a; null: the triangle's.
  const float* block_colors = nullptr;
  bool visible = false;              // a fragment has passed the tests
  const bool runs_stage_first;       // the fragment stage decides which fragments pass
  const DrawTexture* texture;        // null: none
  TextureCoordinates coordinates{};  // for a texture with levels
  BatchSurface surface;              // if evaluates_colors

  HWY_INLINE FragmentTriangle(TileContext& tile_context, const ShadedTriangle& shaded)
      : context(tile_context),
        draw(tile_context.frame.draws[shaded.draw]),
        colors_of(draw.colors_of != nullptr ? *draw.colors_of : draw),
        ops(draw.ops != nullptr ? *draw.ops : kNoOperations),
        triangle(shaded),
        face(shaded.back ? 1 : 0),
        has_depth(draw.uses_depth && draw.path.uses_depth()),
        evaluates_colors(needs_colors(draw)),
        runs_stage_first(draw.stage != nullptr && draw.stage->runs_before_tests),
        texture(texture_of(colors_of, shaded.back)) {
    if (ops.stencil) stencil = stencil_test_constants(ops.faces[face], ops.stencil_max);
  }
  /// Prepares the evaluation of colours. @pre flat_color and block_colors are set
  HWY_INLINE void begin_colors() {
    if (!evaluates_colors) return;
    begin_surface(context, surface, triangle, colors_of);
    surface.gathers_coordinates = false;  // sample_block() samples the texture, possibly before the tests
    // In a capture of normals a flat draw has a lighting program too; its flat colour then serves the alpha
    // test only.
    const bool is_lit = surface.program != nullptr;
    has_given_colors = !is_lit && (flat_color != nullptr || block_colors != nullptr);
    if (has_given_colors) surface.attribute_count = 0;
    else surface.clamps_colors = surface.interpolates_colors;
  }
  /// Whether the alpha test depends on the texture.
  HWY_INLINE bool tests_texels() const {
    return ops.alpha_test && !runs_stage_first && texture != nullptr && texture->changes_alpha();
  }

  /// Draws the fragments of one block.
  /// @param blocks  one per sample
  void operator()(int bx, int by, const BlockFragments* blocks);  // fragment_triangle.cpp

 private:
  /// Whether colours are evaluated here. That includes interpolated ones, because draws of
  /// Kind::triangles_msaa send groups with wide triangles here.
  static HWY_INLINE bool needs_colors(const TileDraw& draw) {
    return draw.path.color_write == ColorWrite::evaluated ||
           draw.path.color_write == ColorWrite::interpolated || draw.captures_normals ||
           (draw.stage != nullptr && draw.stage->runs_before_tests);
  }

  // fragment_triangle.cpp
  void sample_block(int bx, int by, std::uint32_t bits);
  std::uint32_t test(const TileAttachments& sample, int bx, int by, const BlockFragments& block);
  void store_ids(int index, const std::uint32_t* passed, const BlockFragments* blocks);
  template <bool kBeforeTests>
  void evaluate_block(int bx, int by, std::uint32_t bits);
  bool run_stage_before_tests(int bx, int by, const BlockFragments* blocks, BlockFragments* kept);
  std::uint32_t run_stage_on_block(int bx, int by, const Int* keys, std::uint32_t bits);
  void store_alpha(int bx, int by) const;
  void draw_staged(int bx, int by, const BlockFragments* blocks);
  std::uint32_t run_tests(int bx, int by, const BlockFragments* blocks, std::uint32_t* passed);
  void store_colors(int bx, int by, const std::uint32_t* passed, std::uint32_t passed_any);
  void capture_block_normals(int bx, int by, std::uint32_t bits);
  Float alpha_of_chunk(int bx, int by, int chunk) const;
  Barycentric at(int bx, int by, int chunk) const;
  Float untextured_alpha(int bx, int by, int chunk) const;
  Float textured_alpha(Float untextured, int chunk) const;
  Colors colors(int bx, int by, int chunk) const;
  Float thresholds(int bx, int by, int chunk) const;
  Int packed(Colors source, Float threshold, std::uint32_t lanes, Int stored) const;
};

/// Calls draw_blocks(fragments) for element i of the group, and defers the element if necessary.
/// @param triangle  the element's record for shading, at the pixels' centres
template <class DrawBlocks>
HWY_INLINE void draw_fragments_of(TileContext& context, int i, const ShadedTriangle& triangle,
                                  const DrawBlocks& draw_blocks) {
  TileWorkspace::Memory& memory = context.memory;
  FragmentTriangle fragments(context, triangle);
  const TileDraw& draw = fragments.draw;
  fragments.id = static_cast<std::int32_t>(memory.visible_triangles.size());
  if (draw.path.color_write == ColorWrite::constant) {
    const bool is_primitive_number = draw.id_output == TileDraw::IdOutput::primitive;
    fragments.packed_color = is_primitive_number ? memory.source[i] / draw.primitive_triangles
                                                 : packed_color_of(context, draw, i, triangle.back);
  }
  if (fragments.colors_of.flat)
    fragments.flat_color = flat_color(fragments.colors_of, memory.source[i], triangle.back);
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
